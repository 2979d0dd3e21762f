//! A place where a tooth crosses the outline.

use glam::DVec2;

/// A tooth crosses an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothCrossing {
    /// Index of the tooth.
    pub tooth: u32,
    /// Index of the edge.
    pub edge: u32,
    /// The tooth leaves the material; otherwise it enters.
    pub exit: bool,
    /// The half of the cutter ahead of its centre crosses, which removes the stock.
    pub front: bool,
    /// Time, as the angle the spindle has turned [rad].
    pub time: f64,
    /// Place, as the share of the edge's length, 0 included and 1 excluded.
    pub share: f64,
    /// The place in the frame of the pass [mm].
    pub point: DVec2,
    /// Velocity along the edge, per radian and radius.
    pub along: f64,
    /// Velocity across the edge away from the material, per radian and radius: positive at exits.
    pub outward: f64,
    /// Distance of the tooth ahead of the cutter centre, per radius: the cosine of its polar angle.
    pub ahead: f64,
}

impl ToothCrossing {
    /// Angle from the direction of the edge to the velocity of the tooth, counter-clockwise, in (-pi, pi]; positive
    /// at exits [rad].
    pub fn exit_angle(&self) -> f64 {
        self.outward.atan2(self.along)
    }

    /// Thickness of the chip here, for teeth of even pitch [mm]; 0 behind the centre.
    pub fn chip_thickness(&self, feed_per_tooth: f64) -> f64 {
        if self.ahead > 0.0 { feed_per_tooth * self.ahead } else { 0.0 }
    }
}
