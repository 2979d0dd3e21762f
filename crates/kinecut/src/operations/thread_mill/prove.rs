//! Whether the posted text mills the wanted threads: its helices are read back and compared, point by point.
//!
//! Radius, pitch, hand, direction, height and phase are those of the points; the pitch diameter follows by the envelope of
//! [`Cut`]. Nothing here comes from the planner but the list of its helices.

use std::f64::consts::TAU;

use super::PlannedThreadMilling;
use super::envelope::Cut;
use super::posted::{About, PostedHelix};
use crate::base::{Code, Finding};
use crate::holes::Sense;
use crate::operations::kind::Checked as _;
use crate::operations::measured::Proof;
use crate::operations::{Judged, PostedPlan, Tally};
use crate::page::{fixed, trimmed};
use crate::threading::{MillProfile, ThreadRun, ThreadSide};
use crate::tool::Hand;

/// Way along the axis by which a thread may begin late or end early: rounding of heights [mm].
const HEIGHT: f64 = 2e-3;
/// Intervals along a taper thread in which the radius of its helix changes evenly.
const NODES: usize = 32;

/// The wanted thread, as points of its helices are compared with it [mm].
struct Wanted<'a> {
    plan: &'a PlannedThreadMilling,
    /// Radius of the finished helix at even heights from the bottom to the mouth; of a cylinder at one.
    radii: Vec<f64>,
    /// Counter-clockwise.
    counter_clockwise: bool,
}

/// Compares all helices; the largest deviation of the pitch diameter where all are right [mm].
pub(super) fn judged(plan: &PlannedThreadMilling, posted: &PostedPlan<'_>) -> (Judged, Option<f64>) {
    let mut judged = Judged::default();
    let wanted = Wanted::of(plan);
    let found = PostedHelix::all(plan, posted);
    let runs = &plan.plan.runs;
    for place in 0..plan.spec.places.len() {
        let pairs: Vec<(&ThreadRun, &PostedHelix)> =
            runs.iter().zip(&found).filter(|(run, _)| run.place == place).collect();
        let missing = runs.iter().filter(|run| run.place == place).count() != pairs.len();
        match wanted.thread(place, &pairs) {
            Ok(worst) if !missing && found.len() == runs.len() => {
                judged.tally.good += 1;
                judged.tally.worst = judged.tally.worst.max(worst);
            }
            Ok(_) => {
                judged.tally.bad += 1;
                let item = found.first().map_or(plan.items.start, |h| h.item);
                let message = format!("{}: the text lacks a helix of it", wanted.name(place));
                judged.findings.push((Finding::error(Code::THREAD_FORM, message), item));
            }
            Err((finding, item)) => {
                judged.tally.bad += 1;
                judged.findings.push((*finding, item));
            }
        }
    }
    let deviation = (judged.tally.bad == 0).then_some(judged.tally.worst);
    (judged, deviation)
}

