//! The involute from a start point to the wall circle, in the paper's exact form.
//!
//! Source: Sorokin, But, Kombarov 2013, equations (7)-(13). Corrected: in equation (10) `psi` needs the sign (`atan2`),
//! and is free when the start is the hole centre; the record's angle is the tangent angle `phi0 + psi`, not the roll angle
//! (the paper's tables print the roll angle, with which the path gouges).
//!
//! Counter-clockwise about the origin. `psi` is the tangent angle at the wall.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::roll::{Roll, rim_gap, roll_angle, roll_near};
use crate::base::{Code, Finding, Result};
use crate::geom::InvoluteRecord;
use crate::num::series::{one_minus_cos, v_minus_sin};

/// A tangential way from a start point to the wall circle, counter-clockwise about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeadIn {
    /// The path, from the start point to the wall.
    pub record: InvoluteRecord,
    /// Base radius [mm].
    pub base_radius: f64,
    /// Roll angle at the start [rad] (the paper's phi0).
    pub roll: f64,
    /// Tangent angle at the wall [rad]: the rotation of the involute (the paper's psi).
    pub psi: f64,
    /// Turns of the path from start to wall, exactly (the paper's n_B is an approximation).
    pub turns: f64,
    /// Evaluations of the roll solver.
    pub iterations: u32,
}

/// The involute from `start` that osculates the circle of `radius` [mm] about the origin; it would reach the
/// centre after `turns` whole turns. Equations (7)-(11).
///
/// When `start` is the centre itself the direction is free: `polar` is then the polar angle [rad] of the point
/// in which the wall is met.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::lead_in::lead_in;
/// let finish = lead_in(80.0, 2, [-40.0, 40.0], 0.0).unwrap();
/// assert!((finish.roll - 9.04481476767708).abs() < 1e-13);
/// assert!((finish.psi - 0.946567321657524).abs() < 1e-13);
/// assert!((finish.record.length() - 242.249726898481).abs() < 1e-10);
/// ```
///
/// # Errors
/// `KC0402` when the start is not inside the circle, `KC0404` for no turns or a radius that is not positive.
pub fn lead_in(radius: f64, turns: u32, start: [f64; 2], polar: f64) -> Result<LeadIn> {
    if turns == 0 {
        return Err(Finding::error(Code::PLAN_VALUE, "a lead-in needs at least one turn")
            .value(0.0, "")
            .bound(1.0, "")
            .into());
    }
    let n = f64::from(turns);
    let base_radius = radius / (TAU * n);
    let (distance, gap) = inside(radius, start)?;
    // From the nearest osculated circle, whose radius is known exactly.
    let laps = ((gap / radius) * n).round();
    let circle = radius * ((n - laps) / n);
    let roll = if laps >= n {
        roll_angle(distance / base_radius)?
    } else {
        let d = if laps == 0.0 { -gap } else { distance - circle };
        roll_near(TAU * (n - laps), d / base_radius)
    };
    SolvedLead { radius, base_radius, circle, laps, roll }.placed(start, polar)
}

/// The paper's approximation of the turns from a start at a distance [mm] from the centre to the wall,
/// `n (1 - distance/R)`: poor near the wall, where [`LeadIn::turns`] is exact. For showing the difference.
///
/// ```
/// # use kinecut_plan as kinecut;
/// let printed = kinecut::holes::lead_in::turns_as_printed(80.0, 2, 3200f64.sqrt());
/// assert!((printed - 0.585786437626905).abs() < 1e-14); // exactly: 0.560473
/// ```
pub fn turns_as_printed(radius: f64, turns: u32, distance: f64) -> f64 {
    f64::from(turns) * (1.0 - distance / radius)
}

/// The involute of a given base radius [mm] from `start` that osculates the circle of `radius` [mm] about the
/// origin. It need not pass through the centre, so any base radius that reaches far enough inside will do.
///
/// # Errors
/// As [`lead_in`]; `KC0402` also when the involute ends (at its cusp) before it comes as near to the centre as
/// `start`, with that least distance as the bound.
pub fn lead_in_with_base(radius: f64, base_radius: f64, start: [f64; 2], polar: f64) -> Result<LeadIn> {
    if !(base_radius > 0.0 && base_radius.is_finite()) {
        return Err(Finding::error(Code::PLAN_VALUE, "a base radius must be positive")
            .value_mm(base_radius)
            .bound_mm(0.0)
            .into());
    }
    let (distance, gap) = inside(radius, start)?;
    let laps = (gap / (TAU * base_radius)).round();
    let circle = radius - TAU * base_radius * laps;
    let d = if laps == 0.0 { -gap } else { distance - circle };
    let roll = roll_near(circle / base_radius, d / base_radius);
    let way = SolvedLead { radius, base_radius, circle, laps, roll };
    let reached = way.unturned().length();
    // The solver returns the cusp for what lies beyond it.
    if (reached - distance).abs() > REACH_SLACK * radius {
        return Err(Finding::error(
            Code::START_OUTSIDE,
            "the lead-in does not reach as near to the hole centre as its start",
        )
        .value_mm(distance)
        .bound_mm(reached)
        .help("start in the centre or farther out, or let the base radius follow from a number of turns")
        .into());
    }
    way.placed(start, polar)
}

