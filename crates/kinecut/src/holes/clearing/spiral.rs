//! The circle involute of the paper, and its annular form between two circles.

use super::{Cleared, Disc};
use crate::base::Result;
use crate::geom::PlaneCurve;
use crate::holes::rounded::{spiral_from_centre, spiral_from_circle};
use crate::holes::spiral::circle;

pub(super) fn involute(disc: &Disc) -> Result<Cleared> {
    let spiral = if disc.inner > 0.0 {
        spiral_from_circle(disc.inner, disc.inner_most, disc.outer, disc.step, disc.psi, disc.resolution)?
    } else {
        spiral_from_centre(disc.outer, disc.step, disc.psi, disc.resolution)?
    };
    let spiral_start = if disc.inner > 0.0 { spiral.inner_radius } else { 0.0 };
    Ok(Cleared {
        curves: spiral.records.into_iter().map(PlaneCurve::from).collect(),
        inner: spiral_start,
        closing: circle(disc.outer, disc.psi)?,
        turns: f64::from(spiral.turns),
        step: spiral.step,
        engagement: None,
    })
}
