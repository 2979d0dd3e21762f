//! The Archimedean spiral: constant step along the radius, in whole turns. Without contact: it meets its circles with
//! a kink of `atan(step / (2 pi radius))`.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::disc::{Cleared, Disc, turns};
use crate::base::Result;
use crate::geom::{Spiral, SpiralLaw};

pub(super) fn archimedes(disc: &Disc) -> Result<Cleared> {
    let n = turns(disc.outer - disc.inner, disc.step)?;
    let growth = (disc.outer - disc.inner) / (TAU * f64::from(n));
    // Parameters are polar angles; the radii are exact at both ends, and the last one lies at the wall point.
    let (from, to) = (disc.inner / growth, disc.outer / growth);
    let place = (disc.psi - FRAC_PI_2 - to).rem_euclid(TAU);
    let spiral = Spiral::new(SpiralLaw::Archimedes { growth }, from, to)?.rotated(place);
    // The step along the radius, which the normal step comes near to from below.
    disc.cleared(vec![spiral.into()], f64::from(n), TAU * growth)
}