/// Relative difference between the start and the solved involute that is rounding: the solver meets the distance
/// to a few ulp away from the cusp, and to the square root of one at it.
const REACH_SLACK: f64 = 1e-13;

/// Distance of the start from the centre and its gap to the circle.
fn inside(radius: f64, start: [f64; 2]) -> Result<(f64, f64)> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(Finding::error(Code::PLAN_VALUE, "the radius of the path must be positive")
            .value_mm(radius)
            .bound_mm(0.0)
            .into());
    }
    let [x, y] = start;
    let distance = x.hypot(y);
    let gap = rim_gap(radius, x, y);
    if gap > 0.0 {
        return Ok((distance, gap));
    }
    Err(Finding::error(Code::START_OUTSIDE, "the start point is not inside the path circle")
        .value_mm(distance)
        .bound_mm(radius)
        .help("choose a start nearer to the hole centre")
        .into())
}

/// A solved lead-in before it is turned into its place.
struct SolvedLead {
    /// Radius of the wall circle [mm].
    radius: f64,
    base_radius: f64,
    /// Radius of the osculated circle nearest to the start [mm] (zero: the centre), and turns from it to the wall.
    circle: f64,
    laps: f64,
    roll: Roll,
}

impl SolvedLead {
    /// The start when the wall is met at tangent angle 0: support function and its derivative about the origin are
    /// `q = circle + r (v - sin v)`, `q' = r (1 - cos v)` at tangent angle `v`.
    fn unturned(&self) -> DVec2 {
        let v = self.roll.excess;
        let (q, slope) =
            (self.circle + self.base_radius * v_minus_sin(v), self.base_radius * one_minus_cos(v));
        let (sin, cos) = v.sin_cos();
        DVec2::new(q * sin + slope * cos, -q * cos + slope * sin)
    }

