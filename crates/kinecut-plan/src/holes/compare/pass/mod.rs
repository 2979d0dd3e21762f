//! One planned pass as a machine runs it: its way with curvature and load, its motion within the limits of the axes, in
//! samples few enough to be drawn.
//!
//! The motion is looked at every millisecond, of a pass longer than 16 s every 16000th part of it and every millisecond
//! where it changes. Of each part of the way the extreme places are kept; the engagement is measured at those. A control
//! without a limit of jerk steps from acceleration to acceleration: it has no jerk. One that looks ahead by junction deviation runs
//! along chords, whose acceleration is that along the path; that across is the one of the path at the same speed.

mod kept;
mod track;

use glam::{DVec2, DVec3};
use serde::Serialize;

use self::kept::{Kept, Model};
use self::track::Track;
use super::Terms;
use super::joints::{self, JointStep};
use super::program::at_feeds;
use super::run::{has_jerk, has_own_planner, machine};
use crate::base::{Code, Finding, Result, Silent};
use crate::geom::{Curve, Jet, PlaneCurve, joint};
use crate::holes::engagement::engagement_at;
use crate::machine::Interpolator;
use crate::motion::{FinerSamples, MotionSample, PathByLength as _, program_samples_finer};
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
    /// Jerk along the path [mm/s^3]; none of a control without a limit of jerk, whose acceleration steps.
    pub jerk_along: Option<f64>,
    /// All of the jerk [mm/s^3]; none likewise.
    pub jerk: Option<f64>,
    /// Engagement [rad], of the places of `samples` alone; none where it is not measured.
    pub engagement: Option<f64>,
    /// Acceleration of the axis that has most [mm/s^2].
    pub axis_acceleration: f64,
    /// Jerk of the axis that has most [mm/s^3]; none of a control without a limit of jerk.
    pub axis_jerk: Option<f64>,
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

