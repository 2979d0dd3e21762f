//! The roll angle of an involute at a given distance from the hole centre: equation (9), solved for certain.
//!
//! The involute `E(p) = r (cos p + p sin p - 1, sin p - p cos p)` leaves the hole centre at `p = 0` and osculates
//! a circle about it at every `p = 2 pi k`. Its distance from the centre, in base radii, is
//! `tau(p) = hypot(p - sin p, 1 - cos p)`: monotone, but flat to second order at every `2 pi k`, where a plain
//! Newton iteration diverges. The help is a variable in which the root is simple: a square root in the first
//! half turn, a cube root about each flat point; and Newton kept inside a bracket.
//!
//! Notation: `t` distance / base radius; `kappa` radius of the osculated circle / base radius (`2 pi k` for
//! the involute that starts in the centre, any number for one that does not); `d = t - kappa`;
//! `v = p - kappa`, `q = v - sin v`, `c = 1 - cos v`; then `tau^2 - kappa^2 = 2 kappa q + q^2 + c^2 = d (d + 2 kappa)`.
//!
//! Conditioning: `dp/dt = tau / (p (1 - cos p))` has a pole at each flat point, so the roll angle itself is
//! uncertain there by about `(6 t eps)^(1/3)`. What is built from it (start point, tangency) stays exact. With
//! `d` given directly ([`roll_near`]) the excess `v` has full relative accuracy as well.

use std::f64::consts::{PI, TAU};

use crate::base::{Code, Finding, Result};
use crate::num::root::bracketed_newton;
use crate::num::series::{one_minus_cos, v_minus_sin};

/// Newton's steps at most; six are the most ever seen (tested), eight are the promise.
pub const MAX_ITERATIONS: u32 = 8;
/// Steps when the root may lie on the cusp, where bisection has to carry the load: 53 halvings and some.
const CUSP_ITERATIONS: u32 = 70;
/// Below this distance `tau = p^2/2` to the last bit: the next term is smaller by the factor `p^2/36 = t/18`.
const PARABOLIC: f64 = 1e-17;

/// A solved roll angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roll {
    /// Roll angle [rad]: radius of curvature / base radius.
    pub angle: f64,
    /// Roll angle minus that of the nearest osculated circle [rad], without cancellation.
    pub excess: f64,
    /// Evaluations that Newton's method needed.
    pub iterations: u32,
}

/// The roll angle [rad] at which the involute from the hole centre is `t` base radii away from it.
///
/// ```
/// # use kinecut_plan as kinecut;
/// // The paper's lead-in: start (-40, 40), path radius 80 mm, two turns.
/// let r = 80.0 / (4.0 * std::f64::consts::PI);
/// let roll = kinecut::holes::roll::roll_angle(3200f64.sqrt() / r).unwrap();
/// assert!((roll.angle - 9.04481476767708).abs() < 1e-13);
/// ```
///
/// # Errors
/// `KC0404` when `t` is negative or not finite. It never fails otherwise.
pub fn roll_angle(t: f64) -> Result<Roll> {
    if !(t.is_finite() && t >= 0.0) {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "the distance of an involute from its centre must be finite and not negative",
        )
        .value(t, "base radii")
        .bound(0.0, "base radii")
        .into());
    }
    let k = (t / TAU + 0.5).floor();
    if k > 0.0 {
        return Ok(roll_near(TAU * k, t - TAU * k));
    }
    if t < PARABOLIC {
        let angle = (2.0 * t).sqrt();
        return Ok(Roll { angle, excess: angle, iterations: 0 });
    }
    let goal = (2.0 * t).sqrt();
    let (angle, iterations) = bracketed_newton(
        |p| {
            let c = one_minus_cos(p);
            let tau = v_minus_sin(p).hypot(c);
            let root = (2.0 * tau).sqrt();
            (root - goal, p * c / (tau * root))
        },
        goal,
        0.0,
        PI,
        MAX_ITERATIONS,
    );
    Ok(Roll { angle, excess: angle, iterations })
}

/// The roll angle at `kappa + d` base radii from the hole centre, on the involute that osculates the circle of
/// `kappa` base radii about it.
///
/// `kappa` is `2 pi k` when the involute starts in the centre, and may be any number of at least about pi
/// otherwise; `|d| <= pi`. Near a wall give `d` itself, computed without forming the difference of two nearly
/// equal distances ([`rim_gap`]): the excess is then as exact as `d`.
///
/// The nearest point of the involute is returned if it does not come as near to the centre as asked.
pub fn roll_near(kappa: f64, d: f64) -> Roll {
    let goal = d * (d + 2.0 * kappa);
    if goal == 0.0 {
        return Roll { angle: kappa, excess: 0.0, iterations: 0 };
    }
    // The excess lies in [-4, 0] or [0, pi] (at kappa = pi, d = -pi it is -2.78), and never beyond the cusp.
    let cusp = -kappa;
    let (lo, hi) = if goal < 0.0 { (cusp.clamp(-4.0, 0.0), 0.0) } else { (0.0, PI) };
    let goal_root = goal.cbrt();
    // Only an involute off the centre can be asked for a point at its cusp.
    let limit = if cusp < -4.0 || goal > 0.0 { MAX_ITERATIONS } else { CUSP_ITERATIONS };
    let (excess, iterations) = bracketed_newton(
        |v| {
            let (q, c) = (v_minus_sin(v), one_minus_cos(v));
            let root = (2.0 * kappa * q + q * q + c * c).cbrt();
            (root - goal_root, 2.0 * (kappa + v) * c / (3.0 * root * root))
        },
        (6.0 * d).cbrt(),
        lo,
        hi,
        limit,
    );
    Roll { angle: kappa + excess, excess, iterations }
}

