//! Straight lines.

use glam::DVec3;

use super::Jet;

/// A straight line from `start` to `end` [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// First point.
    pub start: DVec3,
    /// Last point.
    pub end: DVec3,
}

impl Line {
    /// Length [mm].
    #[inline]
    pub fn length(&self) -> f64 {
        (self.end - self.start).length()
    }

    /// Point and derivatives at arc length `s` [mm]; a line of no length has no direction.
    pub fn at(&self, s: f64) -> Jet {
        let d1 = (self.end - self.start).try_normalize().unwrap_or(DVec3::ZERO);
        Jet { p: self.start + d1 * s, d1, d2: DVec3::ZERO, d3: DVec3::ZERO }
    }
}
