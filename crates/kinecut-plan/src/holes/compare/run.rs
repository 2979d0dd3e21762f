//! The run of a path on the machine: its time, its motion, and what the position loops make of it.

use serde::Serialize;

use super::Terms;
use super::chain::Chain;
use super::program::program;
use crate::base::{Code, Finding, Result, Silent};
use crate::machine::{CoordinateCode, Dynamics, Machine, MotionControl};
use crate::motion::{AxisMoment, MotionSample, program_samples};
use crate::program::Blend;
use crate::trace::{CompStart, RegisterState, TraceOptions, trace};

/// The run at a feed, from rest to rest, the circles at entry and wall included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Run {
    /// Feed [mm/s].
    pub feed: f64,
    /// Time [s].
    pub time: f64,
    /// Time where jerk has no limit, the joints passed as they are here: no run is shorter [s].
    pub without_jerk: f64,
    /// Joints at which the tool stops.
    pub stops: usize,
    /// Joints that the control smooths.
    pub smoothed: usize,
    /// Largest distance from the path at smoothed joints [mm].
    pub farthest: f64,
    /// What the position loops make of it.
    pub servo: ServoError,
}

/// Distance of the tip from the commanded path, by the model of [`Servo`](crate::motion::Servo).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ServoError {
    /// Largest distance [mm].
    pub most: f64,
    /// Distance of that place from the hole's centre [mm].
    pub radius: f64,
    /// Largest distance on the first three quarters of the circle at the wall, where the tool is not yet slowed down to its
    /// stop [mm].
    pub at_wall: f64,
}

/// A place of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ProfilePlace {
    /// Arc length from the start of the run [mm].
    pub s: f64,
    /// Time [s].
    pub time: f64,
    /// Path speed [mm/s].
    pub speed: f64,
    /// Acceleration, along the path and across it [mm/s^2].
    pub acceleration: f64,
    /// Jerk, all of it [mm/s^3].
    pub jerk: f64,
}

/// Time between samples [s].
const CYCLE: f64 = 1e-3;
/// Cycles in the time constant of the loops, at least.
const CYCLES: f64 = 5.0;
/// Parts of a run; the profile keeps the slowest and the hardest place of each.
const PARTS: usize = 400;
/// Share of the circle at the wall on which the tool slows down to its stop.
const WALL: f64 = 0.25;

/// Runs a chain at a feed [mm/s]; with its profile.
pub(super) fn run(chain: &Chain, terms: &Terms, feed: f64) -> Result<(Run, Vec<ProfilePlace>)> {
    let (program, _) = program(&chain.in_space(), feed, Blend::Continuous);
    let machine = machine(terms)?;
    let options = TraceOptions {
        machine: Some(&machine),
        tools: &[],
        retract_height: 0.0,
        operator: RegisterState::default(),
        radii: &[],
        comp_start: CompStart::AtNext,
        chord: 1e-3,
    };
    let trace = trace(&program, &options)?;
    let last_item = trace.segments.last().map_or(0, |segment| segment.item);
    let loops = (std::f64::consts::TAU * terms.servo.bandwidth).recip();
    let cycle = CYCLE.min(loops / CYCLES);
    let mut following = terms.servo.following(cycle);
    let mut servo = ServoError::default();
    let mut profile = Profile::new(chain.length());
    let wall_ends = chain.length() - WALL * (chain.length() - chain.starts[chain.curves.len() - 1]);
    let mut sink = |sample: &MotionSample| {
        let way = profile.add(sample);
        let followed = following.follow(sample);
        if followed.off > servo.most {
            servo.most = followed.off;
            servo.radius = followed.place.truncate().length();
        }
        if sample.item == last_item && way < wall_ends {
            servo.at_wall = servo.at_wall.max(followed.off);
        }
        Ok(())
    };
    let done = program_samples(&program, &trace, &machine, cycle, &Silent, &mut sink)?;
    let (time, _) = done.ok_or_else(|| Finding::error(Code::PLAN_VALUE, "the axes have no limits"))?;
    if let Some(reason) = time.reason {
        return Err(Finding { place: None, item: None, ..reason }.into());
    }
    let run = Run {
        feed,
        time: time.total(),
        without_jerk: time.total_without_jerk(),
        stops: time.smoothing.stops,
        smoothed: time.smoothing.smoothed,
        farthest: time.smoothing.most_off(),
        servo,
    };
    Ok((run, profile.places()))
}

/// A machine whose axes have the limits of the terms.
pub(super) fn machine(terms: &Terms) -> Result<Machine> {
    let limits = &terms.limits;
    let dynamics = Dynamics {
        rapid: Some(limits.axis_velocity),
        acceleration: Some(limits.acceleration),
        jerk: Some(limits.jerk),
    };
    let control = MotionControl {
        interpolator: Some(terms.interpolator),
        tolerance: terms.tolerance,
        junction_deviation: terms.junction_deviation,
        ..MotionControl::default()
    };
    Ok(Machine { control, ..Machine::new(CoordinateCode::parse("2103")?, [None; 3], dynamics)? })
}

/// The slowest place and the one of most jerk of each part of a run, so that no stop and no peak is lost.
struct Profile {
    /// Length of a part [mm].
    part: f64,
    /// The sample before: way, time and speed.
    before: [f64; 3],
    /// Index of the present part, its slowest place and that of most jerk.
    present: Option<(u64, [ProfilePlace; 2])>,
    places: Vec<ProfilePlace>,
}

impl Profile {
    /// Of a run of this length [mm].
    fn new(length: f64) -> Profile {
        Profile { part: length / PARTS as f64, before: [0.0; 3], present: None, places: Vec::new() }
    }

    /// Adds a sample; the way to it [mm].
    fn add(&mut self, sample: &MotionSample) -> f64 {
        let [way, time, speed] = self.before;
        let s = way + 0.5 * (speed + sample.feed) * (sample.time - time);
        self.before = [s, sample.time, sample.feed];
        let size = |of: fn(&AxisMoment) -> f64| {
            sample.axes[..3].iter().map(|axis| of(axis).powi(2)).sum::<f64>().sqrt()
        };
        let place = ProfilePlace {
            s,
            time: sample.time,
            speed: sample.feed,
            acceleration: size(|axis| axis.acceleration),
            jerk: size(|axis| axis.jerk),
        };
        let part = (s / self.part) as u64;
        match &mut self.present {
            Some((present, [slowest, hardest])) if *present == part => {
                if place.speed < slowest.speed {
                    *slowest = place;
                }
                if place.jerk > hardest.jerk {
                    *hardest = place;
                }
            }
            _ => {
                self.end_part();
                self.present = Some((part, [place; 2]));
            }
        }
        s
    }

    fn end_part(&mut self) {
        let Some((_, mut both)) = self.present.take() else { return };
        both.sort_by(|a, b| a.time.total_cmp(&b.time));
        self.places.push(both[0]);
        if both[1] != both[0] {
            self.places.push(both[1]);
        }
    }

    /// The places in order.
    fn places(mut self) -> Vec<ProfilePlace> {
        self.end_part();
        self.places
    }
}
