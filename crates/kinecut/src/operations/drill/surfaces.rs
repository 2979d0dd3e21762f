//! The surfaces of a hole as the job gives them: faces placed in the work offset, seen from each hole.

use std::f64::consts::FRAC_PI_2;

use super::{CrossBoreTable, ExitTable, FaceTable, PreHoleTable, SurfaceName};
use crate::base::Result;
use crate::drilling::{CrossBore, PartFace, PreHole};
use crate::tool::DrillPoint;

/// Distance of a point from the origin of a frame, along a direction given in degrees from X [mm].
fn along(point: [f64; 2], at: Option<[f64; 2]>, angle: f64) -> f64 {
    let [x, y] = at.unwrap_or_default();
    let (sin, cos) = angle.sin_cos();
    // A right angle in degrees is not exact in radians: values as small as its rounding are zero.
    let clean = |v: f64| if v.abs() < 1e-15 { 0.0 } else { v };
    (point[0] - x) * clean(cos) + (point[1] - y) * clean(sin)
}

/// The face under a hole.
pub(super) fn face(table: &FaceTable, point: [f64; 2]) -> PartFace {
    let radius = table.radius.unwrap_or(0.0);
    let offset = table.offset.unwrap_or_else(|| along(point, table.at, across(table)));
    match table.surface {
        SurfaceName::Plane => {
            PartFace::Plane { inclination: table.inclination.unwrap_or(0.0).to_radians(), offset }
        }
        SurfaceName::OuterCylinder => PartFace::OuterCylinder { radius, offset },
        SurfaceName::InnerCylinder => PartFace::InnerCylinder { radius, offset },
    }
}

/// The face at the other end of a hole.
pub(super) fn exit_face(exit: &ExitTable, entry: &FaceTable, point: [f64; 2]) -> PartFace {
    match exit {
        ExitTable::Same => face(entry, point),
        ExitTable::Face(table) => face(table, point),
    }
}

/// Direction of a face's u from X [rad]: a plane rises along its direction, a cylinder's axis runs along it.
pub(super) fn across(table: &FaceTable) -> f64 {
    let direction = table.direction.unwrap_or(0.0).to_radians();
    match table.surface {
        SurfaceName::Plane => direction,
        SurfaceName::OuterCylinder | SurfaceName::InnerCylinder => direction + FRAC_PI_2,
    }
}

/// A bore on the way of a hole; `top` is where Z counts from, `base` the direction of the entry's u.
pub(super) fn bore(table: &CrossBoreTable, point: [f64; 2], top: f64, base: f64) -> CrossBore {
    let across = table.direction.unwrap_or(0.0).to_radians() + FRAC_PI_2;
    CrossBore {
        radius: table.diameter / 2.0,
        offset: table.offset.unwrap_or_else(|| along(point, table.at, across)),
        height: table.z - top,
        turn: across - base,
    }
}

/// The hole that is there, in the same terms.
///
/// # Errors
/// Those of its bottom.
pub(super) fn pre_hole(table: &PreHoleTable, top: f64, base: f64) -> Result<PreHole> {
    let hole = match (table.bottom, table.bottom_angle) {
        (None, _) => PreHole::through(table.diameter),
        (Some(bottom), None | Some(180.0)) => PreHole::flat(table.diameter, bottom - top)?,
        (Some(bottom), Some(angle)) => {
            let edge = DrillPoint::SinglePlane { angle: angle.to_radians() }.edge(table.diameter)?;
            PreHole::blind(table.diameter, bottom - top, edge)
        }
    };
    let [x, y] = table.offset.unwrap_or_default();
    let turned = glam::DVec2::from_angle(-base).rotate(glam::DVec2::new(x, y));
    Ok(hole.moved(turned.to_array()))
}
