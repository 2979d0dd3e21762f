//! The tool of a split by the dimension and shape of what it brings along.

use glam::DVec3;

use super::super::{GeneratedSurface, ShapeFunction};
use crate::num::singular::Triangle;

/// The part of the surface that a tool brings along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ToolKind {
    /// A point: both lines are traced by motions.
    Point,
    /// A straight edge.
    StraightEdge,
    /// An edge of another shape.
    ProfiledEdge,
    /// The surface itself: a die.
    Surface,
}

impl ToolKind {
    /// The name as in findings and tables: "point tool", "straight edge".
    pub fn name(self) -> &'static str {
        match self {
            ToolKind::Point => "point tool",
            ToolKind::StraightEdge => "straight edge",
            ToolKind::ProfiledEdge => "profiled edge",
            ToolKind::Surface => "surface (die)",
        }
    }
}

/// Samples of an edge.
const SAMPLES: usize = 33;
/// Breadth of a straight edge by its length: rounding.
const STRAIGHT: f64 = 1e-9;

/// The kind of the tool whose chain has these of the two variables.
pub(super) fn kind(surface: &GeneratedSurface, tool: &ShapeFunction, has: [bool; 2]) -> ToolKind {
    match has {
        [false, false] => ToolKind::Point,
        [true, true] => ToolKind::Surface,
        _ => {
            let [u, v] = &surface.variables;
            let at = |fraction: f64| match has {
                [true, _] => tool.point(u.at(fraction), v.middle()),
                _ => tool.point(u.middle(), v.at(fraction)),
            };
            let points: Vec<DVec3> = (0..SAMPLES).map(|i| at(i as f64 / (SAMPLES - 1) as f64)).collect();
            let mut spread = Triangle::<3>::default();
            points.iter().for_each(|p| spread.push((*p - points[0]).to_array()));
            let (values, _) = spread.singular();
            if values[1] < STRAIGHT * values[0] { ToolKind::StraightEdge } else { ToolKind::ProfiledEdge }
        }
    }
}