/// The motion in samples, by columns: of each part of the way the slowest and the fastest place, and those of most
/// acceleration and jerk, along the path and in all.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PassSamples {
    /// Way from the start, at the place of the programmed path that is nearest [mm].
    pub s: Vec<f64>,
    /// Time [s].
    pub time: Vec<f64>,
    /// Path speed [mm/s].
    pub speed: Vec<f64>,
    /// Acceleration along the path, negative while the tool slows down [mm/s^2].
    pub along: Vec<f64>,
    /// All of the acceleration [mm/s^2].
    pub acceleration: Vec<f64>,
    /// Jerk along the path [mm/s^3]; none of a control without a limit of jerk, whose acceleration steps.
    pub jerk_along: Vec<Option<f64>>,
    /// All of the jerk [mm/s^3]; none likewise.
    pub jerk: Vec<Option<f64>>,
    /// Curvature of the programmed path in space, positive to the left [1/mm]; none at a cusp. Where the control leaves the
    /// path at a joint, its own is another.
    pub curvature: Vec<Option<f64>>,
    /// Engagement at this place [rad]; none where it is not measured. Between two places it is not known.
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
    /// Joints at which the tool stops; none of a control with a planner of its own, which does not tell.
    pub stops: Option<usize>,
    /// Joints that the control smooths; none likewise.
    pub smoothed: Option<usize>,
    /// Largest distance from the programmed path [mm]: at smoothed joints, or of all samples of the motion.
    pub farthest: f64,
    /// Stretch of the way whose load is measured [mm].
    pub measured: Option<[f64; 2]>,
    /// Number of places at which the load is measured: its largest is the largest of these.
    pub engagement_places: usize,
    /// The reason for which a load that is asked for is not measured.
    pub unmeasured: Option<Finding>,
    /// The largest of all samples of the motion, of which `samples` keeps a part.
    pub peaks: PassPeaks,
    /// Largest time between the samples of the motion [s].
    pub cycle: f64,
    /// Largest time between them where the motion changes: at joints, and where speed or acceleration change by more than a
    /// hundredth of feed and limit [s].
    pub finest: f64,
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
/// The same where the motion changes.
const FINEST: f64 = 1_000_000.0;
/// Share of feed and of the limit of acceleration that is a change.
const CHANGE: f64 = 0.01;
/// Parts of the way: of half the cutter's radius each, but so many at least and at most.
const PARTS: [f64; 2] = [220.0, 800.0];
const PART_SHARE: f64 = 0.5;
/// Parts of the stretches at its ends in which the tool speeds up and slows down.
const END_PARTS: f64 = 40.0;
/// Such a stretch: the way at feed in so long a time [s], and a share of the whole at most.
const END_TIME: f64 = 0.2;
const END_SHARE: f64 = 0.08;
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
    let finest = if estimate > FINEST * CYCLE { estimate / FINEST } else { CYCLE };
    let finer = FinerSamples {
        cycle: finest,
        speed: CHANGE * fastest,
        acceleration: CHANGE * terms.limits.acceleration,
    };
    let model = Model {
        has_jerk: has_jerk(terms.interpolator),
        by_chords: terms.interpolator == Interpolator::JunctionDeviation,
    };
    let has_own_planner = has_own_planner(terms.interpolator);
    let parts = (length / (PART_SHARE * terms.cutter)).clamp(PARTS[0], PARTS[1]);
    let mut motion = Kept::new(length, (END_TIME * fastest, parts), model);
    let mut track = Track::new(pieces, &starts);
    let mut farthest: f64 = 0.0;
    let mut before: Option<(f64, f64)> = None;
    let mut sink = |sample: &MotionSample| {
        let [x, y, z, ..] = &sample.axes;
        let run = before.map_or(0.0, |(time, speed)| 0.5 * (speed + sample.feed) * (sample.time - time));
        before = Some((sample.time, sample.feed));
        let (s, off) = track.follow(DVec3::new(x.position, y.position, z.position), run);
        farthest = if off > farthest { off } else { farthest };
        motion.add(sample, s, at(s).as_ref());
        Ok(())
    };
    let done = program_samples_finer(&program, &trace, &machine, (cycle, finer), &Silent, &mut sink)?;
    let (time, _) = done.ok_or_else(|| Finding::error(Code::PLAN_VALUE, "the axes have no limits"))?;
    if let Some(reason) = time.reason {
        return Err(Finding { place: None, item: None, ..reason }.into());
    }
    let (places, mut peaks) = motion.places();
    let load = Load::of(cut, terms.cutter, &places.iter().map(|place| place.s).collect::<Vec<_>>());
    peaks.engagement = load.angles.iter().flatten().copied().reduce(f64::max);
    let mut samples = PassSamples::default();
    for (place, angle) in places.iter().zip(&load.angles) {
        samples.s.push(digits(place.s));
        samples.time.push(digits(place.time));
        samples.speed.push(digits(place.speed));
        samples.along.push(digits(place.along));
        samples.acceleration.push(digits(place.acceleration));
        samples.jerk_along.push(place.jerk_along.map(digits));
        samples.jerk.push(place.jerk.map(digits));
        samples.curvature.push(at(place.s).map(|jet| curvature(&jet)).filter(|k| k.is_finite()).map(digits));
        samples.engagement.push(angle.map(digits));
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
        stops: (!has_own_planner).then_some(time.smoothing.stops),
        smoothed: (!has_own_planner).then_some(time.smoothing.smoothed),
        farthest: if has_own_planner { farthest } else { time.smoothing.most_off() },
        measured: load.measured,
        engagement_places: load.angles.iter().flatten().count(),
        unmeasured: load.error,
        peaks,
        cycle,
        finest,
        closing,
        joint_count: all.len(),
        joints: joints::hardest(all, JOINTS),
        way: way(pieces, &starts, centre),
        samples,
    })
}

/// The load at places of a pass.
struct Load {
    measured: Option<[f64; 2]>,
    /// Engagement at each place [rad]; none outside of the measured stretch.
    angles: Vec<Option<f64>>,
    error: Option<Finding>,
}

impl Load {
    /// A load that cannot be measured is no reason not to run the pass.
    fn of(cut: Option<Cut<'_>>, cutter: f64, places: &[f64]) -> Load {
        let none = |error| Load { measured: None, angles: vec![None; places.len()], error };
        let Some(cut) = cut else { return none(None) };
        let to = cut.from + cut.curves.iter().map(PlaneCurve::length).sum::<f64>();
        let inside = |s: &f64| cut.from - NOTHING <= *s && *s <= to + NOTHING;
        let own: Vec<f64> = places.iter().filter(|s| inside(s)).map(|s| s - cut.from).collect();
        match engagement_at(cut.curves, cutter, cut.open, &own) {
            Ok(found) => {
                let mut found = found.into_iter();
                let angles = places.iter().map(|s| if inside(s) { found.next() } else { None }).collect();
                Load { measured: Some([cut.from, to]), angles, error: None }
            }
            Err(error) => none(Some(*error.0)),
        }
    }
}

/// Curvature in space, with the sign of its plan: positive to the left [1/mm].
fn curvature(jet: &Jet) -> f64 {
    jet.d2.length().copysign(jet.d1.truncate().perp_dot(jet.d2.truncate()))
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
