//! One planned pass as a machine runs it: its way with curvature and load, its motion within the limits of the axes, in
//! samples few enough to be drawn.

use glam::{DVec2, DVec3};
use serde::Serialize;

use super::Terms;
use super::joints::{self, JointStep};
use super::program::at_feeds;
use super::run::machine;
use crate::base::{Code, Finding, Result, Silent};
use crate::geom::{Curve, PlaneCurve, joint};
use crate::holes::engagement::engagement;
use crate::motion::{MotionSample, PathByLength as _, program_samples};
use crate::program::Blend;
use crate::trace::{CompStart, RegisterState, TraceOptions, trace};

/// A curve of a pass with its feed.
#[derive(Clone, Debug, PartialEq)]
pub struct PassPiece {
    /// The curve [mm].
    pub curve: Curve,
    /// Feed [mm/s].
    pub feed: f64,
}

/// The stretch of a pass whose load is measured.
#[derive(Clone, Copy, Debug)]
pub struct Cut<'a> {
    /// Its curves, about the bore's centre.
    pub curves: &'a [PlaneCurve],
    /// Way on which it begins [mm].
    pub from: f64,
    /// Radius about the centre that is open before [mm].
    pub open: Option<f64>,
}

/// Largest sizes along a pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PassPeaks {
    /// Path speed [mm/s].
    pub speed: f64,
    /// Acceleration along the path [mm/s^2].
    pub along: f64,
    /// All of the acceleration [mm/s^2].
    pub acceleration: f64,
    /// Jerk along the path [mm/s^3].
    pub jerk_along: f64,
    /// All of the jerk [mm/s^3].
    pub jerk: f64,
    /// Engagement [rad]; none where it is not measured.
    pub engagement: Option<f64>,
    /// Acceleration of the axis that has most [mm/s^2].
    pub axis_acceleration: f64,
    /// Jerk of the axis that has most [mm/s^3].
    pub axis_jerk: f64,
}

/// The way in points, by columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PassWay {
    /// Way from the start [mm].
    pub s: Vec<f64>,
    /// Place, from the bore's centre [mm].
    pub x: Vec<f64>,
    /// The other coordinate [mm].
    pub y: Vec<f64>,
}

/// The motion in samples, by columns: of each part of the way its slowest place and that of most jerk.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PassSamples {
    /// Way from the start [mm].
    pub s: Vec<f64>,
    /// Time [s].
    pub time: Vec<f64>,
    /// Path speed [mm/s].
    pub speed: Vec<f64>,
    /// Acceleration along the path, negative while the tool slows down [mm/s^2].
    pub along: Vec<f64>,
    /// All of the acceleration [mm/s^2].
    pub acceleration: Vec<f64>,
    /// Jerk along the path [mm/s^3].
    pub jerk_along: Vec<f64>,
    /// All of the jerk [mm/s^3].
    pub jerk: Vec<f64>,
    /// Curvature of the path, positive to the left [1/mm]; none at a cusp.
    pub curvature: Vec<Option<f64>>,
    /// Engagement [rad]; none where it is not measured.
    pub engagement: Vec<Option<f64>>,
}

/// A pass as it is run, from rest to rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassRun {
    /// Units of all numbers.
    pub units: &'static str,
    /// Way at feed [mm].
    pub length: f64,
    /// Time [s].
    pub time: f64,
    /// Joints at which the tool stops.
    pub stops: usize,
    /// Joints that the control smooths.
    pub smoothed: usize,
    /// Largest distance from the path at smoothed joints [mm].
    pub farthest: f64,
    /// Stretch of the way whose load is measured [mm].
    pub measured: Option<[f64; 2]>,
    /// The largest of all samples of the motion, of which `samples` keeps a part.
    pub peaks: PassPeaks,
    /// Time between the samples of the motion [s].
    pub cycle: f64,
    /// The joint at which the circle at the wall begins.
    pub closing: Option<JointStep>,
    /// Number of joints.
    pub joint_count: usize,
    /// The hardest of them.
    pub joints: Vec<JointStep>,
    /// The way in points.
    pub way: PassWay,
    /// The motion along it.
    pub samples: PassSamples,
}

/// Time between samples [s], and most samples: a longer pass has longer times.
const CYCLE: f64 = 1e-3;
const CYCLES: f64 = 16_000.0;
/// Parts of the way, and of the stretches at its ends in which the tool speeds up and slows down.
const PARTS: f64 = 220.0;
const END_PARTS: f64 = 40.0;
/// Such a stretch: the way at feed in so long a time [s], and a share of the whole at most.
const END_TIME: f64 = 0.2;
const END_SHARE: f64 = 0.08;
/// Places at which the load is measured.
const LOADS: usize = 260;
/// Heading between two drawn points [rad]: a chord is off by 1/800 of its radius; and their number, about.
const DRAWN_TURN: f64 = 0.1;
const DRAWN: f64 = 2200.0;
/// Joints that are shown.
const JOINTS: usize = 48;
/// Speed below which the direction is that of the place before [mm/s].
const RESTS: f64 = 1e-6;
/// Digits that a number keeps, and what is rounding of zero [mm, s and their like].
const DIGITS: i32 = 6;
const NOTHING: f64 = 1e-9;

