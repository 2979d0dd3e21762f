//! Height of the cutter at which a tooth moves in a given direction, and its meetings with a circular edge.
//!
//! Lengths are in units of the cutter's radius, `rho` is the feed per radian in them. A tooth at the height `eta` over
//! the centre line has the velocity (rho + eta, -+ sqrt(1 - eta^2)) in the front and back half. Solved for the height
//! at which it has the direction `omega`: eta = q cos(omega) - rho sin^2(omega), q = sqrt(1 - rho^2 sin^2(omega)).

use std::f64::consts::TAU;

use crate::num::root::bracketed_newton;

/// Height over the centre line, per radius, of the tooth whose velocity has the direction `omega`.
pub(super) fn level(omega: f64, rho: f64) -> f64 {
    let (sin, cos) = omega.sin_cos();
    root_part(sin, rho) * cos - rho * sin * sin
}

/// Direction of the velocity of the tooth at a height of -1 to 1 per radius in the front or back half [rad].
pub(super) fn direction(eta: f64, rho: f64, front: bool) -> f64 {
    let square = (1.0 - eta) * (1.0 + eta);
    let across = if square > 0.0 { square.sqrt() } else { 0.0 };
    (if front { -across } else { across }).atan2(rho + eta)
}

fn root_part(sin: f64, rho: f64) -> f64 {
    let square = 1.0 - (rho * sin) * (rho * sin);
    if square > 0.0 { square.sqrt() } else { 0.0 }
}

/// Half the width at which two roots are no longer told apart [rad]: the stretch between them has no length that
/// matters, and a break too many does no harm.
const NARROW: f64 = 1e-9;

/// Intervals looked at before the rest is given up as breaks as they are: only an arc that is as good as the cutter's
/// own circle needs so many.
const INTERVALS: u32 = 20_000;

/// Calls `found` with every polar angle `phi` of a circle (radius `arc`, centre at height `rise`, both per cutter
/// radius) where a tooth meets it in the direction `phi + turn`: rise + arc sin(phi) = level(phi + turn). The half of
/// the cutter is that of the direction, front where its sine is negative. Roots are isolated by bounds of the first
/// and second derivative, so that none is lost; a root may be given twice, and of a double root a place within
/// `NARROW`. Needs rho < 1.
pub(super) fn meetings(rise: f64, arc: f64, rho: f64, turn: f64, mut found: impl FnMut(f64)) {
    // level' = -sin k^2 / q, k = rho cos + q; |level''| = k^2/q |-cos + 2 rho sin^2/q - rho^2 sin^2 cos/q^2|.
    let value = |phi: f64| {
        let (sin, cos) = (phi + turn).sin_cos();
        let q = root_part(sin, rho);
        let k = rho * cos + q;
        let (s, c) = phi.sin_cos();
        (rise + arc * s - (q * cos - rho * sin * sin), arc * c + sin * k * k / q)
    };
    let least_q = ((1.0 - rho) * (1.0 + rho)).sqrt();
    let bend = arc + ((1.0 + rho) * (1.0 + rho / least_q)).powi(2) / least_q;
    let mut stack = Vec::with_capacity(64);
    let parts = 8;
    for i in (0..parts).rev() {
        let width = TAU / f64::from(parts);
        stack.push((width * f64::from(i), width * f64::from(i + 1)));
    }
    let mut looked = 0;
    while let Some((lo, hi)) = stack.pop() {
        looked += 1;
        let (middle, half) = (0.5 * (lo + hi), 0.5 * (hi - lo));
        let (f, slope) = value(middle);
        if f.abs() > slope.abs() * half + 0.5 * bend * half * half {
            continue;
        }
        if slope.abs() > bend * half {
            let sign = slope.signum();
            if sign * value(lo).0 <= 0.0 && sign * value(hi).0 >= 0.0 {
                let rising = |phi: f64| {
                    let (f, slope) = value(phi);
                    (sign * f, sign * slope)
                };
                found(bracketed_newton(rising, middle - f / slope, lo, hi, 100).0);
            }
        } else if half < NARROW || looked > INTERVALS {
            found(middle);
        } else {
            stack.push((middle, hi));
            stack.push((lo, middle));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn a_level_and_its_direction_are_inverse() {
        for rho in [0.0, 0.003, 0.1, 0.5] {
            for k in 1..40 {
                let omega = -PI + PI * f64::from(k) / 40.0;
                assert!((direction(level(omega, rho), rho, true) - omega).abs() < 1e-9);
                assert!((direction(level(omega, rho), rho, false) + omega).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn every_meeting_with_a_circle_is_found() {
        let mut met = 0;
        for i in 0..400 {
            let k = f64::from(i);
            let (rise, arc) = (1.4 * (0.37 * k).sin(), 0.02 + 1.3 * (0.113 * k).fract());
            let (rho, turn) = (0.3 * (0.271 * k).fract(), 0.7 * k);
            let f = |phi: f64| rise + arc * phi.sin() - level(phi + turn, rho);
            let n = 20_000;
            let at = |j: i32| f(TAU * f64::from(j) / f64::from(n));
            let dense = (0..n).filter(|&j| (at(j) > 0.0) != (at(j + 1) > 0.0)).count();
            let mut roots = Vec::new();
            meetings(rise, arc, rho, turn, |phi| roots.push(phi));
            assert!(roots.iter().all(|&phi| f(phi).abs() < 1e-12), "{i}");
            assert!(roots.len() >= dense, "{i}: {} of {dense}", roots.len());
            met += usize::from(roots.len() == dense && dense > 0);
        }
        assert!(met > 200, "{met}");
    }
}
