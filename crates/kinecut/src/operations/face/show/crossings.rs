//! Every crossing of every tooth with the outline, and the paper's walk through all orientations: long tables for a terminal.

use super::MilledFace;
use super::tables::turn;
use crate::facing::ToothCrossing;
use crate::page::{Cell, Row, Table, fixed};

/// Table of the crossings, a row each; `None` without crossings. Places and edges are those of the outline as given.
pub(super) fn crossings_table(face: &MilledFace<'_>) -> Option<Table> {
    if face.events.is_empty() {
        return None;
    }
    let row = |c: &ToothCrossing| {
        let edge = c.edge as usize;
        let at = face.plan.case.outline.edges().get(edge).map(|e| face.seen_point(e.at(c.share)));
        let place = |v: Option<f64>| v.map_or_else(String::new, |v| fixed(v, 3));
        let cells = [
            c.tooth.to_string(),
            face.seen_edge(edge).to_string(),
            place(at.map(|p| p.x)),
            place(at.map(|p| p.y)),
            if c.exit { "exit" } else { "entry" }.to_owned(),
            if c.front { "front" } else { "back" }.to_owned(),
            if c.exit { fixed(c.exit_angle().to_degrees(), 2) } else { String::new() },
            fixed(c.time.to_degrees(), 2),
        ];
        Row::new(cells.map(Cell::new).to_vec())
    };
    let exits = face.events.iter().filter(|c| c.exit).count();
    let caption =
        format!("Crossings of the teeth: {}, of these {exits} exits; tooth by tooth", face.events.len());
    let columns = "Tooth []; Edge []; X [mm]; Y [mm]; ; Half; Exit angle [deg]; Spindle [deg]";
    Some(Table::new(caption, columns).rows(face.events.iter().map(row)).note(
        "Exit angle: from the edge to the velocity of the tooth. Front: ahead of the cutter's centre, removes stock.",
    ))
}

/// Largest exit angle and bad length over a turn of the part, the cutter over the middle; none where no orientation is
/// known to be covered.
pub(super) fn survey_table(face: &MilledFace<'_>) -> Option<Table> {
    /// Rows of the table over a turn.
    const ROWS: usize = 24;
    if !face.survey.iter().any(|p| p.covered) {
        return None;
    }
    let step = face.survey.len().div_ceil(ROWS).max(1);
    let rows = face.survey.iter().step_by(step).map(|p| {
        let angle = turn(if face.plan.left_hand { -p.placement.angle } else { p.placement.angle });
        let [largest, bad] = match p.covered {
            true => [fixed(p.largest_exit_angle.to_degrees(), 2), fixed(p.bad, 3)],
            false => ["too wide", ""].map(str::to_owned),
        };
        Row::new([fixed(angle, 1), largest, bad].map(Cell::new).to_vec())
    });
    let caption = "Cutter over the middle, at some of the orientations";
    Some(Table::new(caption, "Turn [deg]; Largest exit angle [deg]; Bad length [mm]").rows(rows))
}
