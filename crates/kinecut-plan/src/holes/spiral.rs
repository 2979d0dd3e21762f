//! Spirals between two circles about the hole centre in whole turns: the circle involute, exact or with a base radius that
//! a control can print, and the lens involutes of higher contact; constant normal step, all of the same length
//! `pi n (inner + outer)`.
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

use super::clearing::disc::{Cleared, Disc, turns};
use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, LensOrder, PlaneCurve, Spiral, Support, on_circle};

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
/// use kinecut::holes::{clearing, path_radius, spiral};
/// let r = path_radius(200.0, 40.0, 1.0).unwrap();
/// let n = clearing::turns(r, 4.0).unwrap();
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
    InvoluteRecord::new(length, on_circle(inner, psi).to_array(), psi, inner, outer)
}

/// The lens involute between two circles about the origin, in whole turns.
///
/// # Errors
/// As [`annular`].
pub(super) fn lens_between(
    inner: f64,
    outer: f64,
    turns: u32,
    psi: f64,
    order: LensOrder,
) -> Result<PlaneCurve> {
    if order == LensOrder::Zero {
        return Ok(annular(inner, outer, turns, psi)?.into());
    }
    let angle = TAU * f64::from(turns);
    let law = Support::Lens { inner, base_radius: (outer - inner) / angle, order };
    Ok(Spiral::new(law.into(), 0.0, angle)?.rotated(psi).into())
}

/// Clears a disc by a lens involute in whole turns of constant normal step, without regard to what a control can print:
/// only order zero has a native form, [`involute`].
pub(super) fn lens(disc: &Disc, order: LensOrder) -> Result<Cleared> {
    let n = turns(disc.outer - disc.inner, disc.step)?;
    let curves = vec![lens_between(disc.inner, disc.outer, n, disc.psi, order)?];
    disc.cleared(curves, f64::from(n), (disc.outer - disc.inner) / f64::from(n))
}

