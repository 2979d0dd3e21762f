//! Axis-aligned boxes.

use glam::DVec3;

/// A closed axis-aligned box [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least corner.
    pub min: DVec3,
    /// Greatest corner.
    pub max: DVec3,
}

impl Aabb {
    /// The box that holds nothing: the neutral element of [`Aabb::union`].
    pub const EMPTY: Aabb = Aabb { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box of some points.
    pub fn of_points(points: impl IntoIterator<Item = DVec3>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, |b, p| Aabb { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(self, other: Aabb) -> Aabb {
        Aabb { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box with a margin [mm] on every side.
    #[must_use]
    pub fn grown(self, margin: f64) -> Aabb {
        Aabb { min: self.min - margin, max: self.max + margin }
    }

    /// True if it holds no point.
    pub fn is_empty(self) -> bool {
        !(self.min.cmple(self.max).all())
    }

    /// Edge lengths [mm].
    pub fn size(self) -> DVec3 {
        self.max - self.min
    }

    /// True if the boxes share a point.
    pub fn meets(self, other: Aabb) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}
