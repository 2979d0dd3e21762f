//! Bodies moved to another place, and hollow ones.

use glam::DVec3;

use super::Distance;
use crate::geom::Rigid;

/// A body moved to another place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<D> {
    body: D,
    place: Rigid,
    back: Rigid,
}

impl<D: Distance> Placed<D> {
    /// A body whose own coordinates are mapped by `place`.
    pub fn new(body: D, place: Rigid) -> Placed<D> {
        Placed { body, place, back: place.inverse() }
    }
}

impl<D: Distance> Distance for Placed<D> {
    fn signed(&self, p: DVec3) -> f64 {
        self.body.signed(self.back.point(p))
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        self.place.vector(self.body.gradient(self.back.point(p)))
    }
}

/// The complement of a body: a bore is a hollow cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hollow<D>(pub D);

impl<D: Distance> Distance for Hollow<D> {
    fn signed(&self, p: DVec3) -> f64 {
        -self.0.signed(p)
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        -self.0.gradient(p)
    }
}
