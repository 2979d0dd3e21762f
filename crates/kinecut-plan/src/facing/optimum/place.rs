//! A box of angles and offsets, with what the bounds of all edges need of it.

use super::domain::{Extent, Turned};

/// A box of placements, with what all edges need of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacementBox {
    pub(super) turned: Turned,
    pub(super) offset: Extent,
    /// Angle and offset of the middle.
    pub(super) middle: [f64; 2],
    /// Sine and cosine of the middle's angle.
    pub(super) sin_cos: (f64, f64),
    /// Heights over the centre line between which every point lies where the placement is allowed.
    pub(super) reach: Extent,
}

impl PlacementBox {
    pub(super) fn new(angle: Extent, offset: Extent, reach: Extent) -> PlacementBox {
        let middle = [0.5 * (angle[0] + angle[1]), 0.5 * (offset[0] + offset[1])];
        PlacementBox { turned: Turned::new(angle), offset, middle, sin_cos: middle[0].sin_cos(), reach }
    }
}
