//! Spirals between two circles about the hole centre in whole turns: exact, and with a base radius that a control can
//! print.
//!
//! Source: Sorokin, But, Kombarov 2013, equations (5), (6), (15), (16). Counter-clockwise about the origin; the clockwise
//! twin is [`InvoluteRecord::mirrored`]. Contact with both circles is of order G2; the derivative of curvature jumps by
//! `r / R^3`.
//!
//! A control with involutes reads the base radius rounded to its resolution, and draws the involute with the error times
//! the roll angle: 63 um in the paper's example with three decimals. The help is a base radius that is a multiple of the
//! resolution, so that nothing is rounded. The wall circle stays exact, always; what gives way:
//!
//! * a spiral out of the centre becomes one turn on its own from the centre to a circle `R1` (it starts on its
//!   base circle, where no control takes an involute, so it is posted as arcs) and an annular spiral from `R1` to
//!   the wall; both osculate `R1`. The steps stay within the limit, but for the first turn, which may exceed it by
//!   [`FIRST_TURN_EXCESS`] (it is a slot anyway);
//! * a spiral out of a given circle starts from one a little smaller (or larger, up to a bound).

use std::f64::consts::{PI, TAU};

use super::circle::{turns, wall_point};
use crate::base::{Code, Finding, Result};
use crate::geom::InvoluteRecord;

/// Relative excess of the first turn of a native spiral over the step: at 92 degrees of engagement and more
/// it adds a third of a degree, and without it a step that divides the radius would cost a whole turn.
pub const FIRST_TURN_EXCESS: f64 = 0.02;
/// Least part of a step that the first circle may have, so that the annular spiral does not start on its base
/// circle: its roll is this times 2 pi.
const LEAST_FIRST_STEP: f64 = 0.5;
/// Relative slack in comparisons of steps: rounding of `2 pi r`.
pub(super) const SLACK: f64 = 1e-12;

/// The involute from the hole centre that osculates the circle of `radius` after `turns` whole turns:
/// equations (5), (6), (16).
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::{circle, path_radius, spiral};
/// let r = path_radius(200.0, 40.0, 1.0).unwrap();
/// let n = circle::turns(r, 4.0).unwrap();
/// let rough = spiral::from_centre(r, n, 0.0).unwrap();
/// assert_eq!(n, 20);
/// assert!((rough.length() - 4963.71639267187).abs() < 1e-9);
/// ```
///
/// # Errors
/// `KC0404` for no turns, `KC0801` when the radius is not positive and finite.
pub fn from_centre(radius: f64, turns: u32, psi: f64) -> Result<InvoluteRecord> {
    annular(0.0, radius, turns, psi)
}

/// The involute between two circles about the origin that osculates both, in whole turns: base radius
/// `(outer - inner) / (2 pi turns)`, length `pi turns (inner + outer)`. The step is constant.
///
/// # Errors
/// `KC0404` for no turns or radii out of order.
pub fn annular(inner: f64, outer: f64, turns: u32, psi: f64) -> Result<InvoluteRecord> {
    if turns == 0 {
        return Err(Finding::error(Code::PLAN_VALUE, "a spiral needs at least one turn")
            .value(0.0, "")
            .bound(1.0, "")
            .into());
    }
    if !(inner >= 0.0 && inner < outer && outer.is_finite()) {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "the inner circle of a spiral must be smaller than the outer",
        )
        .value_mm(inner)
        .bound_mm(outer)
        .into());
    }
    let length = PI * f64::from(turns) * (inner + outer);
    InvoluteRecord::new(length, wall_point(inner, psi).to_array(), psi, inner, outer)
}

/// The spiral of a roughing level.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughSpiral {
    /// Consecutive records up to the wall circle.
    pub records: Vec<InvoluteRecord>,
    /// Radius of the circle from which the annular spiral starts [mm]; zero when it starts in the centre.
    pub inner_radius: f64,
    /// Base radius of the last record [mm].
    pub base_radius: f64,
    /// Whole turns, a first turn of its own included.
    pub turns: u32,
    /// Constant normal step [mm].
    pub step: f64,
}

/// The spiral from the hole centre to the circle of `radius` in steps of at most `max_step` [mm], meeting the wall
/// at tangent angle `psi`. With a `resolution` [mm] its base radius is a multiple of it where it is native.
///
/// # Errors
/// As [`turns`] and [`from_centre`].
pub fn spiral_from_centre(
    radius: f64,
    max_step: f64,
    psi: f64,
    resolution: Option<f64>,
) -> Result<RoughSpiral> {
    let n = turns(radius, max_step)?;
    if let (Some(u), true) = (resolution, n > 1) {
        let first = max_step * (1.0 + FIRST_TURN_EXCESS);
        for outer in [n - 1, n] {
            let wanted = radius / (TAU * f64::from(outer + 1));
            for r in multiples(wanted, u) {
                let inner = radius - TAU * f64::from(outer) * r;
                let step = TAU * r;
                if step <= max_step * (1.0 + SLACK) && inner <= first && inner >= LEAST_FIRST_STEP * step {
                    let records = vec![from_centre(inner, 1, psi)?, annular(inner, radius, outer, psi)?];
                    return Ok(RoughSpiral {
                        records,
                        inner_radius: inner,
                        base_radius: r,
                        turns: outer + 1,
                        step,
                    });
                }
            }
        }
    }
    let record = from_centre(radius, n, psi)?;
    let base_radius = record.base_radius();
    Ok(RoughSpiral {
        records: vec![record],
        inner_radius: 0.0,
        base_radius,
        turns: n,
        step: radius / f64::from(n),
    })
}

