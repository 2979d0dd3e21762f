//! Kinematics of a chain of joints from workpiece to tool, as a product of exponentials at home.
//!
//! `T(q) = work^-1 exp(x1 s1 q1) ... exp(xn sn qn) tool`: directions and points of all joints are those of the machine at
//! home, which is what a probe measures; nothing special is needed for inclined axes and offsets.

mod forward;
mod inverse;
mod jacobian;
mod limits;
mod linear;
mod links;
mod mobility;
mod path;
mod reach;

pub use inverse::{Solution, Solutions};
pub use jacobian::{Jacobian, Twist};
pub use limits::Travels;
pub use linear::{LinearDeviation, LinearMove, LinearOptions, Orientation};
pub use path::{JointPath, PathOptions, Retract, RetractKind, StepCost, ToolPose};
pub use reach::{DirectionReach, OrientationCover, sphere_directions};

use glam::{DMat3, DVec3};

use super::{Joint, MOST_JOINTS};
use crate::geom::Rigid;

/// A joint ready for evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Screw {
    rotary: bool,
    /// Unit direction at home, times the sense.
    direction: DVec3,
    /// A point of the axis at home.
    point: DVec3,
}

impl Screw {
    const NONE: Screw = Screw { rotary: false, direction: DVec3::ZERO, point: DVec3::ZERO };

    /// The motion by `value` [mm or rad].
    fn motion(&self, value: f64) -> Rigid {
        if self.rotary {
            let rotation = self.turn(value);
            Rigid { rotation, translation: self.point - rotation * self.point }
        } else {
            Rigid::from_translation(self.direction * value)
        }
    }

    /// This joint, carried along by a motion.
    fn moved(&self, by: &Rigid) -> Screw {
        Screw { rotary: self.rotary, direction: by.vector(self.direction), point: by.point(self.point) }
    }
}

/// The chain of a machine with a tool, ready for evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct Kinematics {
    screws: [Screw; MOST_JOINTS],
    count: usize,
    /// Machine frame at home to workpiece.
    to_work: Rigid,
    /// True if that is the identity, as it nearly always is.
    work_at_home: bool,
    /// Tip frame at home.
    tool: Rigid,
    /// True if the tool is not turned at home.
    upright: bool,
    /// Geometry of the rotary axes that is the same for all directions; `None` unless the chain has two.
    pair: Option<inverse::Pair>,
    /// The rotary axes of a chain that has two.
    rotaries: Option<forward::TwoRotaries>,
}

impl Kinematics {
    /// The chain of these joints; `work` maps workpiece coordinates into the machine frame at home, `tool` those of the
    /// tip frame (Z from tip to holder). Joints beyond [`MOST_JOINTS`] are left out; a checked machine has none.
    pub fn new(joints: &[Joint], work: Rigid, tool: Rigid) -> Kinematics {
        let mut screws = [Screw::NONE; MOST_JOINTS];
        let count = joints.len().min(MOST_JOINTS);
        for (screw, joint) in screws.iter_mut().zip(joints) {
            *screw = Screw {
                rotary: joint.motion.is_rotation(),
                direction: joint.direction * joint.sense,
                point: joint.point,
            };
        }
        let mut rotary = screws[..count].iter().filter(|screw| screw.rotary);
        let pair = match (rotary.next(), rotary.next(), rotary.next()) {
            (Some(first), Some(second), None) => {
                Some(inverse::Pair::new(first, second, tool.rotation.z_axis))
            }
            _ => None,
        };
        Kinematics {
            screws,
            count,
            to_work: work.inverse(),
            work_at_home: work == Rigid::IDENTITY,
            tool,
            upright: tool.rotation == DMat3::IDENTITY,
            pair,
            rotaries: forward::TwoRotaries::of(&screws[..count]),
        }
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.count
    }
}
