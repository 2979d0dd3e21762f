//! Distance from the flank of an involute cylinder, in closed form.
//!
//! All normals of an involute touch its base circle, and the distance along a normal equals the difference of the
//! unrolled lengths. So the distance of a point is the length of the tangent from it to the base circle, less the arc
//! of the base circle that the involute has unrolled there.

use glam::DVec3;

use super::Distance;
use crate::num::angle::wrap;

/// A flank that is an involute cylinder about Z. Material is on the side of the base circle from which the involute
/// unwinds: the distance is positive on the outer, convex side of the flank.
///
/// The flank is unrolled from the point of the base circle at angle `start`: at roll `t` it is at
/// `base ((cos, sin)(start + t) + t (sin, -cos)(start + t))`.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::machine::generation::{Distance, InvoluteFlank};
/// let flank = InvoluteFlank { base: 10.0, start: 0.0, clockwise: false, teeth: 1 };
/// let t = 0.7f64;
/// let (s, c) = t.sin_cos();
/// let on = DVec3::new(c + t * s, s - t * c, 0.0) * 10.0;
/// assert!(flank.signed(on).abs() < 1e-13);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InvoluteFlank {
    /// Radius of the base circle [mm].
    pub base: f64,
    /// Angle of the first point of the involute [rad].
    pub start: f64,
    /// True if the roll turns clockwise.
    pub clockwise: bool,
    /// Number of equal flanks around the circle; the nearest one counts.
    pub teeth: u32,
}

impl Distance for InvoluteFlank {
    fn signed(&self, p: DVec3) -> f64 {
        let mirror = if self.clockwise { -1.0 } else { 1.0 };
        let (x, y) = (p.x, p.y * mirror);
        let r = x.hypot(y);
        let pitch = std::f64::consts::TAU / f64::from(self.teeth.max(1));
        let tangent = ((r - self.base) * (r + self.base)).max(0.0).sqrt();
        let at = y.atan2(x) + tangent.atan2(self.base);
        let roll = nearest(at - self.start * mirror, tangent / self.base, pitch);
        let along = tangent - self.base * roll;
        // A flank begins at its first point, on the base circle: it has no normal below, and none inside of the circle.
        let angle = wrap((y.atan2(x) - self.start * mirror) / pitch * std::f64::consts::TAU) * pitch
            / std::f64::consts::TAU;
        let first = (r - self.base * angle.cos()).hypot(self.base * angle.sin());
        let normal = if roll < 0.0 { tangent - self.base * (roll + pitch) } else { along };
        if r >= self.base && normal.abs() <= first { normal } else { first.copysign(along) }
    }
}

/// The value equal to `angle` modulo `pitch` that is nearest to `wanted`.
fn nearest(angle: f64, wanted: f64, pitch: f64) -> f64 {
    angle + ((wanted - angle) / pitch).round() * pitch
}
