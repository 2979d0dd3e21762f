//! The wall that an operation wants, in the plane of its work offset.

use glam::DVec2;

use crate::geom::ellipse_distance;

/// A wall about the operation's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wall {
    /// A bore; conical when the radii differ.
    Round {
        /// Radius at the top and at the bottom [mm].
        radii: [f64; 2],
        /// Heights of top and bottom [mm].
        heights: [f64; 2],
    },
    /// An ellipse.
    Ellipse {
        /// Half axes [mm].
        half_axes: [f64; 2],
        /// Direction of the first from X [rad].
        turned: f64,
        /// Stock left on it [mm].
        leave: f64,
    },
}

impl Wall {
    /// Distance from the wall in the plane, positive inside [mm]. `off` is counted from the centre.
    pub(super) fn inside(&self, off: DVec2, height: f64) -> f64 {
        match *self {
            Wall::Round { .. } => self.radius(height) - off.length(),
            Wall::Ellipse { half_axes, turned, leave } => {
                ellipse_distance(half_axes, DVec2::from_angle(-turned).rotate(off)) - leave
            }
        }
    }

    /// Radius of a round wall at a height, or half the longer axis [mm].
    pub(super) fn radius(&self, height: f64) -> f64 {
        match *self {
            Wall::Round { radii: [top, bottom], heights: [upper, lower] } => {
                let share = ((upper - height) / (upper - lower)).clamp(0.0, 1.0);
                top + (bottom - top) * share
            }
            Wall::Ellipse { half_axes: [a, b], leave, .. } => {
                if a > b {
                    a - leave
                } else {
                    b - leave
                }
            }
        }
    }

    /// The point of the wall in a direction from the centre, at a height, counted from the centre.
    pub(super) fn point(&self, angle: f64, height: f64) -> DVec2 {
        match *self {
            Wall::Round { .. } => DVec2::from_angle(angle) * self.radius(height),
            Wall::Ellipse { half_axes: [a, b], turned, leave } => {
                let (sin, cos) = angle.sin_cos();
                // Stock left on the wall is counted along its normal.
                let normal = DVec2::new(cos / a, sin / b).normalize_or_zero();
                DVec2::from_angle(turned).rotate(DVec2::new(a * cos, b * sin) - normal * leave)
            }
        }
    }
}
