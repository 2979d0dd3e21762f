//! Paths of the joints: one solution for each pose of a path of the tool, so that the whole path turns least.
//!
//! A pose has one or two solutions, and each rotary axis any whole turn inside its travel. Of all these the path with the
//! least cost is found by dynamic programming over the poses (Viterbi): choosing pose by pose (nearest first) runs into the
//! end of the travel of an axis where another start would not. A step that turns an axis far is a change of solution
//! (flip) or an unwinding: the tool must be retracted for it, which has its own cost.
//!
//! Axes with more than a turn of travel are taken as endless first, which leaves few candidates; where that best path stays
//! inside the travel it is the best of all. Otherwise all turns inside the travel compete.

mod candidates;
mod search;

use std::f64::consts::TAU;

use glam::DVec3;

use super::Kinematics;
use super::inverse::{Solution, Solutions};
use super::limits::Travels;
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::machine::{JointValues, MOST_JOINTS};
use search::Search;

/// A pose of the tool in workpiece coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolPose {
    /// Tip [mm].
    pub tip: DVec3,
    /// Direction from tip to holder, any length; `None` when it does not matter and follows (a polar machine).
    pub axis: Option<DVec3>,
}

/// Cost of a step between two poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepCost {
    /// Travel of the rotary axes, each times a weight [1/rad], by joint.
    Travel([f64; MOST_JOINTS]),
    /// Time of the slowest rotary axis [s], from the speeds of the joints [rad/s].
    Time([f64; MOST_JOINTS]),
}

/// Travels, costs and conditions by which a path is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// Travel of the joints.
    pub travels: Travels,
    /// Joints held at their position of `start`, or of `held` where there is no start.
    pub locked: [bool; MOST_JOINTS],
    /// Positions of held joints where there is no start; open axes take theirs from here too.
    pub held: JointValues,
    /// Positions before the path; its cost includes the way from there. None when they are free.
    pub start: Option<JointValues>,
    /// Cost of a step.
    pub cost: StepCost,
    /// A step that turns a rotary axis by more than this [rad] needs a retracted tool.
    pub retract_step: f64,
    /// Additional cost of a step with a retracted tool, in the unit of the cost.
    pub retract_cost: f64,
    /// True if steps with a retracted tool are allowed.
    pub may_retract: bool,
    /// A joint that should start at a positive position, if that costs less than a retraction.
    pub prefer_positive: Option<usize>,
    /// Largest accepted angle of a direction outside of what the axes reach [rad]; see [`Kinematics::inverse_nearest`].
    pub allowance: f64,
}

impl PathOptions {
    /// Nearest solutions from home, inside the travel: the travel of all rotary axes counts alike, a step of more than 60
    /// degrees is a retraction and costs as much as 1000 degrees.
    pub fn new(travels: Travels) -> PathOptions {
        PathOptions {
            travels,
            locked: [false; MOST_JOINTS],
            held: JointValues::zero(MOST_JOINTS),
            start: Some(JointValues::zero(MOST_JOINTS)),
            cost: StepCost::Travel([1.0; MOST_JOINTS]),
            retract_step: 60f64.to_radians(),
            retract_cost: 1000f64.to_radians(),
            may_retract: true,
            prefer_positive: None,
            allowance: 0.0,
        }
    }
}

/// Reason for which the tool is retracted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RetractKind {
    /// Another solution is taken, or a rotary axis turns while the tool is parallel to it.
    Flip,
    /// An axis goes back by whole turns.
    Unwind,
}

/// A step for which the tool must be retracted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retract {
    /// Index of the pose after the step.
    pub index: usize,
    /// Reason.
    pub kind: RetractKind,
    /// The joint that turns farthest.
    pub joint: usize,
    /// Turn of that joint [rad].
    pub travel: f64,
}

/// Positions of the joints along a path.
#[derive(Clone, Debug, PartialEq)]
pub struct JointPath {
    /// One for each pose.
    pub values: Vec<JointValues>,
    /// Cost of the steps, that from the start included, retractions too.
    pub cost: f64,
    /// Steps for which the tool must be retracted.
    pub retracts: Vec<Retract>,
}