/// Clears a disc by the circle involute, native where the disc has a resolution.
///
/// # Errors
/// As [`rough_spiral`].
pub(super) fn involute(disc: &Disc) -> Result<Cleared> {
    let Disc { inner, inner_most, outer, step, psi, resolution, .. } = *disc;
    let spiral = rough_spiral(inner, inner_most, outer, step, psi, resolution)?;
    let inner = if inner > 0.0 { spiral.inner_radius } else { 0.0 };
    let curves = spiral.records.into_iter().map(PlaneCurve::from).collect();
    Ok(Cleared { inner, ..disc.cleared(curves, f64::from(spiral.turns), spiral.step)? })
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

/// The spiral from the circle of radius `inner` [mm] (zero: the centre) to that of `radius` in steps of at most
/// `max_step` [mm], meeting the wall at tangent angle `psi`. With a `resolution` [mm] its base radius is a multiple of it
/// where it is native; the inner circle moves for that by at most `pi turns resolution`, never above `most` [mm].
///
/// # Errors
/// As [`turns`] and [`annular`].
pub fn rough_spiral(
    inner: f64,
    most: f64,
    radius: f64,
    max_step: f64,
    psi: f64,
    resolution: Option<f64>,
) -> Result<RoughSpiral> {
    let width = radius - inner;
    let n = turns(width, max_step)?;
    // Out of the centre one turn of its own leads to the circle on which the native spiral starts.
    let (first, counts, most) = if inner > 0.0 {
        (0, [n, n + 1], most)
    } else {
        (1, [n - 1, n], max_step * (1.0 + FIRST_TURN_EXCESS))
    };
    if let Some(u) = resolution.filter(|_| counts[0] > 0) {
        for count in counts {
            for r in multiples(width / (TAU * f64::from(count + first)), u) {
                let from = radius - TAU * f64::from(count) * r;
                let step = TAU * r;
                if step <= max_step * (1.0 + SLACK) && from <= most && from >= LEAST_FIRST_STEP * step {
                    let mut records = vec![annular(from, radius, count, psi)?];
                    if first > 0 {
                        records.insert(0, from_centre(from, 1, psi)?);
                    }
                    let turns = count + first;
                    return Ok(RoughSpiral { records, inner_radius: from, base_radius: r, turns, step });
                }
            }
        }
    }
    let record = annular(inner, radius, n, psi)?;
    Ok(RoughSpiral {
        records: vec![record],
        inner_radius: inner,
        base_radius: record.base_radius(),
        turns: n,
        step: width / f64::from(n),
    })
}

/// The involute that leaves the circle of `radius` [mm] at tangent angle `psi` inwards and turns by `turned` [rad]:
/// the way back from the wall into the open.
///
/// # Errors
/// `KC0801` when it would pass its cusp: `turned` times the base radius exceeds the radius.
pub fn leave(radius: f64, base_radius: f64, turned: f64, psi: f64) -> Result<InvoluteRecord> {
    turned_to(radius, radius - base_radius * turned, turned, psi)
}

/// The involute that leaves the circle of `radius` [mm] at tangent angle `psi` inwards and turns by `turned` [rad] until
/// its radius of curvature is `end` [mm].
///
/// # Errors
/// `KC0801` when that is negative.
pub(super) fn turned_to(radius: f64, end: f64, turned: f64, psi: f64) -> Result<InvoluteRecord> {
    let wall = on_circle(radius, psi);
    InvoluteRecord::new(0.5 * turned * (radius + end), wall.to_array(), psi, radius, end)
}

/// A base radius near `radius / (2 pi turns)` that is a multiple of the resolution.
pub fn base_radius(radius: f64, turns: u32, resolution: Option<f64>) -> f64 {
    let exact = radius / (TAU * f64::from(turns));
    match resolution {
        Some(u) if exact >= u => (exact / u).round() * u,
        _ => exact,
    }
}

/// Half a turn [rad]: how far a way back from the wall turns unless told otherwise. It is then `pi` base radii off
/// the wall.
pub const HALF_TURN: f64 = PI;

/// The two positive multiples of `u` around `value`, the larger first.
fn multiples(value: f64, u: f64) -> impl Iterator<Item = f64> {
    let count = value / u;
    [count.ceil(), count.floor()].into_iter().filter(|c| *c >= 1.0).map(move |c| c * u)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ContactOrder, Curve, joint};
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
        let s = rough_spiral(0.0, 0.0, 79.0, 4.0, 0.0, Some(1e-3)).unwrap();
        // 19 turns of 0.629: R1 = 79 - 38 pi 0.629.
        assert!((s.base_radius - 0.629).abs() < 1e-12 && s.turns == 20);
        assert!((s.inner_radius - (79.0 - 38.0 * PI * 0.629)).abs() < 1e-12);
        assert_eq!(contact(&s.records[0], &s.records[1]), ContactOrder::G2);
        // A step that divides the radius keeps its turns; the first one pays.
        let s = rough_spiral(0.0, 0.0, 80.0, 4.0, 0.0, Some(1e-3)).unwrap();
        assert!(s.turns == 20 && s.step <= 4.0 && s.inner_radius < 4.08, "{s:?}");
        // Ninety-nine turns at 0.636 would leave a first turn of 4.4: one turn more.
        let s = rough_spiral(0.0, 0.0, 400.0, 4.0, 0.0, Some(1e-3)).unwrap();
        assert!(s.turns == 101 && s.inner_radius < 4.08, "{s:?}");
        let exact = rough_spiral(0.0, 0.0, 79.0, 4.0, 0.0, None).unwrap();
        assert_eq!((exact.records.len(), exact.turns, exact.inner_radius), (1, 20, 0.0));
    }

    #[test]
    fn one_turn_or_a_coarse_resolution_keeps_the_exact_form() {
        assert_eq!(rough_spiral(0.0, 0.0, 3.0, 4.0, 0.0, Some(1e-3)).unwrap().records.len(), 1);
        assert_eq!(rough_spiral(0.0, 0.0, 3.0, 0.5, 0.0, Some(1.0)).unwrap().records.len(), 1);
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
                rough_spiral(0.0, 0.0, radius, max_step, psi, Some(u)).unwrap(),
                rough_spiral(inner, inner * 1.01, radius, max_step, psi, Some(u)).unwrap(),
            ] {
                prop_assert!(s.step <= max_step * (1.0 + 1e-9), "{s:?}");
                prop_assert!(s.records[0].end_radius() <= radius);
                let last = s.records.last().unwrap();
                let native = s.inner_radius > 0.0 && s.inner_radius != inner;
                prop_assert!(!native || multiple(s.base_radius, u));
                prop_assert!((last.base_radius() - s.base_radius).abs() < 1e-9 * s.base_radius);
                let wall = InvoluteRecord::circle(radius, psi).unwrap();
                prop_assert_eq!(contact(last, &wall), ContactOrder::G2);
                if let [first, second] = s.records[..] {
                    prop_assert!(first.end_radius() <= max_step * (1.0 + FIRST_TURN_EXCESS) * (1.0 + 1e-9));
                    prop_assert!(contact(&first, &second) >= ContactOrder::G2);
                }
            }
        }
    }
}
