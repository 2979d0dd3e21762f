//! Passes over a face as moves of a program.

use glam::{DVec2, DVec3};

use super::super::check::FaceOperation;
use crate::base::Result;
use crate::facing::passes::PassPath;
use crate::geom::{Arc, Curve, Line, OutlineEdge};
use crate::program::{Coolant, Move, Origin, Program, Role, Speed, State};

/// Distance above a level at which a rapid down ends [mm]: the rest is fed.
const ABOVE: f64 = 2.0;

/// Height of the moves between passes and what is switched on above the first.
#[derive(Clone, Copy, Debug)]
pub(in crate::job) struct Over {
    /// Height of the moves between passes [mm].
    pub(in crate::job) clearance: f64,
    /// Coolant.
    pub(in crate::job) coolant: Coolant,
}

/// Mills the face along `path`, given in the coordinates of the state's frame, level after level; `origin` is that of
/// the operation.
///
/// # Errors
/// Those of arcs.
pub(in crate::job) fn push_face(
    program: &mut Program,
    state: &mut State,
    (face, path): (&FaceOperation, &PassPath),
    over: Over,
    origin: Origin,
) -> Result<()> {
    let mut pen = Pen { program, state, origin };
    let feed = Speed::PerMinute(face.feed);
    let mut known = false;
    for (k, &level) in face.levels.iter().enumerate() {
        let role = if k + 1 == face.levels.len() { Role::Finish } else { Role::Rough };
        for chain in path.chains.iter().filter(|c| !c.is_empty()) {
            let start = chain[0].start;
            // From the tool change the height is not known: first over the place, then down.
            pen.rapid(start, if known { over.clearance } else { f64::NAN });
            if !known {
                pen.rapid(start, over.clearance);
                pen.state.coolant = over.coolant;
                known = true;
            }
            if level + ABOVE < over.clearance {
                pen.rapid(start, level + ABOVE);
            }
            pen.along(&line_to(start, level), feed, Role::Lead);
            for edge in chain {
                pen.along(&curve(edge, level)?, feed, role);
            }
            pen.rapid(chain[chain.len() - 1].end, over.clearance);
        }
    }
    Ok(())
}

struct Pen<'a> {
    program: &'a mut Program,
    state: &'a mut State,
    origin: Origin,
}

impl Pen<'_> {
    fn along(&mut self, curve: &Curve, speed: Speed, role: Role) {
        self.state.speed = speed;
        self.program.push_move(Move::along(curve), self.state, Origin { role, ..self.origin });
    }

    fn rapid(&mut self, at: DVec2, z: f64) {
        self.along(&line_to(at, z), Speed::Rapid { linear: true }, Role::Link);
    }
}

/// A straight move from wherever the tool stands.
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
