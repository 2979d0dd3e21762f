//! Trochoidal loops along the ring between the starting circle and the wall: `P = A e^(i u) + B e^(i w u)` with
//! `A = (outer + inner)/2`, `B = (outer - inner)/2`. For hard materials: each loop takes a thin slice.
//!
//! Each loop touches both circles. The carrier turns once, and no place is looped over twice: the number of loops is
//! a half more than a whole one, so that the path leaves the starting circle and comes to the wall in the same
//! direction from the origin; what its outward half loops alone have cut then closes the ring at the seam with half
//! the advance between neighbours. At the wall neighbouring loops are at most a step apart.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::disc::{Cleared, Disc, MOST_PIECES, too_many};
use crate::base::Result;
use crate::geom::{Spiral, SpiralLaw};

/// Loops come to a cusp at the starting circle when `B w = A`; nearer to it than this share one more loop is taken.
const CUSP: f64 = 1e-3;

pub(super) fn loops(disc: &Disc) -> Result<Cleared> {
    let carrier = 0.5 * (disc.outer + disc.inner);
    let loop_radius = 0.5 * (disc.outer - disc.inner);
    let wanted = TAU * disc.outer / disc.step;
    if wanted > MOST_PIECES {
        return Err(too_many(wanted, "loops"));
    }
    let mut count = (wanted - 0.5).ceil() + 0.5;
    while ((count + 1.0) * loop_radius - carrier).abs() < CUSP * carrier {
        count += 1.0;
    }
    // At parameter 0 it touches the wall at polar angle 0; a turn before, half a loop off, the starting circle.
    let law = SpiralLaw::Trochoid { carrier, loop_radius, rate: count + 1.0 };
    let spiral = Spiral::new(law, -TAU, 0.0)?.rotated(disc.psi - FRAC_PI_2);
    disc.cleared(vec![spiral.into()], 1.0, TAU * disc.outer / count)
}
