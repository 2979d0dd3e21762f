//! Simple solids: what stock, fixtures and designs are given as.

use glam::DVec3;

use super::{Aabb, Mesh};

/// A simple solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// An axis-aligned box.
    Box(Aabb),
    /// A cylinder standing on `base`, its axis along Z.
    Cylinder {
        /// Centre of the lower face [mm].
        base: DVec3,
        /// Radius [mm].
        radius: f64,
        /// Height [mm].
        height: f64,
    },
    /// A closed mesh.
    Mesh(Mesh),
}

impl Solid {
    /// The box of the solid.
    pub fn bounds(&self) -> Aabb {
        match self {
            Solid::Box(bounds) => *bounds,
            Solid::Cylinder { base, radius, height } => Aabb {
                min: *base - DVec3::new(*radius, *radius, 0.0),
                max: *base + DVec3::new(*radius, *radius, *height),
            },
            Solid::Mesh(mesh) => mesh.bounds(),
        }
    }
}