/// `radius - |(x, y)|` [mm] without cancellation: the squares are subtracted with their rounding errors.
///
/// ```
/// # use kinecut_plan as kinecut;
/// let gap = kinecut::holes::roll::rim_gap(5.0, 3.0, 4.0 - 1e-12);
/// assert!((gap / 0.8e-12 - 1.0).abs() < 1e-3);
/// ```
pub fn rim_gap(radius: f64, x: f64, y: f64) -> f64 {
    let square = |v: f64| {
        let high = v * v;
        (high, v.mul_add(v, -high))
    };
    let two_sum = |a: f64, b: f64| {
        let s = a + b;
        let bb = s - a;
        (s, (a - (s - bb)) + (b - bb))
    };
    let ((r2, re), (x2, xe), (y2, ye)) = (square(radius), square(x), square(y));
    let (s, e1) = two_sum(r2, -x2);
    let (s, e2) = two_sum(s, -y2);
    (s + (e1 + e2 + (re - xe - ye))) / (radius + x.hypot(y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// tau by the plain formula of equation (8), which shares nothing with the solver.
    fn distance(p: f64) -> f64 {
        ((p.cos() + p * p.sin() - 1.0).powi(2) + (p.sin() - p * p.cos()).powi(2)).sqrt()
    }

    /// Bisection on equation (8), sixty halvings.
    fn by_bisection(t: f64) -> f64 {
        let (mut lo, mut hi) = (0.0, (t * (t + 2.0)).sqrt());
        for _ in 0..70 {
            let m = 0.5 * (lo + hi);
            if distance(m) < t { lo = m } else { hi = m }
        }
        0.5 * (lo + hi)
    }

    #[test]
    fn never_more_than_eight_iterations_and_the_distance_is_met() {
        let mut worst = 0;
        for i in 0..40_000 {
            let t = 10f64.powf(-12.0 + 17.5 * i as f64 / 40_000.0);
            let roll = roll_angle(t).unwrap();
            worst = worst.max(roll.iterations);
            let tau = (roll.angle - roll.angle.sin()).hypot(2.0 * (0.5 * roll.angle).sin().powi(2));
            assert!((tau - t).abs() <= 4e-15 * t + 1e-16, "t {t}: tau {tau}");
        }
        // The flat points and their neighbours of every size.
        for k in 1..2000 {
            for e in -15..=0 {
                for sign in [-1.0, 0.0, 1.0] {
                    let t = TAU * f64::from(k) + sign * 3.0 * 10f64.powi(e);
                    let roll = roll_angle(t).unwrap();
                    worst = worst.max(roll.iterations);
                    let tau = (roll.angle - roll.angle.sin()).hypot(2.0 * (0.5 * roll.angle).sin().powi(2));
                    assert!((tau - t).abs() <= 4e-15 * t, "t {t}: tau {tau}");
                }
            }
        }
        assert!(worst <= MAX_ITERATIONS, "{worst}");
    }

    #[test]
    fn the_ends_of_the_range_are_served() {
        assert_eq!(roll_angle(0.0).unwrap().angle, 0.0);
        assert!((roll_angle(5e-324).unwrap().angle / (2.0 * 5e-324f64).sqrt() - 1.0).abs() < 1e-15);
        for t in [1e17, 1e200, f64::MAX / 4.0] {
            assert!((roll_angle(t).unwrap().angle / t - 1.0).abs() < 1e-15, "{t}");
        }
        for t in [-1e-300, f64::NAN, f64::INFINITY] {
            assert_eq!(roll_angle(t).unwrap_err().code(), Code::PLAN_VALUE);
        }
        for k in 1..100 {
            assert_eq!(roll_near(TAU * f64::from(k), 0.0).angle, TAU * f64::from(k));
        }
    }

    #[test]
    fn near_the_rim_the_excess_follows_the_cube_root() {
        // To first order N = kappa v^3/3 + v^4/4 = 2 kappa d, so v = cbrt(6 d) (1 - v/(4 kappa) ...).
        let kappa = 40.0 * PI;
        for d in [-1e-6, -1e-12, -1e-30, 1e-12] {
            let v = roll_near(kappa, d).excess;
            let first = (6.0 * d).cbrt();
            assert!(
                (v / (first * (1.0 - first / (4.0 * kappa))) - 1.0).abs() < 0.1 * first * first + 1e-14,
                "{d}"
            );
        }
    }

    #[test]
    fn an_involute_off_the_centre_is_followed_to_its_cusp() {
        // Osculates 3 base radii; its cusp is at v = -3, at distance hypot(3 + q, c).
        let kappa = 3.0f64;
        let at = |v: f64| (kappa + v - v.sin()).hypot(1.0 - v.cos());
        for v in [-3.0, -2.999, -2.0, -0.5, 0.7, 2.0] {
            let found = roll_near(kappa, at(v) - kappa);
            assert!((at(found.excess) - at(v)).abs() < 1e-14, "{v} {found:?}");
            assert!((found.excess - v).abs() < 1e-6, "{v} {found:?}");
        }
        // Nearer than the cusp: the cusp.
        assert!((roll_near(kappa, at(-3.0) - kappa - 0.3).excess + 3.0).abs() < 1e-9);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn agrees_with_bisection(t in 0.01..1e4f64) {
            let p = roll_angle(t).unwrap().angle;
            let b = by_bisection(t);
            // Bisection sees equation (8) with a noise of a few ulp; the flat points magnify it to a cube root.
            let flat = (6.0 * t * 1e-14).cbrt();
            let slope = t / (b * (1.0 - b.cos()));
            prop_assert!((p - b).abs() <= (slope * t * 2e-14).min(3.0 * flat) + 1e-13 * t, "{t}: {p} {b}");
        }
    }
}
