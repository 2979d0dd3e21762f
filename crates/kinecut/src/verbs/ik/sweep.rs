//! A spare axis: a machine with more axes than a pose needs has one that can be held anywhere. It is swept over its travel;
//! at each place the others follow from the pose.
//!
//! The best place to hold it along a path is the one with the fewest retractions; of these the one with the greatest margin,
//! of these the least turning of rotary axes, and of these the
//! one nearest to zero. The margin of a set of positions is the least of: for each axis that
//! moves, its distance from the nearer end of its travel as a share of half the travel; and how well the rotary axes turn
//! the tool, `|(a1 x u) x (a2 x u)|` for two of them (`|a x u|` for one) with directions `a` and the tool along `u`: zero at a
//! singular pose, one at best. The margin of a path is that of its worst pose. A grid over the travel is searched, then twice
//! more about its best place.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::inverse::{InverseSolution, InverseWants, inverse};
use super::path::{PathSheet, PathWants, path};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::{JointValues, Kinematics, Machine};
use crate::page::{Block, Cell, Fact, Row, Section, Table};
use crate::verbs::Answer;
use crate::verbs::poses::{AxisValues, number, triple};
use crate::verbs::poses::{PoseTexts, PoseWords};

/// Rounds of the search for the best place: over the travel, then between the neighbours of the best.
const ROUNDS: usize = 3;
/// Most places of a sweep: a place for each tenth of a degree.
pub const MOST_PLACES: usize = 3600;

/// Settings for sweeping a spare axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepWants {
    /// The axis.
    pub axis: char,
    /// Number of places over its travel, both ends included.
    pub places: usize,
}

/// Nearest limit of a set of positions, and the margin to it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Margin {
    /// From 0, at a limit or singular, to 1.
    pub margin: f64,
    /// The axis whose travel is nearest; none when the rotary axes are nearest to a singular pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<char>,
}

/// A place of a swept axis, for one pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SweptPlace {
    /// Position of the swept axis [mm or deg].
    pub at: f64,
    /// Solutions there, those within travel first.
    pub solutions: Vec<InverseSolution>,
    /// Margin of the best solution within travel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<Margin>,
    /// Why there is no solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finding: Option<Finding>,
}

/// A pose with a swept axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SweptPose {
    /// The axis.
    pub axis: char,
    /// Its places, from the least.
    pub places: Vec<SweptPlace>,
    /// The place with the greatest margin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub best: Option<f64>,
}

/// A place of a swept axis, for a path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldPlace {
    /// Position of the swept axis [mm or deg].
    pub at: f64,
    /// Retractions of the tool.
    pub retracts: usize,
    /// Least margin along the path, with the index of its pose.
    pub margin: Option<(Margin, usize)>,
    /// Travel of the rotary axes [deg].
    pub cost_deg: f64,
    /// Why the path cannot be run there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finding: Option<Finding>,
}

/// A path with the best place of a swept axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SweptPath {
    /// The axis.
    pub axis: char,
    /// Best position of the axis [mm or deg].
    pub at: f64,
    /// All places that were tried, in the order of the axis.
    pub places: Vec<HeldPlace>,
    /// The path with the axis held there.
    pub path: PathSheet,
}

/// The travel of the swept axis [mm or rad] and its joint.
fn travel(machine: &Machine, wants: &SweepWants, locked: &AxisValues) -> Result<(usize, [f64; 2])> {
    AxisValues(vec![(wants.axis, 0.0)]).joints(machine)?;
    let fail = |message: String| Finding::error(Code::MACHINE_AXIS, message).key("sweep");
    if locked.0.iter().any(|(letter, _)| *letter == wants.axis) {
        return Err(fail(format!("axis {} is held and swept", wants.axis))
            .help("leave it out of --lock")
            .into());
    }
    if !(2..=MOST_PLACES).contains(&wants.places) {
        return Err(fail("a sweep has two places at least".to_owned())
            .value(wants.places as f64, "places")
            .bound(MOST_PLACES as f64, "places")
            .key("places")
            .into());
    }
    let joint = machine.joint(wants.axis).map(|(i, joint)| (i, joint.motion.is_rotation(), joint.travel));
    match joint {
        Some((i, _, Some(travel))) => Ok((i, travel)),
        Some((i, true, None)) => Ok((i, [-std::f64::consts::PI, std::f64::consts::PI])),
        _ => Err(fail(format!("the travel of axis {} is not known", wants.axis))
            .help("give it in the machine file")
            .into()),
    }
}