/// Runs a pass about `centre` on a machine with these limits.
///
/// # Errors
/// `KC0404` when it cannot be run; those of its limits.
pub fn pass_run(
    pieces: &[PassPiece],
    centre: [f64; 2],
    cut: Option<Cut<'_>>,
    terms: &Terms,
) -> Result<PassRun> {
    terms.limits.check()?;
    let mut starts = vec![0.0];
    let mut length = 0.0;
    for piece in pieces {
        length += piece.curve.length();
        starts.push(length);
    }
    let centre = DVec2::from_array(centre);
    let loads = match cut {
        Some(cut) => engagement(cut.curves, terms.cutter, cut.open, LOADS)?,
        None => Vec::new(),
    };
    let from = cut.map_or(0.0, |cut| cut.from);
    let load = |s: f64| {
        let at = loads.partition_point(|e| e.s + from < s);
        let (a, b) = (loads.get(at.checked_sub(1)?)?, loads.get(at)?);
        let share = if b.s > a.s { (s - from - a.s) / (b.s - a.s) } else { 0.0 };
        Some(a.angle + (b.angle - a.angle) * share)
    };
    let at = |s: f64| {
        let i = starts.partition_point(|start| *start <= s).clamp(1, pieces.len().max(1)) - 1;
        pieces.get(i).map(|piece| piece.curve.at((s - starts[i]).clamp(0.0, piece.curve.length())))
    };
    let (program, _) = at_feeds(pieces.iter().map(|p| (&p.curve, p.feed)), Blend::Continuous);
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
    let estimate: f64 = pieces.iter().map(|p| p.curve.length() / p.feed).sum();
    let cycle = if estimate > CYCLES * CYCLE { estimate / CYCLES } else { CYCLE };
    let fastest = pieces.iter().map(|p| p.feed).fold(0.0, f64::max);
    let mut motion = Motion::new(length, END_TIME * fastest);
    let mut sink = |sample: &MotionSample| {
        motion.add(sample);
        Ok(())
    };
    let done = program_samples(&program, &trace, &machine, cycle, &Silent, &mut sink)?;
    let (time, _) = done.ok_or_else(|| Finding::error(Code::PLAN_VALUE, "the axes have no limits"))?;
    if let Some(reason) = time.reason {
        return Err(Finding { place: None, item: None, ..reason }.into());
    }
    let (places, mut peaks) = motion.places();
    peaks.engagement = loads.iter().map(|e| e.angle).reduce(f64::max);
    let mut samples = PassSamples::default();
    for place in &places {
        samples.s.push(digits(place.s));
        samples.time.push(digits(place.time));
        samples.speed.push(digits(place.speed));
        samples.along.push(digits(place.along));
        samples.acceleration.push(digits(place.acceleration));
        samples.jerk_along.push(digits(place.jerk_along));
        samples.jerk.push(digits(place.jerk));
        let curvature = at(place.s).map(|jet| jet.d1.truncate().perp_dot(jet.d2.truncate()));
        samples.curvature.push(curvature.filter(|k| k.is_finite()).map(digits));
        samples.engagement.push(load(place.s).map(digits));
    }
    let all = joints(pieces, &starts, centre);
    let wall = cut.and_then(|cut| {
        let (_, before) = cut.curves.split_last()?;
        Some(cut.from + before.iter().map(PlaneCurve::length).sum::<f64>())
    });
    // A long curve is run in parts, whose lengths add up but for rounding.
    let closing = wall.and_then(|wall| all.iter().find(|j| (j.s - wall).abs() < 1e-6 * length).copied());
    Ok(PassRun {
        units: "mm, s, rad",
        length,
        time: time.total(),
        stops: time.smoothing.stops,
        smoothed: time.smoothing.smoothed,
        farthest: time.smoothing.most_off(),
        measured: loads.last().map(|e| [from, from + e.s]),
        peaks,
        cycle,
        closing,
        joint_count: all.len(),
        joints: joints::hardest(all, JOINTS),
        way: way(pieces, &starts, centre),
        samples,
    })
}

fn joints(pieces: &[PassPiece], starts: &[f64], centre: DVec2) -> Vec<JointStep> {
    let step = |(pair, s): (&[PassPiece], &f64)| {
        let slower = if pair[0].feed < pair[1].feed { pair[0].feed } else { pair[1].feed };
        let radius = (pair[1].curve.start().truncate() - centre).length();
        JointStep::new(&joint(&pair[0].curve, &pair[1].curve), *s, radius, slower)
    };
    pieces.windows(2).zip(&starts[1..]).map(step).collect()
}

