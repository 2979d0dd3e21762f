//! Twists of the tool: from a pose and its rate, and made free of rounding.

use glam::{DMat3, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::Twist;

/// Part of a velocity that is rounding of another one.
const NOTHING: f64 = 1e-12;
/// Largest deviation of a pose matrix from a rotation, or of its rate from that of a rotation: six digits, as files carry.
const RIGID: f64 = 1e-6;

/// The twist of a tool in its own coordinates, from its pose (tool to workpiece) and the rate of the pose: of the matrix
/// `[R p; 0 1]` and its derivative the product `M^-1 M'`.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use glam::{DMat3, DVec3};
/// use kinecut::{geom::Rigid, sweep::twist_of};
/// // The tool stands at x = 10 and turns about Z of the workpiece: its tip moves along Y.
/// let pose = Rigid::from_translation(DVec3::new(10.0, 0.0, 0.0));
/// let rate = DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::ZERO);
/// let twist = twist_of(&pose, rate, DVec3::new(0.0, 10.0, 0.0)).unwrap();
/// assert_eq!((twist.shift.y, twist.turn.z), (10.0, 1.0));
/// ```
///
/// # Errors
/// `KC1202` when the matrix is no rotation, or its rate none of a rotation.
pub fn twist_of(pose: &Rigid, rate: DMat3, velocity: DVec3) -> Result<Twist> {
    let fail = |what: &str, value: f64| {
        Finding::error(Code::POSE_NOT_RIGID, what)
            .value(value, "")
            .bound(RIGID, "")
            .help("give a right-handed rotation matrix and the derivative of the same motion")
            .into()
    };
    let entries = [pose.rotation, rate].map(|m| m.to_cols_array());
    let finite = entries.iter().flatten().all(|e| e.is_finite());
    if !(finite && velocity.is_finite() && pose.translation.is_finite()) {
        return Err(fail("a pose or its rate has a number that is not finite", f64::NAN));
    }
    let back = pose.rotation.transpose();
    let skew = back * pose.rotation - DMat3::IDENTITY;
    let off = skew.to_cols_array().iter().fold(0.0f64, |m, e| m.max(e.abs()));
    if off > RIGID {
        return Err(fail("the matrix of a pose is no rotation", off));
    }
    if pose.rotation.determinant() < 0.0 {
        return Err(fail("the matrix of a pose is left-handed", pose.rotation.determinant()));
    }
    let turning = back * rate;
    let size = turning.to_cols_array().iter().fold(0.0f64, |m, e| m.max(e.abs()));
    let even = turning + turning.transpose();
    let off = even.to_cols_array().iter().fold(0.0f64, |m, e| m.max(0.5 * e.abs()));
    if off > RIGID * size {
        return Err(fail("the rate of a pose is not that of a rotation", off / size));
    }
    let turn = DVec3::new(
        0.5 * (turning.y_axis.z - turning.z_axis.y),
        0.5 * (turning.z_axis.x - turning.x_axis.z),
        0.5 * (turning.x_axis.y - turning.y_axis.x),
    );
    Ok(Twist { turn, shift: back * velocity })
}

/// The twist with parts set to zero that are rounding, by the lever `reach` of the tool [mm], and its size [mm per unit].
pub(super) fn clean(twist: &Twist, reach: f64) -> (Twist, f64) {
    let size = twist.shift.length() + twist.turn.length() * reach;
    let keep = |v: f64, lever: f64| if v.abs() * lever < NOTHING * size { 0.0 } else { v };
    let shift = twist.shift.to_array().map(|v| keep(v, 1.0));
    let turn = twist.turn.to_array().map(|w| keep(w, reach));
    (Twist { turn: DVec3::from(turn), shift: DVec3::from(shift) }, size)
}
