//! A wanted thread, and the comparison of posted helices with it, point by point.
//!
//! Comparisons are written so that what is no number fails.

use std::f64::consts::TAU;

use glam::DVec2;

use super::PlannedThreadMilling;
use super::envelope::Cut;
use super::posted::{About, PostedHelix};
use super::reach::left_out;
use super::standard::profile;
use crate::base::{Code, Finding};
use crate::holes::Sense;
use crate::operations::kind::Checked as _;
use crate::page::trimmed;
use crate::threading::{MillProfile, ThreadSide};
use crate::tool::Hand;

/// Way along the axis by which a thread may begin late or end early: rounding of heights [mm].
const HEIGHT: f64 = 2e-3;
/// Intervals along a taper thread in which the radius of its helix changes evenly.
const NODES: usize = 32;

/// The wanted thread, as points of its helices are compared with it [mm].
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    /// Whether in a hole.
    inside: bool,
    /// Way of one turn counter-clockwise: negative for a left-hand thread.
    rise: f64,
    /// Rows of teeth.
    rows: u32,
    /// Heights of the bottom and the mouth of the thread.
    heights: [f64; 2],
    /// Radius of the finished helix at even heights from the bottom to the mouth; of a cylinder at one.
    radii: Vec<f64>,
    /// Counter-clockwise.
    counter_clockwise: bool,
    /// Largest deviation of the pitch diameter, and of heights.
    tolerance: f64,
    /// Whether the pitch diameter follows from the helix: not where the maker of the tool corrected its profile.
    pub(super) by_envelope: bool,
}

/// A helix that is not the wanted one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wrong {
    what: String,
    /// Value, bound and their unit.
    numbers: Option<([f64; 2], &'static str)>,
    /// The first item of the helix in the text.
    pub(super) item: Option<u32>,
}

impl Wrong {
    /// As a finding about a thread.
    pub(super) fn finding(&self, thread: &str) -> Finding {
        let finding = Finding::error(Code::THREAD_FORM, format!("{thread}: {}", self.what));
        let Some((numbers, unit)) = self.numbers else { return finding };
        let [value, bound] = numbers.map(|v| (v * 1e6).round() / 1e6);
        finding.value(value, unit).bound(bound, unit)
    }
}