/// The spiral from a circle of about `inner` [mm] to the circle of `radius`, in steps of at most `max_step`. With a
/// `resolution` the inner circle moves by at most `pi turns resolution` where it may: never above `most` [mm].
///
/// # Errors
/// As [`turns`] and [`annular`].
pub fn spiral_from_circle(
    inner: f64,
    most: f64,
    radius: f64,
    max_step: f64,
    psi: f64,
    resolution: Option<f64>,
) -> Result<RoughSpiral> {
    let n = turns(radius - inner, max_step)?;
    if let Some(u) = resolution {
        for count in [n, n + 1] {
            let wanted = (radius - inner) / (TAU * f64::from(count));
            for r in multiples(wanted, u) {
                let from = radius - TAU * f64::from(count) * r;
                let step = TAU * r;
                if step <= max_step * (1.0 + SLACK) && from <= most && from >= LEAST_FIRST_STEP * step {
                    let records = vec![annular(from, radius, count, psi)?];
                    return Ok(RoughSpiral {
                        records,
                        inner_radius: from,
                        base_radius: r,
                        turns: count,
                        step,
                    });
                }
            }
        }
    }
    let record = annular(inner, radius, n, psi)?;
    let step = (radius - inner) / f64::from(n);
    Ok(RoughSpiral {
        records: vec![record],
        inner_radius: inner,
        base_radius: record.base_radius(),
        turns: n,
        step,
    })
}

/// The two positive multiples of `u` around `value`, the larger first.
fn multiples(value: f64, u: f64) -> impl Iterator<Item = f64> {
    let count = value / u;
    [count.ceil(), count.floor()].into_iter().filter(|c| *c >= 1.0).map(move |c| c * u)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ContactOrder, Curve, joint};
    use crate::holes::circle::circle;
    use glam::DVec2;
    use proptest::prelude::*;

    fn multiple(r: f64, u: f64) -> bool {
        ((r / u).round() * u - r).abs() < 1e-9 * u
    }

    fn contact(a: &InvoluteRecord, b: &InvoluteRecord) -> ContactOrder {
        joint(&Curve::involute(*a, 0.0, 0.0), &Curve::involute(*b, 0.0, 0.0)).contact
    }

    #[test]
    fn the_papers_rough_spiral_meets_its_circle_with_equal_curvature() {
        let spiral = from_centre(79.0, 20, 0.0).unwrap();
        let end = spiral.at(spiral.length());
        assert!((spiral.base_radius() - 0.628662025212987).abs() < 1e-14);
        assert!((end.p - DVec2::new(0.0, -79.0)).length() <= 1e-11);
        assert!((end.curvature - 1.0 / 79.0).abs() < 1e-15);
        assert!((end.curvature_slope.abs() - 1.27507565367646e-6).abs() < 1e-18);
    }

    #[test]
    fn the_papers_spiral_for_a_control_with_three_decimals() {
        let s = spiral_from_centre(79.0, 4.0, 0.0, Some(1e-3)).unwrap();
        // 19 turns of 0.629: R1 = 79 - 38 pi 0.629.
        assert!((s.base_radius - 0.629).abs() < 1e-12 && s.turns == 20);
        assert!((s.inner_radius - (79.0 - 38.0 * PI * 0.629)).abs() < 1e-12);
        assert_eq!(contact(&s.records[0], &s.records[1]), ContactOrder::G2);
        // A step that divides the radius keeps its turns; the first one pays.
        let s = spiral_from_centre(80.0, 4.0, 0.0, Some(1e-3)).unwrap();
        assert!(s.turns == 20 && s.step <= 4.0 && s.inner_radius < 4.08, "{s:?}");
        // Ninety-nine turns at 0.636 would leave a first turn of 4.4: one turn more.
        let s = spiral_from_centre(400.0, 4.0, 0.0, Some(1e-3)).unwrap();
        assert!(s.turns == 101 && s.inner_radius < 4.08, "{s:?}");
        let exact = spiral_from_centre(79.0, 4.0, 0.0, None).unwrap();
        assert_eq!((exact.records.len(), exact.turns, exact.inner_radius), (1, 20, 0.0));
    }

    #[test]
    fn one_turn_or_a_coarse_resolution_keeps_the_exact_form() {
        assert_eq!(spiral_from_centre(3.0, 4.0, 0.0, Some(1e-3)).unwrap().records.len(), 1);
        assert_eq!(spiral_from_centre(3.0, 0.5, 0.0, Some(1.0)).unwrap().records.len(), 1);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn native_spirals_keep_wall_step_and_contact(
            radius in 1.0..300.0f64, share in 0.01..0.9f64, psi in -3.0..3.0f64, digits in 3i32..5, ring in 0.0..0.8f64,
        ) {
            let (u, max_step) = (10f64.powi(-digits), radius * share);
            let inner = radius * ring;
            for s in [
                spiral_from_centre(radius, max_step, psi, Some(u)).unwrap(),
                spiral_from_circle(inner, inner * 1.01, radius, max_step, psi, Some(u)).unwrap(),
            ] {
                prop_assert!(s.step <= max_step * (1.0 + 1e-9), "{s:?}");
                prop_assert!(s.records[0].end_radius() <= radius);
                let last = s.records.last().unwrap();
                let native = s.inner_radius > 0.0 && s.inner_radius != inner;
                prop_assert!(!native || multiple(s.base_radius, u));
                prop_assert!((last.base_radius() - s.base_radius).abs() < 1e-9 * s.base_radius);
                let wall = circle(radius, psi).unwrap();
                prop_assert_eq!(contact(last, &wall), ContactOrder::G2);
                if let [first, second] = s.records[..] {
                    prop_assert!(first.end_radius() <= max_step * (1.0 + FIRST_TURN_EXCESS) * (1.0 + 1e-9));
                    prop_assert!(contact(&first, &second) >= ContactOrder::G2);
                }
            }
        }
    }
}