impl Kinematics {
    /// The joint positions along a path of poses that cost least. At a pose that leaves an axis open, the axis keeps the
    /// position it had.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::base::Silent;
    /// use kinecut::machine::kinematics::{PathOptions, ToolPose};
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let code = CoordinateCode::parse("641203").unwrap();
    /// let machine = Machine::new(code, [None; 3], Default::default()).unwrap();
    /// // The tool goes twice around, inclined: C turns through 720 degrees.
    /// let poses: Vec<ToolPose> = (0..=72)
    ///     .map(|i| {
    ///         let (sin, cos) = (f64::from(i) * 10f64.to_radians()).sin_cos();
    ///         ToolPose { tip: DVec3::ZERO, axis: Some(DVec3::new(cos, sin, 1.0)) }
    ///     })
    ///     .collect();
    /// let chain = machine.kinematics(0.0);
    /// let path = chain.path(&poses, &PathOptions::new(machine.travels()), &Silent).unwrap();
    /// assert!(path.retracts.is_empty());
    /// assert!(((path.values[72][0] - path.values[0][0]).to_degrees() - 720.0).abs() < 1e-9);
    /// ```
    ///
    /// # Errors
    /// Those of [`Kinematics::inverse`], with the index of the pose; `KC1115` when no solution of a pose lies inside the
    /// travel; `KC1116` when the tool would have to be retracted and must not; `KC0009` when cancelled.
    pub fn path(
        &self,
        poses: &[ToolPose],
        options: &PathOptions,
        progress: &dyn Progress,
    ) -> Result<JointPath> {
        if poses.is_empty() {
            return Ok(JointPath { values: Vec::new(), cost: 0.0, retracts: Vec::new() });
        }
        let mut found = Vec::with_capacity(poses.len());
        let given = options.start.unwrap_or(options.held);
        for (index, pose) in poses.iter().enumerate() {
            found.push(self.solutions(pose, &given, options).map_err(|error| at_pose(error, index, pose))?);
        }
        let search = Search::new(self, poses, options, &found, progress);
        // Endless first: exact when it stays inside the travel.
        if search.has_wide_travel()
            && let Ok(path) = search.run(true)
            && search.inside(&path.values)
        {
            return Ok(path);
        }
        search.run(false)
    }

    fn solutions(&self, pose: &ToolPose, given: &[f64], options: &PathOptions) -> Result<Solutions> {
        match pose.axis {
            Some(axis) => self.inverse_nearest(pose.tip, axis, given, &options.locked, options.allowance),
            None => self.inverse_polar_locked(pose.tip, given, &options.locked),
        }
    }
}

fn at_pose(mut error: Error, index: usize, pose: &ToolPose) -> Error {
    error.0.message = format!("pose {index}: {}", error.0.message);
    error.0.key.get_or_insert_with(|| format!("pose[{index}]"));
    error.0.item.get_or_insert(index as u32);
    if pose.tip.is_finite() {
        error.0.point = Some(pose.tip.to_array());
    }
    error
}

/// The error when no solution lies inside the travel: the joint of the solution that lacks least.
fn outside_travel(solutions: &[Solution], rotary: &[bool], options: &PathOptions, index: usize) -> Finding {
    let lack = |solution: &Solution| {
        let lacks = solution.values.iter().enumerate().map(|(joint, &value)| {
            let turned = if rotary[joint] { nearest_turn(&options.travels, joint, value) } else { value };
            (joint, turned, options.travels.beyond(joint, turned))
        });
        lacks.max_by(|a, b| a.2.total_cmp(&b.2))
    };
    let worst = solutions.iter().filter_map(lack).min_by(|a, b| a.2.total_cmp(&b.2));
    let Some((joint, value, _)) = worst else {
        return Finding::error(Code::OUTSIDE_TRAVEL, format!("pose {index} has no solution"));
    };
    let [least, most] = options.travels.0[joint].unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let bound = if value < least { least } else { most };
    let message =
        format!("pose {index}: no solution lies inside the travel; joint {} lacks least", joint + 1);
    let finding = Finding::error(Code::OUTSIDE_TRAVEL, message);
    let finding = if rotary[joint] {
        finding.value(value.to_degrees(), "degrees").bound(bound.to_degrees(), "degrees")
    } else {
        finding.value_mm(value).bound_mm(bound)
    };
    finding.key(format!("pose[{index}]")).item(index as u32).help("move or turn the workpiece on the machine")
}

/// The whole turn of an angle that lies nearest to the travel of a joint.
fn nearest_turn(travels: &Travels, joint: usize, angle: f64) -> f64 {
    let Some([least, most]) = travels.0[joint] else { return angle };
    let middle = 0.5 * (least + most);
    angle + ((middle - angle) / TAU).round() * TAU
}
