//! Distance from a straight cutting edge.

use glam::DVec3;

use super::Distance;

/// A straight edge between two points [mm]; its distance has no sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeLine {
    /// One end [mm].
    pub from: DVec3,
    /// The other end [mm].
    pub to: DVec3,
}

impl Distance for EdgeLine {
    fn signed(&self, p: DVec3) -> f64 {
        let along = self.to - self.from;
        let squared = along.length_squared();
        let share = if squared > 0.0 { ((p - self.from).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (p - self.from - along * share).length()
    }
}