impl SweepWants {
    /// Checks the axis and the number of places.
    ///
    /// # Errors
    /// `KC0703` for an axis that the machine does not have, that is held, or whose travel is not known, and for too many or
    /// too few places.
    pub fn check(&self, machine: &Machine, locked: &AxisValues) -> Result<()> {
        travel(machine, self, locked).map(|_| ())
    }
}

/// Places from `low` to `high`, both included.
fn grid([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    let share = |i: usize| i as f64 / (count - 1) as f64;
    (0..count).map(|i| low + (high - low) * share(i)).collect()
}

fn shown(machine: &Machine, joint: usize, value: f64) -> f64 {
    if machine.joints[joint].motion.is_rotation() { value.to_degrees() } else { value }
}

/// The same with one more axis held [mm or deg].
fn with_held(wants: &InverseWants, axis: char, at: f64) -> InverseWants {
    let mut wants = wants.clone();
    wants.locked.0.push((axis, at));
    wants
}

/// The margin of a set of positions; axes that are held do not count.
fn margin(machine: &Machine, chain: &Kinematics, held: &[char], q: &[f64]) -> Margin {
    let mut least = Margin { margin: 1.0, axis: None };
    for (joint, &value) in machine.joints.iter().zip(q).filter(|(j, _)| !held.contains(&j.letter)) {
        let Some([low, high]) = joint.travel else { continue };
        let share = ((value - low).min(high - value) / (0.5 * (high - low))).clamp(0.0, 1.0);
        if share < least.margin {
            least = Margin { margin: share, axis: Some(joint.letter) };
        }
    }
    let jacobian = chain.jacobian(q);
    let rotary = machine.joints.iter().enumerate().filter(|(_, j)| j.motion.is_rotation());
    let rates: Vec<DVec3> =
        rotary.filter(|(_, j)| !held.contains(&j.letter)).map(|(i, _)| jacobian.axis_rate(i)).collect();
    let turning = match rates[..] {
        [a] => a.length(),
        [a, b] => a.cross(b).length(),
        _ => 1.0,
    };
    if turning < least.margin {
        least = Margin { margin: turning, axis: None };
    }
    least
}

/// All solutions for a pose with an axis at places over its travel.
///
/// # Errors
/// `KC0703` for an axis that the machine does not have, that is held, or whose travel is not known, and for too many places;
/// `KC0102` for words that are no pose. A place without a solution says why itself.
pub fn sweep(
    machine: &Machine,
    words: &PoseWords,
    wants: &InverseWants,
    swept: &SweepWants,
) -> Result<SweptPose> {
    let (joint, range) = travel(machine, swept, &wants.locked)?;
    super::inverse::pose(words)?;
    let chain = machine.kinematics(wants.length);
    let places = grid(range, swept.places).into_iter().map(|at| {
        let at = shown(machine, joint, at);
        let wants = with_held(wants, swept.axis, at);
        let held: Vec<char> = wants.locked.0.iter().map(|w| w.0).collect();
        match inverse(machine, words, &wants) {
            Ok(found) => {
                let inside = found.solutions.iter().filter(|s| s.within_travel);
                let margins = inside.filter_map(|s| {
                    let q = s.joints.joints(machine).ok()?;
                    Some(margin(machine, &chain, &held, &q))
                });
                let margin = margins.max_by(|a, b| a.margin.total_cmp(&b.margin));
                SweptPlace { at, solutions: found.solutions, margin, finding: None }
            }
            Err(e) => SweptPlace { at, solutions: Vec::new(), margin: None, finding: Some(*e.0) },
        }
    });
    let places: Vec<SweptPlace> = places.collect();
    let with_margin = places.iter().filter_map(|p| p.margin.as_ref().map(|m| (p.at, m.margin)));
    let key = |p: &(f64, f64)| (steps(p.1, MARGIN_STEP), -p.0.abs());
    let best = with_margin.max_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)));
    let best = best.map(|b| b.0);
    Ok(SweptPose { axis: swept.axis, places, best })
}

