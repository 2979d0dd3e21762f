//! Elements of a contour.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Role of an element of a tool.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum ElementRole {
    /// It cuts.
    #[default]
    Cutting,
    /// It must not touch, but may follow into what was cut.
    Shank,
    /// It must not touch.
    Holder,
}

/// The form of an element: radius in x, height in y [mm]. The way runs from the bottom of the tool outwards and upwards, with
/// the material on its left; a normal angle is `atan2` of the outward normal's height by its radius [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContourShape {
    /// A cone, cylinder or disc.
    Line {
        /// Start.
        start: DVec2,
        /// End.
        end: DVec2,
    },
    /// A torus or sphere. `point = centre + sign radius (cos phi, sin phi)`, where phi is the normal angle and the sign that
    /// of convexity.
    Arc {
        /// Centre; left of the axis for a barrel.
        centre: DVec2,
        /// Radius.
        radius: f64,
        /// The material is on the centre's side: phi then grows along the way, else it falls.
        convex: bool,
        /// Normal angle at the start.
        from: f64,
        /// Normal angle at the end.
        to: f64,
    },
}

impl ContourShape {
    /// Its first point.
    pub fn start(&self) -> DVec2 {
        match *self {
            ContourShape::Line { start, .. } => start,
            ContourShape::Arc { centre, radius, convex, from, .. } => on_arc(centre, radius, convex, from),
        }
    }

    /// Its last point.
    pub fn end(&self) -> DVec2 {
        match *self {
            ContourShape::Line { end, .. } => end,
            ContourShape::Arc { centre, radius, convex, to, .. } => on_arc(centre, radius, convex, to),
        }
    }

    /// Length [mm].
    pub fn length(&self) -> f64 {
        match *self {
            ContourShape::Line { start, end } => (end - start).length(),
            ContourShape::Arc { radius, from, to, .. } => radius * (to - from).abs(),
        }
    }

    /// Normal angles at its start and end [rad].
    pub fn normals(&self) -> [f64; 2] {
        match *self {
            ContourShape::Line { start, end } => {
                let t = end - start;
                let phi = (-t.x).atan2(t.y);
                [phi, phi]
            }
            ContourShape::Arc { from, to, .. } => [from, to],
        }
    }
}

/// A point of an arc by its normal angle.
pub(super) fn on_arc(centre: DVec2, radius: f64, convex: bool, phi: f64) -> DVec2 {
    let (sin, cos) = phi.sin_cos();
    centre + DVec2::new(cos, sin) * if convex { radius } else { -radius }
}

/// An element of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourElement {
    /// Form.
    pub shape: ContourShape,
    /// Its role.
    pub role: ElementRole,
    /// Number of the body of a stacked tool that it belongs to, counted from the tip.
    pub body: u16,
}

impl ContourElement {
    /// A straight element.
    pub fn line(start: [f64; 2], end: [f64; 2], role: ElementRole) -> ContourElement {
        let shape = ContourShape::Line { start: DVec2::from(start), end: DVec2::from(end) };
        ContourElement { shape, role, body: 0 }
    }

    /// A circular element between two normal angles [rad]; convex when they grow.
    pub fn arc(centre: [f64; 2], radius: f64, from: f64, to: f64, role: ElementRole) -> ContourElement {
        let shape = ContourShape::Arc { centre: DVec2::from(centre), radius, convex: to > from, from, to };
        ContourElement { shape, role, body: 0 }
    }
}

/// Wraps a turn of the normal into (-pi, pi].
pub fn turn(from: f64, to: f64) -> f64 {
    let by = (to - from).rem_euclid(2.0 * PI);
    if by > PI { by - 2.0 * PI } else { by }
}

/// Normal angle along the axis, downwards: where a contour begins.
pub const DOWN: f64 = -FRAC_PI_2;
/// Normal angle along the axis, upwards: where a contour ends.
pub const UP: f64 = FRAC_PI_2;
