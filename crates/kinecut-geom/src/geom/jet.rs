//! A point of a curve in space with its derivatives.

use glam::DVec3;

/// A point of a curve and its derivatives by arc length [mm, 1, 1/mm, 1/mm^2].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Position [mm].
    pub p: DVec3,
    /// Unit tangent.
    pub d1: DVec3,
    /// Second derivative: curvature vector [1/mm].
    pub d2: DVec3,
    /// Third derivative [1/mm^2].
    pub d3: DVec3,
}

impl Jet {
    /// Curvature [1/mm], never negative.
    pub fn curvature(&self) -> f64 {
        self.d2.length()
    }
}