/// A path with an axis held where it is best; see the head of this file for what is best.
///
/// # Errors
/// As [`sweep`]; when the path can be run nowhere, the reason at the place where it fails last; `KC0009` when cancelled.
pub fn sweep_path(
    machine: &Machine,
    poses: &PoseTexts,
    wants: &PathWants,
    swept: &SweepWants,
    progress: &dyn Progress,
) -> Result<SweptPath> {
    let (joint, range) = travel(machine, swept, &wants.poses.locked)?;
    let chain = machine.kinematics(wants.poses.length);
    let held_at = |at: f64| PathWants {
        poses: with_held(&wants.poses, swept.axis, at),
        straight: None,
        ..wants.clone()
    };
    let mut held: Vec<char> = wants.poses.locked.0.iter().map(|w| w.0).collect();
    held.push(swept.axis);
    let tried = |&at: &f64| -> HeldPlace {
        let at = shown(machine, joint, at);
        match path(machine, poses, &held_at(at), progress) {
            Ok(sheet) => {
                let joints = sheet.joints.iter().filter_map(|v| v.joints(machine).ok());
                let margins = joints
                    .enumerate()
                    .map(|(i, q): (usize, JointValues)| (margin(machine, &chain, &held, &q), i));
                let margin = margins.reduce(|a, b| if b.0.margin < a.0.margin { b } else { a });
                let retracts = sheet.retracts.len();
                HeldPlace { at, retracts, margin, cost_deg: sheet.cost_deg, finding: None }
            }
            Err(e) => HeldPlace { at, retracts: 0, margin: None, cost_deg: 0.0, finding: Some(*e.0) },
        }
    };
    let mut places: Vec<HeldPlace> = Vec::new();
    let mut range = range;
    for _ in 0..ROUNDS {
        let ats = grid(range, swept.places);
        let found: Vec<HeldPlace> = ats.par_iter().map(tried).collect();
        if let Some(f) = found.iter().filter_map(|p| p.finding.as_ref()).find(|f| f.code == Code::CANCELLED) {
            return Err(f.clone().into());
        }
        let Some(best) = (0..found.len())
            .filter(|&i| found[i].finding.is_none())
            .reduce(|a, b| if better(&found[b], &found[a]) { b } else { a })
        else {
            places.extend(found);
            break;
        };
        range = [ats[best.saturating_sub(1)], ats[(best + 1).min(ats.len() - 1)]];
        places.extend(found);
    }
    places.sort_by(|a, b| a.at.total_cmp(&b.at));
    places.dedup_by(|a, b| a.at == b.at);
    let runs = places.iter().filter(|p| p.finding.is_none());
    let Some(best) = runs.reduce(|a, b| if better(b, a) { b } else { a }) else {
        let farthest = places
            .into_iter()
            .filter_map(|p| p.finding)
            .reduce(|a, b| if pose_of(&b) > pose_of(&a) { b } else { a });
        let finding = farthest.unwrap_or_else(|| Finding::error(Code::PATH_BROKEN, "the path cannot be run"));
        let message = format!("wherever {} is held, {}", swept.axis, finding.message);
        return Err(Finding { message, ..finding }.into());
    };
    let at = best.at;
    let wants = PathWants { straight: wants.straight, ..held_at(at) };
    let path = path(machine, poses, &wants, progress)?;
    Ok(SweptPath { axis: swept.axis, at, places, path })
}

