//! The shape that an operation wants, in coordinates of its work offset or plane: walls, a plane, the outline that has to lie in
//! the stock.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec2;

use super::band::{Band, Slope};

use crate::geom::{Outline, ellipse_distance};

/// A wall that an operation wants, with what it encloses.
#[derive(Clone, Debug)]
pub(crate) struct WantedWall {
    /// Centre in the plane of the work offset [mm].
    pub(crate) centre: DVec2,
    /// The wall.
    pub(crate) wall: Wall,
    /// Height of its rim [mm].
    pub(crate) top: f64,
    /// Height of the floor [mm]; `None` when it goes through.
    pub(crate) floor: Option<f64>,
    /// Lowest height at which the wall is wanted [mm].
    pub(crate) bottom: f64,
    /// Radius of a core that is meant to fall out [mm]: the core is not looked at.
    pub(crate) slug: f64,
}

impl WantedWall {
    /// Itself where a cutter of a diameter [mm] goes in: a wall that the planner has left out is not wanted either.
    pub(crate) fn fits(self, cutter: f64) -> Option<WantedWall> {
        (self.wall.radius(self.bottom) > cutter / 2.0).then_some(self)
    }
}

/// A plane that an operation wants.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WantedPlane<'a> {
    /// Its outline, as the part lies when it is not turned.
    pub(crate) outline: &'a Outline,
    /// Angle by which the part is turned on the table, counter-clockwise [rad].
    pub(crate) turned: f64,
    /// Height [mm].
    pub(crate) top: f64,
}

impl WantedPlane<'_> {
    /// A point of the work offset in the coordinates of the outline.
    pub(crate) fn in_outline(&self, point: DVec2) -> DVec2 {
        DVec2::from_angle(-self.turned).rotate(point)
    }
}

/// An elliptic or round outline around which there must be material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlannedOutline {
    /// Centre in the plane of the work offset [mm].
    pub(crate) centre: DVec2,
    /// Half axes [mm].
    pub(crate) half_axes: [f64; 2],
    /// Direction of the first from X [rad].
    pub(crate) angle: f64,
    /// Height of its rim [mm].
    pub(crate) top: f64,
    /// Depth below the rim [mm].
    pub(crate) depth: f64,
}

/// A wall about the operation's centre.
#[derive(Clone, Debug)]
pub(crate) enum Wall {
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
    /// The wall along a contour, about the middle of its outline.
    Band(Arc<Band>),
}

impl Wall {
    /// Distance from the wall in the plane, positive inside [mm]. `off` is counted from the centre.
    pub(crate) fn inside(&self, off: DVec2, height: f64) -> f64 {
        match self {
            Wall::Round { .. } => self.radius(height) - off.length(),
            Wall::Ellipse { half_axes, turned, leave } => {
                ellipse_distance(*half_axes, DVec2::from_angle(-turned).rotate(off)) - leave
            }
            Wall::Band(band) => band.inside(band.middle + off, height),
        }
    }

    /// The same where the wall is compared; not a number where it is not.
    pub(crate) fn compared(&self, off: DVec2, height: f64) -> f64 {
        match self {
            Wall::Band(band) => band.compared(band.middle + off, height),
            _ => self.inside(off, height),
        }
    }

    /// Distance from the border of what is level at a floor, positive over it [mm]; not a number where it is not compared.
    pub(crate) fn over_floor(&self, off: DVec2, floor: f64) -> f64 {
        match self {
            Wall::Band(band) => band.over_floor(band.middle + off, floor),
            _ => self.inside(off, floor),
        }
    }

    /// The lean of a wall along a contour that a conical cutter leaves.
    pub(crate) fn slope(&self) -> Option<Slope> {
        match self {
            Wall::Band(band) => band.slope(),
            _ => None,
        }
    }

    /// Whether a point lies on the face beside the upper edge of a wall that leans.
    pub(crate) fn beside_edge(&self, off: DVec2) -> bool {
        matches!(self, Wall::Band(band) if band.beside_edge(band.middle + off))
    }

    /// The part of a face's normal that looks to where is cut: 1 of a face along the wall.
    pub(crate) fn towards_cut(&self, off: DVec2, normal: DVec2) -> f64 {
        match self {
            Wall::Band(band) => band.towards_cut(band.middle + off, normal),
            Wall::Round { .. } => -normal.dot(off.normalize_or_zero()),
            Wall::Ellipse { half_axes: [a, b], turned, .. } => {
                let [x, y] = DVec2::from_angle(-turned).rotate(off).to_array();
                let out = DVec2::new(x / (a * a), y / (b * b)).normalize_or_zero();
                -normal.dot(DVec2::from_angle(*turned).rotate(out))
            }
        }
    }

    /// Radius of a round wall at a height, half the longer axis, or what the strip along a contour stays within [mm].
    pub(crate) fn radius(&self, height: f64) -> f64 {
        match self {
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
            Wall::Band(band) => band.reach,
        }
    }

    /// The point of the wall in a direction from the centre, at a height, counted from the centre.
    pub(crate) fn point(&self, angle: f64, height: f64) -> DVec2 {
        match self {
            Wall::Round { .. } => DVec2::from_angle(angle) * self.radius(height),
            Wall::Ellipse { half_axes: [a, b], turned, leave } => {
                let (sin, cos) = angle.sin_cos();
                // Stock left on the wall is counted along its normal.
                let normal = DVec2::new(cos / a, sin / b).normalize_or_zero();
                DVec2::from_angle(*turned).rotate(DVec2::new(a * cos, b * sin) - normal * leave)
            }
            Wall::Band(band) => band.point(angle / TAU) - band.middle,
        }
    }
}