    /// Turned so that it passes through `start` (equation 10).
    fn placed(&self, start: [f64; 2], polar: f64) -> Result<LeadIn> {
        let here = DVec2::from_array(start);
        let psi = if here == DVec2::ZERO {
            polar + FRAC_PI_2
        } else {
            let there = self.unturned();
            there.perp_dot(here).atan2(there.dot(here))
        };
        let (radius, r, v) = (self.radius, self.base_radius, self.roll.excess);
        let left = TAU * self.laps - v;
        // At the cusp itself the sum may round below zero.
        let start_radius = (self.circle + r * v).clamp(0.0, radius);
        let length = 0.5 * left * (radius + start_radius);
        // The angle of the record counts the whole turns from the centre, as the paper does.
        let angle = psi + v + TAU * (self.circle / (TAU * r)).round();
        let record = InvoluteRecord::new(length, start, angle, start_radius, radius)?;
        let roll = start_radius / r;
        Ok(LeadIn { record, base_radius: r, roll, psi, turns: left / TAU, iterations: self.roll.iterations })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::on_circle;
    use proptest::prelude::*;

    fn near(a: DVec2, b: DVec2, tol: f64) -> bool {
        (a - b).length() <= tol
    }

    #[test]
    fn the_tables_of_the_paper_corrected() {
        let l = lead_in(80.0, 2, [-40.0, 40.0], 0.0).unwrap();
        assert!((l.record.start_angle() - 9.99138208933461).abs() < 1e-12);
        assert!((l.record.start_radius() - 57.5810791850552).abs() < 1e-11);
        assert!(near(l.record.end(), DVec2::new(64.9131188336368, -46.7577480562328), 1e-11));
        assert!(near(l.record.base_centre(), DVec2::new(-3.72086336549746, -5.16562186694245), 1e-11));
        assert!((l.turns - 0.560473020373619).abs() < 1e-13);
        let c = InvoluteRecord::circle(80.0, l.psi).unwrap();
        assert!(near(c.start(), l.record.end(), 1e-11) && (c.length() - 502.654824574367).abs() < 1e-11);
    }

    #[test]
    fn from_the_centre_the_caller_says_where_the_wall_is_met() {
        for polar in [0.0, 1.0, -2.5] {
            let l = lead_in(30.0, 3, [0.0, 0.0], polar).unwrap();
            assert!(near(l.record.end(), 30.0 * DVec2::from_angle(polar), 1e-12));
            assert_eq!(l.record.start(), DVec2::ZERO);
        }
    }

    #[test]
    fn starts_outside_are_refused_with_the_numbers() {
        for start in [[80.0, 0.0], [60.0, 60.0], [f64::NAN, 0.0]] {
            assert_eq!(lead_in(80.0, 2, start, 0.0).unwrap_err().code(), Code::START_OUTSIDE);
        }
        assert_eq!(lead_in(80.0, 0, [1.0, 0.0], 0.0).unwrap_err().code(), Code::PLAN_VALUE);
        assert_eq!(lead_in(f64::NAN, 1, [1.0, 0.0], 0.0).unwrap_err().code(), Code::PLAN_VALUE);
    }

    #[test]
    fn an_unreachable_start_is_said_with_the_least_distance() {
        // r = 6.3 instead of 6.366: the cusp lies |R/r mod 2 pi| r from the centre.
        let e = lead_in_with_base(80.0, 6.3, [0.1, 0.0], 0.0).unwrap_err();
        assert_eq!(e.code(), Code::START_OUTSIDE);
        let w: f64 = 80.0 / 6.3;
        let cusp = (6.3 * (w.sin())).hypot(6.3 * (1.0 - w.cos()));
        assert!((e.0.bound.unwrap().value - cusp).abs() < 1e-6);
    }

    /// Tangent to the circle of radius R at its end, of curvature 1/R, and starting in T0.
    fn assert_lead_in(l: &LeadIn, radius: f64, start: DVec2) {
        let end = l.record.at(l.record.length());
        // A record carries its turned angle to a relative ulp: the end moves by that angle's error times R.
        let scale = radius * (2e-13 + 4e-16 * TAU * l.turns);
        assert_eq!(l.record.start(), start);
        assert!((end.p.length() - radius).abs() < scale, "{l:?}");
        assert!(end.p.dot(end.d1).abs() < scale * radius, "{l:?}");
        assert!((l.record.end_radius() - radius).abs() <= f64::EPSILON * radius);
        assert!(near(end.p, on_circle(radius, l.psi), scale), "{l:?}");
    }

    #[test]
    fn special_radii_are_met() {
        for (radius, n) in [(80.0, 2u32), (79.0, 20), (7.5, 1), (250.0, 300)] {
            for k in 1..n {
                let rho = radius * f64::from(k) / f64::from(n);
                assert_lead_in(&lead_in(radius, n, [rho, 0.0], 0.0).unwrap(), radius, DVec2::new(rho, 0.0));
            }
            for gap in [1e-3, 1e-6, 1e-9, 1e-12] {
                let l = lead_in(radius, n, [0.0, radius - gap], 0.0).unwrap();
                assert_lead_in(&l, radius, DVec2::new(0.0, radius - gap));
                // Gap = r v^3/6 to first order.
                let exact = radius - (radius - gap);
                let r = radius / (TAU * f64::from(n));
                assert!((l.turns * TAU / (6.0 * exact / r).cbrt() - 1.0).abs() < 0.2, "{l:?}");
            }
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn lead_in_ends_tangent_on_the_wall(
            radius in 0.5..300.0f64, n in 1u32..60, u in 0.0..0.999_999f64, at in -3.2..3.2f64,
        ) {
            let start = radius * u * DVec2::from_angle(at);
            let l = lead_in(radius, n, start.to_array(), 0.0).unwrap();
            assert_lead_in(&l, radius, start);
            // The length is the integral of the radius of curvature over the turned angle.
            let sum = 0.5 * (l.record.start_radius() + radius) * (l.turns * TAU);
            prop_assert!((l.record.length() - sum).abs() < 1e-12 * radius * f64::from(n));
        }

        #[test]
        fn lead_in_of_a_rounded_base_radius_keeps_start_and_wall(
            radius in 5.0..300.0f64, n in 1u32..30, u in 0.02..0.99f64, at in -3.2..3.2f64, wrong in -0.01..0.01f64,
        ) {
            let start = radius * u * DVec2::from_angle(at);
            let base = radius / (TAU * f64::from(n)) * (1.0 + wrong / f64::from(n));
            if let Ok(l) = lead_in_with_base(radius, base, start.to_array(), 0.0) {
                assert_lead_in(&l, radius, start);
                prop_assert!((l.record.base_radius() / base - 1.0).abs() < 1e-9);
            } else {
                // Only what lies within the cusp's distance may fail.
                prop_assert!(start.length() < 0.3 * base, "{start} {base}");
            }
        }
    }
}