/// Whether a place is better than another one.
fn better(a: &HeldPlace, b: &HeldPlace) -> bool {
    let margin = |p: &HeldPlace| p.margin.as_ref().map_or(0.0, |m| m.0.margin);
    let order = a.retracts.cmp(&b.retracts);
    let order = order.then(steps(margin(b), MARGIN_STEP).total_cmp(&steps(margin(a), MARGIN_STEP)));
    let order = order.then(steps(a.cost_deg, COST_STEP).total_cmp(&steps(b.cost_deg, COST_STEP)));
    order.then(a.at.abs().total_cmp(&b.at.abs())).is_lt()
}

/// Margins this near are equal: rounding at places a whole turn apart.
const MARGIN_STEP: f64 = 1e-9;
/// Costs this near are equal [deg].
const COST_STEP: f64 = 1e-6;

fn steps(value: f64, step: f64) -> f64 {
    (value / step).round()
}

/// The index of the pose that a finding is about.
fn pose_of(finding: &Finding) -> usize {
    finding.item.unwrap_or(0) as usize
}

impl Margin {
    fn text(&self) -> String {
        match self.axis {
            Some(axis) => format!("{} (travel of {axis})", number((self.margin * 1e4).round() / 1e4)),
            None => format!("{} (singular pose)", number((self.margin * 1e4).round() / 1e4)),
        }
    }
}

impl SweptPose {
    /// Whether there is a solution within travel.
    pub fn reachable(&self) -> bool {
        self.best.is_some()
    }
}

impl Answer for SweptPose {
    fn is_no(&self) -> bool {
        !self.reachable()
    }

    fn sections(&self) -> Vec<Section> {
        let mut table = Table::new("", "; At; Margin; Solutions");
        table.notes.push("A star: the place with the greatest margin.".to_owned());
        for place in &self.places {
            let mark = if self.best == Some(place.at) { "*" } else { "" };
            let margin = place.margin.as_ref().map_or_else(String::new, Margin::text);
            let why = place.finding.iter().map(|finding| {
                let at = finding.point.map_or_else(String::new, |p| format!(" at {}", triple(p)));
                format!("{}{at}", finding.message)
            });
            let lines = why.chain(place.solutions.iter().map(InverseSolution::text));
            let heads = [mark.to_owned(), format!("{}{}", self.axis, number(place.at)), margin];
            let heads = std::iter::once(heads).chain(std::iter::repeat_with(Default::default));
            table.rows.extend(
                heads
                    .zip(lines)
                    .map(|(head, line)| Row::new(head.into_iter().chain([line]).map(Cell::new).collect())),
            );
        }
        vec![Section::default().with(table)]
    }
}

impl Answer for SweptPath {
    fn findings(&self) -> Vec<&Finding> {
        self.path.findings()
    }

    fn is_no(&self) -> bool {
        self.path.is_no()
    }

    fn sections(&self) -> Vec<Section> {
        let tried = self.places.len();
        let able = self.places.iter().filter(|p| p.finding.is_none()).count();
        let at = format!("{} held at {}", self.axis, number(self.at));
        let mut facts =
            vec![Fact::new("Best place", at).note(format!("{able} of {tried} places can be run"))];
        if let Some(best) = self.places.iter().find(|p| p.at == self.at) {
            facts.push(Fact::new("Retractions", best.retracts.to_string()));
            let margin = best.margin.iter();
            facts.extend(margin.map(|(margin, index)| {
                Fact::new("Least margin", format!("{} at pose[{index}]", margin.text()))
            }));
        }
        let mut sections = self.path.sections();
        sections.insert(0, Section::default().with(Block::Facts(facts)));
        sections
    }

    fn data(&self) -> Cow<'_, str> {
        self.path.data()
    }
}