impl<'a> Wanted<'a> {
    fn of(plan: &'a PlannedThreadMilling) -> Wanted<'a> {
        let (spec, table) = (&plan.spec, &plan.of.table);
        let inside = spec.side == ThreadSide::Inside;
        let thread = &plan.of.thread;
        let radius = |depth: f64| {
            // A hole narrows downwards, a boss widens.
            let wider = if inside { -depth } else { depth } * 0.5 * thread.taper;
            0.5 * (thread.pitch_diameter() + table.oversize) + wider
        };
        let crest = if inside {
            0.5 * (thread.diameter - thread.pitch_diameter())
        } else {
            0.5 * (thread.pitch_diameter() - thread.root_diameter())
        };
        let tool = 0.5 * plan.of.mill.diameter - crest;
        let cut = Cut { inside, pitch: thread.pitch, half_angle: thread.form.half_angle(), tool };
        // A register leaves stock: nearer to the axis of a hole, away from a boss.
        let wear = plan.wear_value() * if inside { -1.0 } else { 1.0 };
        let helix = |depth: f64| {
            let plain = if inside { radius(depth) - tool } else { radius(depth) + tool };
            let radius = match table.profile {
                MillProfile::Standard => cut.helix_of(radius(depth)),
                MillProfile::Corrected => plain,
            };
            radius + wear
        };
        Wanted {
            plan,
            radii: match thread.taper > 0.0 {
                true => (0..=NODES).map(|i| helix(table.depth * (1.0 - i as f64 / NODES as f64))).collect(),
                false => vec![helix(0.0)],
            },
            counter_clockwise: counter_clockwise(inside, table.direction, plan.of.is_left_hand()),
        }
    }

    /// The thread at a place, in words.
    fn name(&self, place: usize) -> String {
        self.plan.of.at(self.plan.of.places.get(place).map_or([0.0; 2], |p| p.at))
    }

    /// Radius of the finished helix where the lowest row's middle has a height.
    fn radius(&self, z: f64) -> f64 {
        let t = &self.plan.of.table;
        let [one] = self.radii[..] else {
            let share = (z - t.top + t.depth) / t.depth * NODES as f64;
            // Beyond both ends as in the last interval.
            let i = (share.floor().max(0.0) as usize).min(NODES - 1);
            let [low, high] = [self.radii[i], self.radii[i + 1]];
            return low + (high - low) * (share - i as f64);
        };
        one
    }

    /// Compares the helices of a thread; its deviation of the pitch diameter [mm].
    fn thread(&self, place: usize, pairs: &[(&ThreadRun, &PostedHelix)]) -> Result<f64, (Box<Finding>, u32)> {
        let plan = self.plan;
        let (t, thread) = (&plan.of.table, &plan.of.thread);
        let axis = plan.spec.places[place];
        let tolerance = plan.of.milling.tolerance;
        let rises = if thread.hand == Hand::Right { 1.0 } else { -1.0 };
        let [mut lowest, mut highest] = [f64::INFINITY, f64::NEG_INFINITY];
        let (mut worst, mut phase) = (0.0, None);
        for (_, helix) in pairs {
            let wrong = |what: String, value: f64, bound: f64, unit: &str| {
                let finding = Finding::error(Code::THREAD_FORM, format!("{}: {what}", self.name(place)));
                let finding = finding.value((value * 1e6).round() / 1e6, unit);
                (Box::new(finding.bound((bound * 1e6).round() / 1e6, unit)), helix.item)
            };
            let points = self.middles(&helix.about(axis));
            let (Some(first), Some(last)) = (points.first(), points.last()) else { continue };
            if (last.turned > 0.0) != self.counter_clockwise {
                let sense = if self.counter_clockwise { "counter-clockwise" } else { "clockwise" };
                let what = format!("the helix does not run {sense}");
                return Err(wrong(what, last.turned / TAU, last.turned / -TAU, "turns"));
            }
            let per_turn = (last.z - first.z) / last.turned * TAU;
            let off = |p: &About| (p.z - first.z - rises * thread.pitch * p.turned / TAU).abs();
            if points.iter().map(off).fold(0.0, f64::max) > tolerance {
                let what = "the helix does not have the pitch and hand of the thread".to_owned();
                return Err(wrong(what, per_turn, rises * thread.pitch, "mm a turn"));
            }
            // Height of the groove at the angle of X, but for whole pitches.
            let starts = first.z - rises * thread.pitch * helix.begins(axis) / TAU;
            let shift = |a: f64, b: f64| ((a - b) / thread.pitch + 0.5).rem_euclid(1.0) - 0.5;
            let before = *phase.get_or_insert(starts);
            if (shift(starts, before) * thread.pitch).abs() > tolerance {
                let what = "its passes do not run in one groove".to_owned();
                return Err(wrong(what, shift(starts, before) * thread.pitch, tolerance, "mm"));
            }
            let beyond = |p: &About| match plan.spec.side {
                ThreadSide::Inside => p.radius - self.radius(p.z),
                ThreadSide::Outside => self.radius(p.z) - p.radius,
            };
            for p in &points {
                let deviation = 2.0 * beyond(p);
                // A pass before the last leaves material.
                if deviation > tolerance || helix.finishing && deviation < -tolerance {
                    let what = "the pitch diameter by the helix of the text is off".to_owned();
                    return Err(wrong(what, deviation, tolerance, "mm"));
                }
                if helix.finishing {
                    worst = f64::max(worst, deviation.abs());
                }
            }
            if helix.finishing {
                lowest = f64::min(lowest, f64::min(first.z, last.z));
                let rows = f64::from(plan.of.mill.rows - 1);
                highest = f64::max(highest, f64::max(first.z, last.z) + rows * thread.pitch);
            }
        }
        if lowest > t.top - t.depth + HEIGHT || highest < t.top - HEIGHT {
            let message = format!(
                "{}: the helices reach from Z {} to Z {}, the thread from Z {} to Z {}",
                self.name(place),
                trimmed(lowest, 3),
                trimmed(highest, 3),
                trimmed(t.top - t.depth, 3),
                trimmed(t.top, 3)
            );
            let item = pairs.first().map_or(plan.items.start, |(_, h)| h.item);
            return Err((Box::new(Finding::error(Code::THREAD_FORM, message)), item));
        }
        Ok(worst)
    }

    /// Points of the tool's tip as those of the middle of its lowest row.
    fn middles(&self, points: &[About]) -> Vec<About> {
        let up = 0.5 * self.plan.of.thread.pitch;
        points.iter().map(|p| About { z: p.z + up, ..*p }).collect()
    }
}

/// The table of directions: whether the path runs counter-clockwise, seen from above.
fn counter_clockwise(inside: bool, sense: Sense, left_hand_cutter: bool) -> bool {
    match (inside, sense, left_hand_cutter) {
        (true, Sense::Climb, false) | (true, Sense::Conventional, true) => true,
        (true, Sense::Conventional, false) | (true, Sense::Climb, true) => false,
        (false, Sense::Climb, false) | (false, Sense::Conventional, true) => false,
        (false, Sense::Conventional, false) | (false, Sense::Climb, true) => true,
    }
}

/// The claim about all milled threads of a job.
pub(super) fn sum_up(tallies: &[Tally]) -> (Option<Proof>, Option<String>) {
    let good: usize = tallies.iter().map(|t| t.good).sum();
    if good == 0 || tallies.iter().any(|t| t.bad > 0) {
        return (None, None);
    }
    let worst = tallies.iter().map(|t| t.worst).fold(0.0, f64::max);
    let threads = if good == 1 { "1 milled thread".to_owned() } else { format!("{good} milled threads") };
    let proof = Proof {
        claim: format!(
            "{threads}: the helix of the text has the pitch, hand, direction and depth of the thread, and by the envelope of straight flanks its pitch diameter within {} \u{b5}m",
            fixed((worst * 1e4).ceil() * 0.1, 1)
        ),
        bound:
            "points of each helix, 64 a turn; for the profile and diameter of the tool that the job states"
                .to_owned(),
    };
    (Some(proof), None)
}
