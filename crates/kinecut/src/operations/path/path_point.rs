//! A point of a tool path.

use glam::DVec3;

/// Speed at which a point is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointPace {
    /// Rapid.
    Rapid,
    /// At a feed of its own [mm/s].
    Feed(f64),
    /// At the operation's feed.
    OfOperation,
}

/// A point of a tool path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Tool tip [mm, work offset].
    pub tip: DVec3,
    /// Unit vector from tip to holder; none keeps that of the point before, and along Z at the start.
    pub axis: Option<DVec3>,
    /// Speed at which it is reached.
    pub pace: PointPace,
}
