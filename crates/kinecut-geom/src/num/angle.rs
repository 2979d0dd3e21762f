//! Angles [rad].

use std::f64::consts::{PI, TAU};

/// The angle in (-pi, pi].
///
/// ```
/// # use kinecut_geom as kinecut;
/// assert!((kinecut::num::angle::wrap(7.0) - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
/// ```
pub fn wrap(angle: f64) -> f64 {
    let r = angle - TAU * (angle / TAU).round();
    if r <= -PI { r + TAU } else { r }
}

/// The angle in [0, 2 pi).
pub fn wrap_positive(angle: f64) -> f64 {
    let r = angle.rem_euclid(TAU);
    if r >= TAU { 0.0 } else { r }
}

/// The sweep from `from` to `to`, counter-clockwise for `ccw`, in (0, 2 pi] (or [-2 pi, 0)): equal angles
/// make a full turn, as a circle with equal start and end does on every control.
pub fn sweep(from: f64, to: f64, ccw: bool) -> f64 {
    let d = wrap_positive(if ccw { to - from } else { from - to });
    let d = if d == 0.0 { TAU } else { d };
    if ccw { d } else { -d }
}