impl Wanted {
    /// That of an operation: by its table and its tool.
    pub(super) fn of(plan: &PlannedThreadMilling) -> Wanted {
        let (table, thread) = (&plan.of.table, &plan.of.thread);
        let inside = table.side == ThreadSide::Inside;
        let profile = profile(thread.form);
        let pitch_diameter = thread.diameter - profile.pitch_diameter * thread.pitch;
        let radius = |depth: f64| {
            // A hole narrows downwards, a boss widens.
            let wider = if inside { -depth } else { depth } * 0.5 * thread.taper;
            0.5 * (pitch_diameter + table.oversize) + wider
        };
        let crest = thread.pitch
            * 0.5
            * if inside { profile.pitch_diameter } else { profile.root_diameter - profile.pitch_diameter };
        let tool = 0.5 * plan.of.mill.diameter - crest;
        let cut = Cut { inside, pitch: thread.pitch, half_angle: profile.half_angle.to_radians(), tool };
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
            inside,
            rise: if thread.hand == Hand::Right { thread.pitch } else { -thread.pitch },
            rows: plan.of.mill.rows,
            heights: [table.top - plan.of.depth, table.top],
            radii: match thread.taper > 0.0 {
                true => (0..=NODES).map(|i| helix(plan.of.depth * (1.0 - i as f64 / NODES as f64))).collect(),
                false => vec![helix(0.0)],
            },
            counter_clockwise: counter_clockwise(inside, table.direction, plan.of.is_left_hand()),
            tolerance: plan.of.milling.tolerance,
            by_envelope: table.profile == MillProfile::Standard,
        }
    }

    /// Radius of the finished helix where the lowest row's middle has a height.
    fn radius(&self, z: f64) -> f64 {
        let [one] = self.radii[..] else {
            let [bottom, top] = self.heights;
            let share = (z - bottom) / (top - bottom) * NODES as f64;
            // Beyond both ends as in the last interval.
            let i = (share.floor().max(0.0) as usize).min(NODES - 1);
            let [low, high] = [self.radii[i], self.radii[i + 1]];
            return low + (high - low) * (share - i as f64);
        };
        one
    }

    /// Compares the helices of a thread; the largest deviation of twice their radius [mm].
    ///
    /// # Errors
    /// The first that is wrong, or what they leave out together.
    pub(super) fn compared(&self, axis: DVec2, helices: &[&PostedHelix]) -> Result<f64, Wrong> {
        let pitch = self.rise.abs();
        let (mut worst, mut phase, mut spans) = (0.0, None, Vec::new());
        for helix in helices {
            let wrong = |what: &str, numbers: [f64; 2], unit: &'static str| Wrong {
                what: what.to_owned(),
                numbers: Some((numbers, unit)),
                item: Some(helix.item),
            };
            let points = middles(&helix.about(axis), pitch);
            let [first, .., last] = points[..] else {
                return Err(wrong("a helix of the text has no points", [points.len() as f64, 2.0], ""));
            };
            let forwards = if self.counter_clockwise { last.turned } else { -last.turned };
            let runs = forwards > 0.0;
            if !runs {
                let sense = if self.counter_clockwise { "counter-clockwise" } else { "clockwise" };
                let what = format!("the helix does not run {sense}");
                return Err(wrong(&what, [last.turned / TAU, last.turned / -TAU], "turns"));
            }
            let on_thread = |p: &About| (p.z - first.z - self.rise * p.turned / TAU).abs() <= self.tolerance;
            if !points.iter().all(on_thread) {
                let per_turn = (last.z - first.z) / last.turned * TAU;
                let what = "the helix does not have the pitch and hand of the thread";
                return Err(wrong(what, [per_turn, self.rise], "mm a turn"));
            }
            // Height of the groove at the angle of X, but for whole pitches.
            let starts = first.z - self.rise * helix.begins(axis) / TAU;
            let before: f64 = *phase.get_or_insert(starts);
            let shift = (((starts - before) / pitch + 0.5).rem_euclid(1.0) - 0.5) * pitch;
            let in_one = shift.abs() <= self.tolerance;
            if !in_one {
                return Err(wrong("its passes do not run in one groove", [shift, self.tolerance], "mm"));
            }
            for p in &points {
                let beyond = p.radius - self.radius(p.z);
                let deviation = 2.0 * if self.inside { beyond } else { -beyond };
                // A pass before the last leaves material.
                let fits = deviation <= self.tolerance && (!helix.finishing || deviation >= -self.tolerance);
                if !fits {
                    let what = if self.by_envelope {
                        "the pitch diameter by the helix of the text is off"
                    } else {
                        "the diameter of the helix in the text is off"
                    };
                    return Err(wrong(what, [deviation, self.tolerance], "mm"));
                }
                if helix.finishing {
                    worst = f64::max(worst, deviation.abs());
                }
            }
            if helix.finishing {
                if self.rows > 1 && forwards < TAU {
                    // Between its rows the groove would stay uncut over a part of the turn.
                    let what = "a helix of a tool with rows of teeth turns less than once";
                    return Err(wrong(what, [forwards / TAU, 1.0], "turns"));
                }
                let [low, high] = if first.z < last.z { [first.z, last.z] } else { [last.z, first.z] };
                spans.push([low, high + f64::from(self.rows.saturating_sub(1)) * pitch]);
            }
        }
        // A groove whose middle lies half a pitch over the mouth still opens below it.
        let groove = [self.heights[0], self.heights[1] + 0.5 * pitch];
        if let Some(left) = left_out(&spans, groove, HEIGHT) {
            let [a, b, bottom, top] = [left[0], left[1], groove[0], groove[1]].map(|z| trimmed(z, 3));
            let what = format!(
                "the helices of full depth leave Z {a} to Z {b} out: the middle of the groove runs from Z {bottom} to Z {top}"
            );
            return Err(Wrong { what, numbers: None, item: helices.first().map(|h| h.item) });
        }
        Ok(worst)
    }
}

