//! Rigid motions.

use glam::{DMat3, DVec3};

/// A rigid motion: `p -> rotation * p + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// Rotation, right-handed.
    pub rotation: DMat3,
    /// Translation [mm].
    pub translation: DVec3,
}

impl Rigid {
    /// No motion.
    pub const IDENTITY: Rigid = Rigid { rotation: DMat3::IDENTITY, translation: DVec3::ZERO };

    /// A translation [mm].
    #[inline]
    pub fn from_translation(translation: DVec3) -> Rigid {
        Rigid { rotation: DMat3::IDENTITY, translation }
    }

    /// Moves a point.
    #[inline]
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.translation
    }

    /// Turns a vector.
    #[inline]
    pub fn vector(&self, v: DVec3) -> DVec3 {
        self.rotation * v
    }

    /// First `other`, then `self`.
    #[must_use]
    #[inline]
    pub fn after(&self, other: &Rigid) -> Rigid {
        Rigid { rotation: self.rotation * other.rotation, translation: self.point(other.translation) }
    }

    /// The motion back.
    #[must_use]
    #[inline]
    pub fn inverse(&self) -> Rigid {
        let rotation = self.rotation.transpose();
        Rigid { rotation, translation: -(rotation * self.translation) }
    }
}
