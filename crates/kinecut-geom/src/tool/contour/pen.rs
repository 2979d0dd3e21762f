//! Drawing a contour from point to point: elements without length are left out, arcs are given by their normals.

use glam::DVec2;

use super::{Contour, ContourElement, ContourShape, ElementRole};
use crate::base::Result;

/// Length below which nothing is drawn [mm]: what is left of a face when a corner takes the whole of it, in rounding.
const NOTHING: f64 = 1e-12;

/// A contour on its way up.
#[derive(Clone, Debug)]
pub(super) struct Pen {
    elements: Vec<ContourElement>,
    at: DVec2,
    role: ElementRole,
    body: u16,
}

impl Pen {
    /// On the axis at a height [mm], drawing what cuts.
    pub(super) fn at(height: f64) -> Pen {
        Pen { elements: Vec::new(), at: DVec2::new(0.0, height), role: ElementRole::Cutting, body: 0 }
    }

    /// From now on drawing another role.
    pub(super) fn role(mut self, role: ElementRole) -> Pen {
        self.role = role;
        self
    }

    /// Straight to a radius and a height [mm].
    pub(super) fn to(mut self, radius: f64, height: f64) -> Pen {
        let end = DVec2::new(radius, height);
        if self.at.distance(end) > NOTHING {
            self.push(ContourShape::Line { start: self.at, end });
        }
        self
    }

    /// Along a circle between two normal angles [mm, rad], convex when they grow; from the pen's place, which must be on it.
    pub(super) fn round(mut self, centre: [f64; 2], radius: f64, from: f64, to: f64) -> Pen {
        if radius * (to - from).abs() > NOTHING {
            let centre = DVec2::from(centre);
            self.push(ContourShape::Arc { centre, radius, convex: to > from, from, to });
        }
        self
    }

    /// Back to the axis at a height, and checked. What is on the way there is held or hidden: it does not cut.
    pub(super) fn cap(self, height: f64) -> Result<Contour> {
        let role = if self.role == ElementRole::Cutting { ElementRole::Shank } else { self.role };
        Contour::new(self.role(role).to(0.0, height).elements)
    }

    fn push(&mut self, shape: ContourShape) {
        self.at = shape.end();
        self.elements.push(ContourElement { shape, role: self.role, body: self.body });
    }
}
