//! The run of a path on the machine: its time, its motion, and what the position loops make of it.

use serde::Serialize;

use super::Terms;
use super::chain::Chain;
use super::program::program;
use crate::base::{Code, Finding, Result, Silent};
use crate::machine::{CoordinateCode, Dynamics, Interpolator, Machine, MotionControl};
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
    /// Joints at which the tool stops; none of a control with a planner of its own, which does not tell.
    pub stops: Option<usize>,
    /// Joints that the control smooths; none likewise.
    pub smoothed: Option<usize>,
    /// Largest distance from the path at smoothed joints [mm]; none likewise.
    pub farthest: Option<f64>,
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
    /// Jerk, all of it [mm/s^3]; none of a control without a limit of jerk, whose acceleration steps.
    pub jerk: Option<f64>,
}

/// Time between samples [s].
const CYCLE: f64 = 1e-3;
/// Cycles in the time constant of the loops, at least.
const CYCLES: f64 = 5.0;
/// Parts of a run; the profile keeps the slowest place of each, and those of most acceleration and jerk.
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
    let mut profile = Profile::new(chain, terms.interpolator);
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
        stops: (!has_own_planner(terms.interpolator)).then_some(time.smoothing.stops),
        smoothed: (!has_own_planner(terms.interpolator)).then_some(time.smoothing.smoothed),
        farthest: (!has_own_planner(terms.interpolator)).then(|| time.smoothing.most_off()),
        servo,
    };
    Ok((run, profile.places()))
}

/// True of a control whose own planner is followed: it does not tell of its stops and of the joints that it smooths.
pub(super) fn has_own_planner(interpolator: Interpolator) -> bool {
    matches!(interpolator, Interpolator::JunctionDeviation | Interpolator::LinuxCnc)
}

/// True of a control that limits jerk: the acceleration of others steps.
pub(super) fn has_jerk(interpolator: Interpolator) -> bool {
    matches!(interpolator, Interpolator::JerkLimited | Interpolator::ExactStop)
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

/// The slowest place and the ones of most acceleration and most jerk of each part of a run, so that no stop and no peak is
/// lost.
struct Profile<'a> {
    chain: &'a Chain,
    interpolator: Interpolator,
    /// Length of a part [mm].
    part: f64,
    /// The sample before: way, time and speed.
    before: [f64; 3],
    /// Index of the present part, its slowest place and those of most acceleration and jerk.
    present: Option<(u64, [ProfilePlace; 3])>,
    places: Vec<ProfilePlace>,
}

impl<'a> Profile<'a> {
    /// Of a run along a chain.
    fn new(chain: &'a Chain, interpolator: Interpolator) -> Profile<'a> {
        let part = chain.length() / PARTS as f64;
        Profile { chain, interpolator, part, before: [0.0; 3], present: None, places: Vec::new() }
    }

    /// The acceleration across the path that chords do not have [mm/s^2].
    fn across(&self, s: f64, speed: f64) -> f64 {
        let curve =
            self.chain.starts.partition_point(|start| *start <= s).clamp(1, self.chain.curves.len()) - 1;
        let bend = self.chain.curves[curve].at(s - self.chain.starts[curve]).curvature;
        let across = speed * speed * bend;
        // At a cusp, which is left from rest, there is none.
        if across.is_finite() { across } else { 0.0 }
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
            acceleration: match self.interpolator {
                Interpolator::JunctionDeviation => {
                    size(|axis| axis.acceleration).hypot(self.across(s, sample.feed))
                }
                _ => size(|axis| axis.acceleration),
            },
            jerk: has_jerk(self.interpolator).then(|| size(|axis| axis.jerk)),
        };
        let part = (s / self.part) as u64;
        match &mut self.present {
            Some((present, [slowest, fastest_change, hardest])) if *present == part => {
                if place.speed < slowest.speed {
                    *slowest = place;
                }
                if place.acceleration > fastest_change.acceleration {
                    *fastest_change = place;
                }
                if place.jerk > hardest.jerk {
                    *hardest = place;
                }
            }
            _ => {
                self.end_part();
                self.present = Some((part, [place; 3]));
            }
        }
        s
    }

    fn end_part(&mut self) {
        let Some((_, mut all)) = self.present.take() else { return };
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        for place in all {
            if self.places.last() != Some(&place) {
                self.places.push(place);
            }
        }
    }

    /// The places in order.
    fn places(mut self) -> Vec<ProfilePlace> {
        self.end_part();
        self.places
    }
}
