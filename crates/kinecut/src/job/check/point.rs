//! Points of drills, checked.

use super::super::file::{PointTable, ToolTable};
use crate::base::{Code, Error, Finding, Result};
use crate::tool::{DrillPoint, Stage, Stages};

/// Usual point angle of a twist drill [deg].
const USUAL: f64 = 118.0;

/// The point of a drill.
pub(super) fn point(t: &ToolTable) -> Result<DrillPoint> {
    drill_point(t.point.as_ref(), t.point_angle, t.diameter)
}

/// The point of a drill of a diameter by its table, or by the angle of a twist drill.
pub(in crate::job) fn drill_point(
    table: Option<&PointTable>,
    point_angle: Option<f64>,
    diameter: f64,
) -> Result<DrillPoint> {
    let Some(table) = table else {
        let angle = point_angle.unwrap_or(USUAL).to_radians();
        // A twist drill "of 180 degrees" is flat.
        let flat = angle == std::f64::consts::PI;
        return checked(if flat { DrillPoint::Flat } else { DrillPoint::SinglePlane { angle } }, diameter);
    };
    if point_angle.is_some() {
        return Err(Finding::error(Code::JOB_SHAPE, "`point` and `point_angle` exclude each other")
            .help("write the angle into `point`")
            .key("point_angle")
            .into());
    }
    let (name, point) = from_table(table, diameter).map_err(|e| e.under("point"))?;
    checked(point, diameter).map_err(|e| under_point(e, name))
}

fn from_table(table: &PointTable, diameter: f64) -> Result<(&'static str, DrillPoint)> {
    let rad = f64::to_radians;
    Ok(match table {
        PointTable::Twist(t) => ("twist", DrillPoint::SinglePlane { angle: rad(t.point_angle) }),
        PointTable::DoubleGround(t) => (
            "double-ground",
            DrillPoint::DoubleGround { angle: rad(t.point_angle), second: rad(t.second_angle) },
        ),
        PointTable::CastIron(t) => (
            "cast-iron",
            DrillPoint::CastIron {
                angle: rad(t.point_angle),
                second: rad(t.second_angle),
                third: rad(t.third_angle),
                slot: t.slot,
            },
        ),
        PointTable::RoundedLips(t) => ("rounded-lips", DrillPoint::Rounded { radius: t.lip_radius }),
        PointTable::CornerRadius(t) => {
            ("corner-radius", DrillPoint::CornerRadius { angle: rad(t.point_angle), radius: t.corner_radius })
        }
        PointTable::ThinnedWeb(t) => {
            ("thinned-web", DrillPoint::ThinnedWeb { angle: rad(t.point_angle), flat: t.flat })
        }
        PointTable::SlottedChisel(t) => {
            ("slotted-chisel", DrillPoint::SlottedChisel { angle: rad(t.point_angle), slot: t.slot })
        }
        PointTable::Annular(t) => ("annular", DrillPoint::Annular { core: t.core_diameter }),
        PointTable::Flat => ("flat", DrillPoint::Flat),
        PointTable::Cannon(t) => {
            ("cannon", DrillPoint::Cannon { overlap: t.overlap, edge_angle: rad(t.edge_angle) })
        }
        PointTable::Gun(t) => (
            "gun",
            DrillPoint::Gun {
                apex: t.apex.unwrap_or(diameter / 4.0),
                outer_angle: rad(t.outer_angle),
                inner_angle: rad(t.inner_angle),
            },
        ),
        PointTable::Auger(t) => ("auger", DrillPoint::Auger { angle: rad(t.point_angle) }),
        PointTable::Ejector(t) => ("ejector", DrillPoint::Ejector { angle: rad(t.point_angle) }),
        PointTable::Cone(t) => ("cone", DrillPoint::Cone { angle: rad(t.cone_angle), nose: t.nose_diameter }),
        PointTable::Centre(t) => {
            let pilot =
                Stage { diameter: t.pilot_diameter, length: t.pilot_length, shoulder: rad(t.cone_angle) };
            ("centre", DrillPoint::Stepped { angle: rad(t.point_angle), stages: Stages::new(&[pilot])? })
        }
        PointTable::Stepped(t) => {
            let stages: Vec<Stage> = t
                .stages
                .iter()
                .map(|s| Stage { diameter: s.diameter, length: s.length, shoulder: rad(s.shoulder_angle) })
                .collect();
            let stages = Stages::new(&stages).map_err(|e| e.under("stepped"))?;
            ("stepped", DrillPoint::Stepped { angle: rad(t.point_angle), stages })
        }
    })
}

/// The point if it makes an edge of the tool's diameter.
fn checked(point: DrillPoint, diameter: f64) -> Result<DrillPoint> {
    point.edge(diameter).map(|_| point)
}

/// The key as the user wrote it: within the table of the point, unless it is the diameter.
fn under_point(error: Error, name: &str) -> Error {
    if error.0.key.as_deref() == Some("diameter") { error } else { error.under(&format!("point.{name}")) }
}
