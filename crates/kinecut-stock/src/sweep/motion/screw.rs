//! The motion of a constant twist.

use glam::DMat3;

use crate::geom::Rigid;
use crate::machine::kinematics::Twist;
use crate::num::series::{one_minus_cos, v_minus_sin};

/// Rigid motion by which a constant twist has carried the tool after `t`.
pub(super) fn motion(twist: &Twist, t: f64) -> Rigid {
    let angle = twist.turn.length() * t;
    let Some(axis) = twist.turn.try_normalize() else {
        return Rigid::from_translation(twist.shift * t);
    };
    // The part along the axis goes straight, the one across runs on a circle; both by the length of the turn, without
    // cancellation for small angles.
    let v = twist.shift * t;
    let across = axis.cross(v);
    let scale = |f: f64| if angle == 0.0 { 0.0 } else { f / angle };
    let translation =
        v + across * scale(one_minus_cos(angle)) + axis.cross(across) * scale(v_minus_sin(angle));
    Rigid { rotation: DMat3::from_axis_angle(axis, angle), translation }
}
