//! The circle involute of the paper, the lens involutes of higher contact, and their annular forms between two
//! circles: constant normal step, whole turns, all of the same length `pi n (inner + outer)`.

use std::f64::consts::TAU;

use super::disc::{Cleared, Disc};
use crate::base::Result;
use crate::geom::{LensOrder, PlaneCurve, Spiral, Support};
use crate::holes::circle::turns;
use crate::holes::spiral::{annular, spiral_from_centre, spiral_from_circle};

pub(super) fn involute(disc: &Disc) -> Result<Cleared> {
    let spiral = if disc.inner > 0.0 {
        spiral_from_circle(disc.inner, disc.inner_most, disc.outer, disc.step, disc.psi, disc.resolution)?
    } else {
        spiral_from_centre(disc.outer, disc.step, disc.psi, disc.resolution)?
    };
    let inner = if disc.inner > 0.0 { spiral.inner_radius } else { 0.0 };
    let curves = spiral.records.into_iter().map(PlaneCurve::from).collect();
    Ok(Cleared { inner, ..disc.cleared(curves, f64::from(spiral.turns), spiral.step)? })
}

/// In whole turns of constant normal step, without regard to what a control can print: only order zero has a native
/// form, for which [`super::Clearing::Involute`] is meant.
pub(super) fn lens(disc: &Disc, order: LensOrder) -> Result<Cleared> {
    let n = turns(disc.outer - disc.inner, disc.step)?;
    let curves = vec![lens_between(disc.inner, disc.outer, n, disc.psi, order)?];
    disc.cleared(curves, f64::from(n), (disc.outer - disc.inner) / f64::from(n))
}

/// The lens involute between two circles about the origin, in whole turns.
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
