//! Reasons why a machine cannot make a surface.

use glam::DVec3;

use super::Hold;
use crate::base::{Code, Finding, Quantity};
use crate::machine::Machine;

/// An obstacle that keeps a machine from a task.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// The machine's part and the tool's part of the chain share a variable, or contradict themselves.
    NotRigid {
        /// Fault of the split, in words.
        reason: String,
    },
    /// No joint positions reach a pose.
    Unreached {
        /// From the nearest tip to the wanted one, in the wanted frame of the tool [mm].
        shift: DVec3,
        /// Rotation from the nearest direction or frame to the wanted one, in the wanted frame of the tool [rad].
        turn: DVec3,
        /// Values of the variables.
        at: [f64; 2],
        /// Wanted tip [mm].
        point: DVec3,
        /// Independent motions that the machine has there, of those that the task needs.
        rank: usize,
    },
    /// An axis would leave its travel.
    Travel {
        /// Place of the axis in the code.
        joint: usize,
        /// Farthest position [mm or rad].
        value: f64,
        /// Bound of the travel [mm or rad].
        bound: f64,
        /// Values of the variables at the farthest position.
        at: [f64; 2],
        /// Tip there [mm].
        point: DVec3,
    },
    /// A rotary axis would have to jump: the way passes a singular place.
    Jump {
        /// Place of the axis in the code.
        joint: usize,
        /// Size of the jump [mm or rad].
        by: f64,
        /// Values of the variables.
        at: [f64; 2],
        /// Tip there [mm].
        point: DVec3,
    },
}

impl Obstacle {
    /// The obstacle as a finding, `KC1132`.
    pub fn finding(&self, machine: &Machine, hold: Hold, names: &[String; 2]) -> Finding {
        let place = |at: &[f64; 2]| {
            let shown = |k: usize| format!("{} = {}", names[k], Quantity::new(at[k], ""));
            // A motion of one variable has no name for a second one.
            (0..2).filter(|&k| !names[k].is_empty()).map(shown).collect::<Vec<_>>().join(", ")
        };
        let axis = |joint: usize| machine.joints.get(joint).map_or('?', |j| j.letter);
        let rotary = |joint: usize| machine.joints.get(joint).is_some_and(|j| j.motion.is_rotation());
        let quantity = |joint: usize, value: f64| {
            if rotary(joint) { (value.to_degrees(), "deg") } else { (value, "mm") }
        };
        let error = |message: String| Finding::error(Code::GENERATION_IMPOSSIBLE, message);
        match self {
            Obstacle::NotRigid { reason } => error(format!("the tool would not be rigid: {reason}"))
                .help("give the tool only motions whose variables the machine does not use"),
            Obstacle::Unreached { shift, turn, at, point, rank } => {
                let lacks = *rank < hold.conditions();
                let what = missing(*shift, *turn);
                let finding = if lacks {
                    error(format!("machine {} lacks a motion: {what}, at {}", machine.code, place(at)))
                        .help("take a machine with this motion, mount the tool so, or choose another split")
                } else {
                    error(format!("machine {} does not reach: {what}, at {}", machine.code, place(at))).help(
                        "tilt the work, mount the tool otherwise, or take a machine that reaches farther",
                    )
                };
                let finding = if turn.length() > ANGLE {
                    finding.value(turn.length().to_degrees(), "deg").bound(0.0, "deg")
                } else {
                    finding.value_mm(shift.length()).bound_mm(0.0)
                };
                finding.point(point.to_array())
            }
            Obstacle::Travel { joint, value, bound, at, point } => {
                let (value, unit) = quantity(*joint, *value);
                let (bound, _) = quantity(*joint, *bound);
                let beyond = Quantity::new((value - bound).abs(), unit);
                error(format!("axis {} leaves its travel by {beyond}, at {}", axis(*joint), place(at)))
                    .value(value, unit)
                    .bound(bound, unit)
                    .point(point.to_array())
                    .help("set the work elsewhere, take a tool of another length, or a machine with more travel")
            }
            Obstacle::Jump { joint, by, at, point } => {
                let (by, unit) = quantity(*joint, *by);
                error(format!(
                    "axis {} would have to jump: the way is singular at {}",
                    axis(*joint),
                    place(at)
                ))
                .value(by, unit)
                .bound(0.0, unit)
                .point(point.to_array())
                .help("tilt the work so that the tool does not come parallel to the axis of a rotation")
            }
        }
    }

    /// Distance from success, as a class and an amount in it: an axis that leaves its travel is nearest, then one that
    /// jumps, then a pose out of reach; a tool that is not rigid is farthest.
    pub(super) fn distance(&self, arm: f64) -> (u8, f64) {
        match self {
            Obstacle::Travel { value, bound, .. } => (0, (value - bound).abs()),
            Obstacle::Jump { by, .. } => (1, by.abs()),
            Obstacle::Unreached { shift, turn, .. } => (2, shift.length().hypot(turn.length() * arm)),
            Obstacle::NotRigid { .. } => (3, 0.0),
        }
    }
}

/// Missing motion in words.
fn missing(shift: DVec3, turn: DVec3) -> String {
    let mut parts = Vec::new();
    if turn.length() > ANGLE {
        parts.push(format!(
            "{} about {} of the tool",
            sensible(turn.length().to_degrees(), "degrees"),
            direction(turn)
        ));
    }
    if shift.length() > LENGTH {
        parts.push(format!("{} along {} of the tool", sensible(shift.length(), "mm"), direction(shift)));
    }
    if parts.is_empty() { "the pose is at the edge of the reach".to_owned() } else { parts.join(" and ") }
}

/// A quantity with four digits that count: in words its size is enough, the value of the finding has the rest.
fn sensible(value: f64, unit: &'static str) -> Quantity {
    if value == 0.0 || !value.is_finite() {
        return Quantity::new(value, unit);
    }
    let step = 10f64.powi(value.abs().log10().floor() as i32 - 3);
    Quantity::new((value / step).round() * step, unit)
}

/// A direction: an axis of coordinates, or three numbers.
fn direction(v: DVec3) -> String {
    let unit = v.normalize_or_zero();
    for (axis, name) in [(DVec3::X, "X"), (DVec3::Y, "Y"), (DVec3::Z, "Z")] {
        if unit.dot(axis).abs() > 1.0 - ALONG {
            return name.to_owned();
        }
    }
    format!("({:.3}, {:.3}, {:.3})", unit.x, unit.y, unit.z)
}

/// Angle [rad] and length [mm] below which nothing is missing.
const ANGLE: f64 = 1e-9;
const LENGTH: f64 = 1e-6;
/// One less the cosine below which a direction is called by the name of an axis: about a tenth of a degree.
const ALONG: f64 = 1e-6;
