//! Sliding groups: the motions that carry a surface along itself.

mod group;
mod slide;

pub(super) use group::Fit;
pub use group::{Form, SlidingGroup, sliding_group};
pub use slide::Slide;

use glam::DVec3;

/// A point of a surface with its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The point [mm].
    pub point: DVec3,
    /// Unit normal out of the material.
    pub normal: DVec3,
    /// Weight, for example its share of the area [mm^2].
    pub weight: f64,
}