/// Points of the tool's tip as those of the middle of its lowest row.
fn middles(points: &[About], pitch: f64) -> Vec<About> {
    points.iter().map(|p| About { z: p.z + 0.5 * pitch, ..*p }).collect()
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

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    const AXIS: DVec2 = DVec2::new(4.0, -3.0);

    /// M20x2.5 in a hole, 20 deep, on a helix of 3, counter-clockwise and upwards.
    fn m20(rows: u32) -> Wanted {
        Wanted {
            inside: true,
            rise: 2.5,
            rows,
            heights: [-20.0, 0.0],
            radii: vec![3.0],
            counter_clockwise: true,
            tolerance: 0.01,
            by_envelope: true,
        }
    }

    /// A helix that begins at an angle of 0, the middle of the lowest tooth at a height.
    fn helix(radius: f64, from: f64, turns: f64, rise: f64) -> PostedHelix {
        let count = (64.0 * turns.abs()).ceil();
        let point = |i: u32| {
            let turned = f64::from(i) / count * turns;
            let arm = radius * DVec2::from_angle(turned * TAU);
            (AXIS + arm).extend(from - 1.25 + rise * turned)
        };
        PostedHelix { item: 7, finishing: true, points: (0..=count as u32).map(point).collect() }
    }

    fn wrong(wanted: &Wanted, helices: &[&PostedHelix], part: &str) {
        let found = wanted.compared(AXIS, helices).expect_err(part);
        let finding = found.finding("M20x2.5");
        assert_eq!(finding.code, Code::THREAD_FORM);
        assert!(finding.message.contains(part), "no `{part}` in {}", finding.message);
    }

    #[test]
    fn a_single_row_is_compared_up_to_half_a_pitch_over_the_mouth() {
        let wanted = m20(1);
        assert!(wanted.compared(AXIS, &[&helix(3.0, -20.0, 8.5, 2.5)]).unwrap() < 1e-9);
        assert!((wanted.compared(AXIS, &[&helix(3.004, -20.0, 8.5, 2.5)]).unwrap() - 0.008).abs() < 1e-9);
        wrong(&wanted, &[&helix(3.0, -20.0, 8.0, 2.5)], "leave Z 0 to Z 1.25 out");
        wrong(&wanted, &[&helix(3.0, -19.99, 8.5, 2.5)], "leave Z -20 to Z -19.99 out");
        wrong(&wanted, &[&helix(3.006, -20.0, 8.5, 2.5)], "pitch diameter by the helix");
        wrong(&wanted, &[&helix(2.994, -20.0, 8.5, 2.5)], "pitch diameter by the helix");
        wrong(&wanted, &[&helix(3.0, -20.0, 8.5, 2.51)], "pitch and hand");
        wrong(&wanted, &[&helix(3.0, 1.25, 8.5, -2.5)], "pitch and hand");
        wrong(&wanted, &[&helix(3.0, 1.25, -8.5, 2.5)], "does not run counter-clockwise");
        let rough = PostedHelix { finishing: false, ..helix(3.0, -20.0, 8.5, 2.5) };
        wrong(&wanted, &[&rough], "leave Z -20 to Z 1.25 out");
        wrong(&wanted, &[], "leave Z -20 to Z 1.25 out");
        let shallow = PostedHelix { finishing: false, ..helix(2.5, -20.0, 8.5, 2.5) };
        assert!(wanted.compared(AXIS, &[&shallow, &helix(3.0, -20.0, 8.5, 2.5)]).is_ok());
        wrong(&wanted, &[&shallow, &helix(3.0, -20.5, 9.0, 2.5)], "one groove");
    }

    #[test]
    fn what_has_no_points_or_is_no_number_is_wrong() {
        for counter_clockwise in [true, false] {
            let wanted = Wanted { counter_clockwise, ..m20(1) };
            let turns = if counter_clockwise { 8.5 } else { -8.5 };
            let good = helix(3.0, if counter_clockwise { -20.0 } else { 1.25 }, turns, 2.5);
            assert!(wanted.compared(AXIS, &[&good]).is_ok());
            wrong(&wanted, &[&good, &PostedHelix { points: Vec::new(), ..good.clone() }], "no points");
            let one = good.points[..1].to_vec();
            wrong(&wanted, &[&good, &PostedHelix { points: one, ..good.clone() }], "no points");
            for at in [0, 20, good.points.len() - 1] {
                for bad in [DVec3::X, DVec3::Y, DVec3::Z] {
                    let mut points = good.points.clone();
                    points[at] += bad * f64::NAN;
                    let bad = PostedHelix { points, ..good.clone() };
                    assert!(wanted.compared(AXIS, &[&bad]).is_err(), "{at}");
                }
            }
        }
    }

    #[test]
    fn rows_of_teeth_turn_once_and_leave_no_gap() {
        let wanted = m20(6);
        let [low, high] = [-20.0, -12.5].map(|from| helix(3.0, from, 1.125, 2.5));
        assert!(wanted.compared(AXIS, &[&low, &high]).unwrap() < 1e-9);
        assert!(wanted.compared(AXIS, &[&high, &low]).is_ok());
        wrong(&wanted, &[&low], "leave Z -4.688 to Z 1.25 out");
        wrong(&wanted, &[&high], "leave Z -20 to Z -12.5 out");
        let part = helix(3.0, -12.5, 0.9, 2.5);
        wrong(&wanted, &[&low, &part], "turns less than once");
        // Three rows reach 7.8 mm in a step: one of ten leaves a gap.
        let wanted = m20(3);
        let steps = [-20.0, -10.0, -5.0].map(|from| helix(3.0, from, 1.125, 2.5));
        wrong(&wanted, &[&steps[0], &steps[1], &steps[2]], "leave Z -12.188 to Z -10 out");
        let steps = [-20.0, -15.0, -10.0, -5.0].map(|from| helix(3.0, from, 1.125, 2.5));
        assert!(wanted.compared(AXIS, &steps.each_ref()).is_ok());
    }

    #[test]
    fn a_profile_of_the_maker_is_compared_by_the_radius_alone() {
        let wanted = Wanted { by_envelope: false, ..m20(1) };
        assert!(wanted.compared(AXIS, &[&helix(3.0, -20.0, 8.5, 2.5)]).is_ok());
        wrong(&wanted, &[&helix(3.006, -20.0, 8.5, 2.5)], "diameter of the helix in the text");
    }
}
