//! Signed distances of tools and of wanted surfaces.
//!
//! Positive outside of the body, negative inside, zero on its surface. An edge or a point has no inside: its distance
//! is never negative. All distances are exact (1-Lipschitz, gradient of length one away from the medial axis): the
//! minima over motions rely on it.

mod body;
mod edge;
mod hyperboloid;
mod involute;
mod meridian;
mod placed;
mod prism;
mod surface;

pub use body::ElementaryBody;
pub use edge::EdgeLine;
pub use hyperboloid::Hyperboloid;
pub use involute::InvoluteFlank;
pub use meridian::{Meridian, MeridianPiece};
pub use placed::{Hollow, Placed};
pub use prism::Prism;
pub use surface::{ParametricSurface, SurfaceMap};

use glam::DVec3;

use crate::geom::MeshDistance;

/// A body or a surface with the distances of points from it.
pub trait Distance: Sync {
    /// Distance [mm] of a point: positive outside, negative inside.
    fn signed(&self, p: DVec3) -> f64;

    /// Direction in which the distance grows fastest, of length one where the distance is smooth; zero where it has no
    /// direction (at a centre).
    fn gradient(&self, p: DVec3) -> DVec3 {
        // Central differences: error by truncation and by rounding balance at the cube root of the rounding unit.
        let h = STEP * p.abs().max_element().clamp(1.0, 1e3);
        let along = |e: DVec3| self.signed(p + e * h) - self.signed(p - e * h);
        (DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)) / (2.0 * h)).normalize_or_zero()
    }
}

/// Step of central differences, relative: cube root of the rounding unit.
const STEP: f64 = 6e-6;

impl Distance for MeshDistance {
    fn signed(&self, p: DVec3) -> f64 {
        MeshDistance::signed(self, p)
    }
}

impl<D: Distance + ?Sized> Distance for &D {
    fn signed(&self, p: DVec3) -> f64 {
        (**self).signed(p)
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        (**self).gradient(p)
    }
}

#[cfg(test)]
mod tests;
