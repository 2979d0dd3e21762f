//! Planned moves along a wall as moves of a program.

use glam::DVec3;

use crate::geom::Line;
use crate::holes::{self, PlannedMove, ToolpathPace};
use crate::operations::{Milling, Pen, WearRegister};
use crate::program::{Comp, Coolant, Move, Origin, Role, Speed, State};

/// Distance above material at which rapids end [mm].
pub(crate) const CLEARANCE: f64 = 2.0;

/// Writes planned moves; `comp` is the compensation of those that have one.
pub(crate) fn write_moves(pen: &mut Pen<'_>, moves: &[PlannedMove], coolant: Coolant, comp: Option<Comp>) {
    write_told_moves(pen, moves, coolant, comp, |_| Vec::new());
}

/// The same, with the comments that `told` gives before the move of an index.
pub(crate) fn write_told_moves(
    pen: &mut Pen<'_>,
    moves: &[PlannedMove],
    coolant: Coolant,
    comp: Option<Comp>,
    told: impl Fn(usize) -> Vec<String>,
) {
    let mut first = true;
    for (i, m) in moves.iter().enumerate() {
        told(i).into_iter().for_each(|text| pen.text(text));
        let (program, state) = (&mut *pen.program, &mut *pen.state);
        state.speed = match m.pace {
            ToolpathPace::Rapid => Speed::Rapid { linear: true },
            ToolpathPace::Feed(feed) => Speed::PerMinute(feed),
        };
        state.comp = if m.comp { comp.unwrap_or(Comp::Off) } else { Comp::Off };
        let origin = Origin { role: role(m), ..pen.origin };
        if first {
            // From wherever the tool stands: first over the place, then down.
            let at = m.curve.start();
            let over = Line { start: at, end: DVec3::new(at.x, at.y, f64::NAN) };
            let travel = State { speed: Speed::Rapid { linear: true }, ..*state };
            program.push_move(Move::along(&over.into()), &travel, origin);
            program.push_move(Move::along(&Line { start: at, end: at }.into()), &travel, origin);
            state.coolant = coolant;
            first = false;
        }
        pen.push(&m.curve, origin);
    }
    pen.state.comp = Comp::Off;
}

/// Writes planned moves along an outline under a wear register, with a note of what its values do; `keeps_right`: the material
/// that is kept lies on the right of the travel.
pub(crate) fn write_worn_moves(
    pen: &mut Pen<'_>,
    moves: &[PlannedMove],
    milling: &Milling,
    wear: Option<WearRegister>,
    keeps_right: bool,
) {
    if let Some(wear) = wear {
        let control = pen.setting.post.control;
        if wear.radius > 0.0 {
            pen.text(control.radius_note(milling.tool.number, wear.number));
            pen.text("THE RADIUS AS PLANNED, MORE LEAVES STOCK ON THE WALL");
        } else {
            pen.text(control.wear_note(milling.tool.number, wear.number));
            pen.text("0 AS PLANNED, POSITIVE LEAVES STOCK ON THE WALL");
        }
    }
    let comp = wear.map(|w| if keeps_right { Comp::Left(w.number) } else { Comp::Right(w.number) });
    write_moves(pen, moves, milling.coolant, comp);
}

fn role(m: &PlannedMove) -> Role {
    match m.role {
        holes::ToolpathRole::Rough => Role::Rough,
        holes::ToolpathRole::Circle if m.finishing => Role::Finish,
        holes::ToolpathRole::Circle => Role::Rough,
        holes::ToolpathRole::Finish => Role::Finish,
        holes::ToolpathRole::Entry | holes::ToolpathRole::LeadIn | holes::ToolpathRole::LeadOut => Role::Lead,
        holes::ToolpathRole::Approach | holes::ToolpathRole::Link | holes::ToolpathRole::Retract => {
            Role::Link
        }
    }
}