fn way(pieces: &[PassPiece], starts: &[f64], centre: DVec2) -> PassWay {
    let mut way = PassWay::default();
    let mut add = |s: f64, p: DVec3| {
        let p = p.truncate() - centre;
        way.s.push(digits(s));
        way.x.push(digits(p.x));
        way.y.push(digits(p.y));
    };
    let turn = pieces.iter().map(|p| p.curve.stations(1.0).len() as f64).sum::<f64>() / DRAWN;
    let turn = if turn > DRAWN_TURN { turn } else { DRAWN_TURN };
    for (piece, start) in pieces.iter().zip(starts) {
        for station in piece.curve.stations(turn) {
            add(start + station.s, station.point);
        }
    }
    way
}

/// With so many digits as are drawn.
fn digits(v: f64) -> f64 {
    if v.abs() < NOTHING || !v.is_finite() {
        return 0.0;
    }
    let places = DIGITS - 1 - v.abs().log10().floor() as i32;
    let unit = 10f64.powi(places.abs());
    if places >= 0 { (v * unit).round() / unit } else { (v / unit).round() * unit }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Place {
    s: f64,
    time: f64,
    speed: f64,
    along: f64,
    acceleration: f64,
    jerk_along: f64,
    jerk: f64,
}

/// The samples of a run: what is kept of them, and the largest of all.
struct Motion {
    length: f64,
    /// Length of the stretches at both ends [mm].
    end: f64,
    before: Option<Place>,
    direction: DVec3,
    /// Index of the present part, its slowest place and that of most jerk.
    present: Option<(u64, [Place; 2])>,
    places: Vec<Place>,
    peaks: PassPeaks,
}

impl Motion {
    fn new(length: f64, end: f64) -> Motion {
        let most = END_SHARE * length;
        Motion {
            length,
            end: if end < most { end } else { most },
            before: None,
            direction: DVec3::ZERO,
            present: None,
            places: Vec::new(),
            peaks: PassPeaks::default(),
        }
    }

    fn add(&mut self, sample: &MotionSample) {
        let [x, y, z, ..] = &sample.axes;
        let velocity = DVec3::new(x.velocity, y.velocity, z.velocity);
        let acceleration = DVec3::new(x.acceleration, y.acceleration, z.acceleration);
        let jerk = DVec3::new(x.jerk, y.jerk, z.jerk);
        if velocity.length() > RESTS {
            self.direction = velocity.normalize_or_zero();
        } else if self.before.is_none() {
            // From rest the tool begins to move where jerk and acceleration push it.
            self.direction = (acceleration + jerk).normalize_or_zero();
        }
        let mut place = Place {
            s: 0.0,
            time: sample.time,
            speed: sample.feed,
            along: acceleration.dot(self.direction),
            acceleration: acceleration.length(),
            jerk_along: jerk.dot(self.direction),
            jerk: jerk.length(),
        };
        if let Some(before) = self.before {
            // Exact where the acceleration along the path changes evenly.
            let dt = place.time - before.time;
            let way = 0.5 * (before.speed + place.speed) * dt + (before.along - place.along) * dt * dt / 12.0;
            place.s = (before.s + way).clamp(before.s, self.length);
        }
        self.before = Some(place);
        let largest = |peak: &mut f64, v: f64| {
            if v > *peak {
                *peak = v;
            }
        };
        largest(&mut self.peaks.speed, place.speed);
        largest(&mut self.peaks.along, place.along.abs());
        largest(&mut self.peaks.acceleration, place.acceleration);
        largest(&mut self.peaks.jerk_along, place.jerk_along.abs());
        largest(&mut self.peaks.jerk, place.jerk);
        largest(&mut self.peaks.axis_acceleration, acceleration.abs().max_element());
        largest(&mut self.peaks.axis_jerk, jerk.abs().max_element());
        let part = self.part(place.s);
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
    }

    /// Number of the part of the way in which a place is.
    fn part(&self, s: f64) -> u64 {
        let (left, small) = (self.length - s, END_PARTS / self.end);
        let number = if s < self.end {
            s * small
        } else if left < self.end {
            END_PARTS + PARTS + (self.end - left) * small
        } else {
            END_PARTS + (s - self.end) * PARTS / (self.length - 2.0 * self.end)
        };
        // In range: a way has finitely many parts.
        number as u64
    }

    fn end_part(&mut self) {
        let Some((_, mut both)) = self.present.take() else { return };
        both.sort_by(|a, b| a.time.total_cmp(&b.time));
        self.places.push(both[0]);
        if both[1] != both[0] {
            self.places.push(both[1]);
        }
    }

    /// The places in order, the last one too.
    fn places(mut self) -> (Vec<Place>, PassPeaks) {
        self.end_part();
        if let Some(last) = self.before.filter(|last| self.places.last() != Some(last)) {
            self.places.push(last);
        }
        (self.places, self.peaks)
    }
}
