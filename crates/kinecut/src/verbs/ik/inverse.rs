//! Poses to joint positions: all solutions.

use std::fmt::Write as _;

use glam::DVec3;
use serde::Serialize;

use crate::base::{Code, Finding, Result};
use crate::machine::{JointValues, Machine};
use crate::page::{Block, Section};
use crate::verbs::Answer;
use crate::verbs::poses::PoseWords;
use crate::verbs::poses::{AxisValues, outside, triple};

/// Settings of the search, other than the poses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InverseWants {
    /// Axes that are held, with their positions; axes that a pose leaves open take theirs from here too.
    pub locked: AxisValues,
    /// Length of the tool from the gauge point [mm].
    pub length: f64,
}

/// Joint positions for a pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InverseSolution {
    /// Joint positions.
    pub joints: AxisValues,
    /// Whether an axis is not determined by the pose.
    pub singular: bool,
    /// Whether all axes are within their travel.
    pub within_travel: bool,
    /// Axes outside their travel.
    pub outside: Vec<Finding>,
}

impl InverseSolution {
    /// As a person reads it: positions, and what is wrong with them.
    pub(crate) fn text(&self) -> String {
        let mut out = self.joints.words();
        if self.singular {
            out.push_str("  (singular: an axis is free)");
        }
        for f in &self.outside {
            let _ = write!(out, "  ({f})");
        }
        out
    }
}

/// All joint positions for a pose in the frame of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InversePose {
    /// The tip [mm].
    pub tip: [f64; 3],
    /// Direction of the tool, a unit vector; none for a machine of two translations and one rotation, which follows the
    /// tip only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The solutions; those within travel first.
    pub solutions: Vec<InverseSolution>,
}

impl InversePose {
    /// Whether there is a solution within travel.
    pub fn reachable(&self) -> bool {
        self.solutions.iter().any(|s| s.within_travel)
    }
}

impl Answer for InversePose {
    fn sections(&self) -> Vec<Section> {
        let axis = self.axis.map_or_else(String::new, |axis| format!("  axis {}", triple(axis)));
        let solutions = self.solutions.iter().map(InverseSolution::text).collect();
        vec![Section::new(format!("tip {}{axis}", triple(self.tip))).with(Block::List(solutions))]
    }

    fn is_no(&self) -> bool {
        !self.reachable()
    }
}

/// Tip and direction of a pose given as words: X Y Z, and I J K (default 0 0 1).
pub(crate) fn pose(words: &PoseWords) -> Result<(DVec3, Option<DVec3>)> {
    let mut numbers = [None; 6];
    for &(letter, value) in &words.words {
        let Some(i) = "XYZIJK".find(letter) else {
            return Err(Finding::error(Code::JOB_SHAPE, format!("a pose has no word {letter}"))
                .help("write X Y Z of the tip and I J K of the tool's direction")
                .key(letter.to_string())
                .into());
        };
        if numbers[i].replace(value).is_some() {
            return Err(Finding::error(Code::JOB_SHAPE, format!("{letter} is given twice"))
                .key(letter.to_string())
                .into());
        }
    }
    let tip = DVec3::from_array(std::array::from_fn(|i| numbers[i].unwrap_or(0.0)));
    let named = numbers[3..].iter().any(Option::is_some);
    let axis = DVec3::from_array(std::array::from_fn(|i| numbers[i + 3].unwrap_or(0.0)));
    Ok((tip, named.then_some(axis)))
}

/// Which axes are held, and the positions of all that are given.
pub(crate) fn held(machine: &Machine, locked: &AxisValues) -> Result<(JointValues, Vec<bool>)> {
    let values = locked.joints(machine)?;
    let flags = machine.joints.iter().map(|j| locked.0.iter().any(|(letter, _)| *letter == j.letter));
    Ok((values, flags.collect()))
}

/// Whether it has two translations and one rotation, and so follows the tip only.
pub(crate) fn is_polar(machine: &Machine, locked: &[bool]) -> bool {
    let free = machine.joints.iter().zip(locked).filter(|(_, locked)| !**locked);
    let rotations: Vec<bool> = free.map(|(j, _)| j.motion.is_rotation()).collect();
    rotations.len() == 3 && rotations.iter().filter(|r| **r).count() == 1
}

/// All joint positions for a pose given as words.
///
/// # Errors
/// `KC1111` for a direction that the machine does not reach, with the degrees by which it lies outside; `KC1112` for a tip
/// out of reach, `KC1113` for a machine with too many axes that are not held; `KC0102`, `KC0703` for wrong words.
pub fn inverse(machine: &Machine, words: &PoseWords, wants: &InverseWants) -> Result<InversePose> {
    let (tip, axis) = pose(words)?;
    let (given, locked) = held(machine, &wants.locked)?;
    let chain = machine.kinematics(wants.length);
    let polar = is_polar(machine, &locked) && axis.is_none();
    let direction = axis.unwrap_or(DVec3::Z);
    let found = if polar {
        chain.inverse_polar_locked(tip, &given, &locked)?
    } else {
        chain.inverse_locked(tip, direction, &given, &locked)?
    };
    let mut solutions: Vec<InverseSolution> = found
        .iter()
        .map(|s| {
            let outside = outside(machine, &s.values);
            InverseSolution {
                joints: AxisValues::of(machine, &s.values),
                singular: s.singular,
                within_travel: outside.is_empty(),
                outside,
            }
        })
        .collect();
    solutions.sort_by_key(|s| !s.within_travel);
    let axis = direction.try_normalize().filter(|_| !polar).map(|d| d.to_array());
    Ok(InversePose { tip: tip.to_array(), axis, solutions })
}
