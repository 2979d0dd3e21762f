//! Joints that go straight: the twist of a chain of joints and its derivative.
//!
//! In coordinates of the workpiece the screw of joint i is carried by the joints before it, `xi_i' = sum_(j<i) [xi_j, xi_i] q_j'`;
//! in those of the tool both the sum and its derivative are carried back by the pose, as the bracket of a twist with itself
//! vanishes.

use crate::geom::Rigid;
use crate::machine::kinematics::Twist;
use crate::machine::{JointValues, Kinematics};

use super::MotionJet;

/// Positions at a part `t` of the way.
pub(super) fn between(from: &JointValues, to: &JointValues, t: f64) -> JointValues {
    let mut q = JointValues::zero(from.len());
    for (i, (a, b)) in from.iter().zip(to.iter()).enumerate() {
        q[i] = a + (b - a) * t;
    }
    q
}

/// Pose, twist and change of a chain whose joints go straight.
pub(super) fn jet(chain: &Kinematics, from: &JointValues, to: &JointValues, t: f64) -> MotionJet {
    let jacobian = chain.jacobian(&between(from, to, t));
    let mut before = Twist::default();
    let mut change = Twist::default();
    for (twist, (a, b)) in jacobian.twists().iter().zip(from.iter().zip(to.iter())) {
        let own = Twist { turn: twist.turn * (b - a), shift: twist.shift * (b - a) };
        let by = bracket(&before, &own);
        change = sum(&change, &by);
        before = sum(&before, &own);
    }
    let pose = jacobian.frame;
    MotionJet { pose, twist: carried_back(&pose, &before), change: carried_back(&pose, &change) }
}

fn sum(a: &Twist, b: &Twist) -> Twist {
    Twist { turn: a.turn + b.turn, shift: a.shift + b.shift }
}

/// Rate of a twist that is carried along by another.
fn bracket(a: &Twist, b: &Twist) -> Twist {
    Twist { turn: a.turn.cross(b.turn), shift: a.turn.cross(b.shift) - b.turn.cross(a.shift) }
}

/// A twist of the workpiece's coordinates in those of the tool.
fn carried_back(pose: &Rigid, twist: &Twist) -> Twist {
    let back = pose.rotation.transpose();
    Twist { turn: back * twist.turn, shift: back * twist.velocity(pose.translation) }
}
