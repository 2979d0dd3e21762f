//! The surfaces of a hole as the job gives them: faces placed in the work offset, seen from each hole.

use std::f64::consts::FRAC_PI_2;

use super::super::file::{CrossBoreTable, ExitTable, ExitWord, FaceTable, SurfaceName};
use crate::drilling::Face;

/// Distance of a point from the origin of a frame, along a direction given in degrees from X [mm].
fn along(point: [f64; 2], at: Option<[f64; 2]>, angle: f64) -> f64 {
    let [x, y] = at.unwrap_or_default();
    let (sin, cos) = angle.sin_cos();
    // A right angle in degrees is none in radians: what is nothing but its rounding is nothing.
    let clean = |v: f64| if v.abs() < 1e-15 { 0.0 } else { v };
    (point[0] - x) * clean(cos) + (point[1] - y) * clean(sin)
}

/// The face under a hole.
pub(super) fn face(table: &FaceTable, point: [f64; 2]) -> Face {
    let direction = table.direction.unwrap_or(0.0).to_radians();
    let radius = table.radius.unwrap_or(0.0);
    // A plane rises along its direction; a cylinder's axis runs along it.
    let across = match table.surface {
        SurfaceName::Plane => direction,
        SurfaceName::OuterCylinder | SurfaceName::InnerCylinder => direction + FRAC_PI_2,
    };
    let offset = table.offset.unwrap_or_else(|| along(point, table.at, across));
    match table.surface {
        SurfaceName::Plane => {
            Face::Plane { inclination: table.inclination.unwrap_or(0.0).to_radians(), offset }
        }
        SurfaceName::OuterCylinder => Face::OuterCylinder { radius, offset },
        SurfaceName::InnerCylinder => Face::InnerCylinder { radius, offset },
    }
}

/// The face at the other end of a hole.
pub(super) fn exit_face(exit: &ExitTable, entry: &FaceTable, point: [f64; 2]) -> Face {
    match exit {
        ExitTable::Word(ExitWord::Same) => face(entry, point),
        ExitTable::Face(table) => face(table, point),
    }
}

/// Distance of the tool axis from a bore's axis [mm].
pub(super) fn bore_offset(bore: &CrossBoreTable, point: [f64; 2]) -> f64 {
    let across = bore.direction.unwrap_or(0.0).to_radians() + FRAC_PI_2;
    bore.offset.unwrap_or_else(|| along(point, bore.at, across))
}
