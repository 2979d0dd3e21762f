//! Passes over a face as moves of a program.

use glam::{DVec2, DVec3};

use super::FaceOperation;
use crate::base::Result;
use crate::facing::passes::PassPath;
use crate::geom::{Arc, Curve, Line, OutlineEdge};
use crate::operations::Pen;
use crate::program::{Role, Speed};

/// Distance above a level at which a rapid down ends [mm]: the rest is fed.
const ABOVE: f64 = 2.0;

/// Mills the face along `path`, given in the coordinates of the pen's frame, level after level.
///
/// # Errors
/// Those of arcs.
pub(super) fn write_face(pen: &mut Pen<'_>, face: &FaceOperation, path: &PassPath) -> Result<()> {
    let (feed, clearance) = (Speed::PerMinute(face.feed), pen.setting.clamping.safe_height);
    let mut known = false;
    for (k, &level) in face.levels.iter().enumerate() {
        let role = if k + 1 == face.levels.len() { Role::Finish } else { Role::Rough };
        for chain in path.chains.iter().filter(|c| !c.is_empty()) {
            let start = chain[0].start;
            // From the tool change the height is not known: first over the place, then down.
            rapid(pen, start, if known { clearance } else { f64::NAN });
            if !known {
                rapid(pen, start, clearance);
                pen.state.coolant = face.milling.coolant;
                known = true;
            }
            if level + ABOVE < clearance {
                rapid(pen, start, level + ABOVE);
            }
            pen.along(&line_to(start, level), feed, Role::Lead);
            for edge in chain {
                pen.along(&curve(edge, level)?, feed, role);
            }
            rapid(pen, chain[chain.len() - 1].end, clearance);
        }
    }
    Ok(())
}

fn rapid(pen: &mut Pen<'_>, at: DVec2, z: f64) {
    pen.along(&line_to(at, z), Speed::Rapid { linear: true }, Role::Link);
}

/// A straight move from wherever the tool is.
fn line_to(at: DVec2, z: f64) -> Curve {
    let end: DVec3 = at.extend(z);
    Line { start: end, end }.into()
}

/// A piece of a path at a height.
fn curve(edge: &OutlineEdge, z: f64) -> Result<Curve> {
    Ok(match edge.turn {
        None => Line { start: edge.start.extend(z), end: edge.end.extend(z) }.into(),
        Some(t) => Arc::new(edge.start.extend(z), t.centre.extend(z), DVec3::Z, t.sweep, 0.0)?.into(),
    })
}
