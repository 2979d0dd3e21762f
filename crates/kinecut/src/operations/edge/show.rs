//! Burrs of a face as the report shows them: which are taken off, from where to where, and which are not.

use super::PlannedEdge;
use super::burrs::FoundBurrs;
use crate::facing::burrs::{BurrPart, BurrState};
use crate::page::{Block, Row, Table, fixed};

/// Most rows of burrs that are not treated.
const MOST: usize = 60;

/// The tables and remarks about the burrs of a plan; none where it does not go by them.
pub(super) fn blocks(plan: &PlannedEdge) -> Vec<Block> {
    let Some(found) = &plan.burrs else { return Vec::new() };
    let columns = "Edge; From [mm]; To [mm]; Exit angle [deg]; Height [mm]; Piece";
    let mut treated = Vec::new();
    for (i, cut) in plan.cut_pieces().enumerate() {
        let name = if cut.closed { format!("{}, all round", i + 1) } else { (i + 1).to_string() };
        treated.extend(found.treated(cut).iter().map(|p| row(found, p, name.clone())));
    }
    let whose = found.whose();
    let mut first = Table::new(format!("Burrs of {whose} that are taken off"), columns)
        .rows(treated)
        .note("Edges by label, or by number from 0 as in the outline of the face, loop after loop; places along them.");
    first.notes.push(match plan.of.edges.as_ref().is_some_and(|e| e.table.is_some()) {
        true => {
            "Height expected: your table, interpolated over the exit angle; it is not simulated.".to_owned()
        }
        false => "No height is said: `burr` gives none.".to_owned(),
    });
    first.notes.push(format!("Exit angles as the face has them: {}.", found.face.rule));
    first.notes.push("Of a burr that is cut in part, angles and height are those of all of it.".to_owned());
    let left = plan.left();
    let chosen =
        left.iter().map(|p| (*p, "chosen, but too short, in a corner, or on a loop that is not cut"));
    let others = [
        (BurrState::Other, ["not chosen", "not chosen, but a piece runs over it"]),
        (
            BurrState::Lowered,
            [
                "no exit angle: the cutter was lowered onto it",
                "no exit angle: the cutter was lowered onto it; a piece runs over it",
            ],
        ),
    ];
    let others = others.into_iter().flat_map(|(state, why)| {
        let all = found.others(state, plan.cut_pieces());
        all.into_iter().map(move |(p, run_over)| (p, why[usize::from(run_over)]))
    });
    let all: Vec<(BurrPart, &str)> = chosen.chain(others).collect();
    let mut blocks = vec![first.into()];
    if !all.is_empty() {
        let rows = all.iter().take(MOST).map(|(p, why)| row(found, p, (*why).to_owned()));
        let columns = "Edge; From [mm]; To [mm]; Exit angle [deg]; Height [mm]; Not treated";
        let mut table = Table::new("Edges where teeth have left that are not treated", columns).rows(rows);
        if all.len() > MOST {
            let rest: f64 = all[MOST..].iter().map(|(p, _)| p.length()).sum();
            let more = all.len() - MOST;
            table.notes.push(format!("{more} more are left out, {} mm in all.", fixed(rest, 2)));
        }
        blocks.push(table.into());
    }
    blocks
}

fn row(found: &FoundBurrs, part: &BurrPart, last: String) -> Row {
    let angle = match part.state {
        BurrState::Lowered => String::new(),
        _ => {
            let [a, b] = found.shown_angles(part).map(|psi| fixed(psi.to_degrees(), 1));
            if a == b { a } else { format!("{a} \u{2026} {b}") }
        }
    };
    Row::new(vec![
        found.edge_name(part.edge).into(),
        fixed(part.along[0], 2).into(),
        fixed(part.along[1], 2).into(),
        angle.into(),
        part.height.map_or_else(String::new, |h| fixed(h, 3)).into(),
        last.into(),
    ])
}
