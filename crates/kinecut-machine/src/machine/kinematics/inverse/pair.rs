//! Two rotary axes and the tool: what they have in common for all directions.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::super::Screw;

/// Sine of the angle below which two axes are parallel: a direction normalised in double precision is this good.
const PARALLEL: f64 = 1e-12;

/// Geometry of two rotary axes and the tool that is the same for all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct Pair {
    /// Angles between the axes and from the second one to the tool [rad].
    pub(super) eta: f64,
    pub(super) zeta: f64,
    /// Sine and cosine of half the difference and half the sum of these angles, without sign.
    pub(super) half_difference: [f64; 2],
    pub(super) half_sum: [f64; 2],
    /// Angle of the second axis that turns the tool into the half-plane of the first, with its sine and cosine.
    pub(super) base: f64,
    pub(super) base_sin_cos: [f64; 2],
    /// The second axis does not change the tilt.
    pub(super) degenerate: bool,
}

impl Pair {
    pub(in super::super) fn new(first: &Screw, second: &Screw, x: DVec3) -> Pair {
        let (a1, a2) = (first.direction, second.direction);
        let (eta, zeta) = (angle(a1, a2), angle(a2, x));
        let base = turn_from_to(a2, across(a2, x), across(a2, a1));
        let half = |angle: f64| [(0.5 * angle).sin().abs(), (0.5 * angle).cos().abs()];
        Pair {
            eta,
            zeta,
            half_difference: half(eta - zeta),
            half_sum: half(eta + zeta),
            base,
            base_sin_cos: [base.sin(), base.cos()],
            degenerate: eta.sin().abs() < PARALLEL || zeta.sin().abs() < PARALLEL,
        }
    }
}

/// Angle between two vectors [rad], good to rounding for all angles.
pub(in super::super) fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// The part of `x` across the unit vector `a`.
#[inline]
pub(super) fn across(a: DVec3, x: DVec3) -> DVec3 {
    x - a * a.dot(x)
}

/// The angle about `a` from `x` to `y`, both across `a`.
pub(super) fn turn_from_to(a: DVec3, x: DVec3, y: DVec3) -> f64 {
    within_turn(a.dot(x.cross(y)).atan2(x.dot(y)))
}

/// `wrap` of an angle between -3 pi and 3 pi, without a division.
#[inline]
pub(super) fn within_turn(angle: f64) -> f64 {
    if angle > PI {
        angle - TAU
    } else if angle <= -PI {
        angle + TAU
    } else {
        angle
    }
}
