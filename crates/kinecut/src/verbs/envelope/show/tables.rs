//! The numbers of an envelope as tables and words.

use crate::page::{Fact, Row, Table, area_share, fixed};
use crate::verbs::envelope::{EnvelopeSheet, MoveSource};
use crate::verbs::grazing::show::{role_name, vector};

/// Most rows of cusps that are shown; JSON has all.
const CUSPS: usize = 8;

/// The name of a sheet.
pub(crate) fn title(sheet: &EnvelopeSheet) -> &str {
    if sheet.title.is_empty() { "Envelope" } else { &sheet.title }
}

/// The move in words and numbers.
pub(crate) fn move_lines(sheet: &EnvelopeSheet) -> Vec<String> {
    let mut lines = vec![format!("{}; {}", sheet.way, sheet.mode)];
    match &sheet.source {
        MoveSource::Way | MoveSource::Screw => {}
        MoveSource::Joints { from, machine, to } => {
            lines.push(format!("{machine}: from {from} to {to}"));
        }
        MoveSource::Line { block, line, part, of, program } => {
            let which = if *of > 1 { format!(", move {part} of {of}") } else { String::new() };
            lines.push(format!("{program}, line {line}{which}: {block}"));
        }
    }
    let [from, to] = [0.0, 1.0].map(|t| sheet.motion.pose(t));
    let place = |p: glam::DVec3| vector(p.to_array(), 3);
    lines.push(format!("tip from {} to {}", place(from.translation), place(to.translation)));
    let axis = |p: &crate::geom::Rigid| vector(p.rotation.z_axis.to_array(), 4);
    if sheet.turn > 0.0 {
        lines.push(format!("axis from {} to {}", axis(&from), axis(&to)));
    } else {
        lines.push(format!("axis {}", axis(&from)));
    }
    lines.push(format!(
        "way of the tip {} mm, turn of the axis {}\u{b0}",
        fixed(sheet.length, 4),
        fixed(sheet.turn.to_degrees(), 4)
    ));
    lines
}

/// The mesh of the boundary, and the one of the envelope, in sentences.
pub(crate) fn trimmed_lines(sheet: &EnvelopeSheet) -> Vec<String> {
    let trimmed = &sheet.trimmed;
    let deeper = match trimmed.deeper {
        0 => format!("none of {} vertices", trimmed.looked_at),
        n => format!("{n} of {} vertices", trimmed.looked_at),
    };
    let untrimmed = match sheet.cuts_itself() {
        true => "it cuts itself, and its volume counts parts twice or takes them away",
        false => "it does not cut itself, as far as neighbouring moments show",
    };
    vec![
        format!(
            "the boundary is trimmed on lines {} mm apart: what is thinner may be missing; {deeper} looked at are deeper inside than the tolerance, the deepest by {} mm",
            trimmed.step,
            fixed(trimmed.deepest, 4)
        ),
        format!(
            "untrimmed the envelope has {} triangles from {} moments, around {} mm\u{b3}: {untrimmed}",
            sheet.envelope.mesh.triangles.len(),
            sheet.envelope.moments.len(),
            fixed(sheet.envelope.mesh.volume(), 3)
        ),
    ]
}

/// Results on the second order that are certain, in sentences.
pub(crate) fn second_order(sheet: &EnvelopeSheet) -> Vec<String> {
    let [area, inside, hollow] = sheet.wall_areas();
    let mut lines = Vec::new();
    if area > 0.0 {
        lines.push(if inside > 0.0 {
            format!(
                "{} of the walls ({} of {} mm2) lies inside of what the moments beside sweep (F_tt < 0): it bounds nothing",
                area_share(inside / area),
                fixed(inside, 2),
                fixed(area, 2)
            )
        } else {
            format!("all walls ({} mm2) bound what the moments beside sweep (F_tt > 0)", fixed(area, 2))
        });
        if hollow > 0.0 {
            let all = if hollow < inside {
                format!("{} mm2 of it", fixed(hollow, 2))
            } else {
                "all of it".to_owned()
            };
            lines.push(format!("{all} is traced by hollow edges, where stacked parts of the tool meet"));
        }
    }
    if let (Some(first), Some(last)) = (sheet.cusps.first(), sheet.cusps.last()) {
        let mut moments: Vec<f64> = sheet.cusps.iter().map(|c| c.t).collect();
        moments.dedup();
        lines.push(format!(
            "cusps: {} at {} of {} moments, from t {} to t {}",
            sheet.cusps.len(),
            moments.len(),
            sheet.entering.len(),
            fixed(first.t, 4),
            fixed(last.t, 4)
        ));
    } else {
        lines.push("no cusps".to_owned());
    }
    lines
}

/// Table of the moments at which the number of curves changes.
pub(crate) fn events(sheet: &EnvelopeSheet) -> Option<Table> {
    if sheet.envelope.events.is_empty() {
        return None;
    }
    let mut table = Table::new(
        "Curves that are born, join, part or end",
        "from t []; to t []; curves before []; curves after []; what",
    );
    for e in &sheet.envelope.events {
        let what = match (e.before, e.after) {
            (0, _) => "born",
            (_, 0) => "ends",
            (a, b) if a > b => "join",
            (a, b) if a < b => "part",
            _ => "change",
        };
        table.rows.push(Row::new(vec![
            fixed(e.between[0], 5).into(),
            fixed(e.between[1], 5).into(),
            e.before.to_string().into(),
            e.after.to_string().into(),
            what.into(),
        ]));
    }
    table.notes.push("Of the curves that take part; t runs from 0 to 1.".to_owned());
    Some(table)
}

/// The first cusps.
pub(crate) fn cusps(sheet: &EnvelopeSheet) -> Option<Table> {
    if sheet.cusps.is_empty() {
        return None;
    }
    let mut table = Table::new("Cusps of the envelope", "t []; piece; role; x [mm]; y [mm]; z [mm]");
    let step = sheet.cusps.len().div_ceil(CUSPS);
    for c in sheet.cusps.iter().step_by(step) {
        table.rows.push(Row::new(vec![
            fixed(c.t, 4).into(),
            sheet.piece_words(c.piece as usize).into(),
            role_name(c.role).into(),
            fixed(c.point.x, 4).into(),
            fixed(c.point.y, 4).into(),
            fixed(c.point.z, 4).into(),
        ]));
    }
    if step > 1 {
        table.notes.push(format!("Every {step}th of {}; JSON has all.", sheet.cusps.len()));
    }
    Some(table)
}

/// Unit that a rate refers to: a mm of the tip's way, else a degree of turning, else the whole move.
pub(crate) fn rate_unit(sheet: &EnvelopeSheet) -> (f64, &'static str) {
    /// Way below which a move is one on the spot [mm].
    const ON_THE_SPOT: f64 = 1e-6;
    if sheet.length > ON_THE_SPOT {
        (sheet.length, "mm\u{b3} per mm of way")
    } else if sheet.turn > 0.0 {
        (sheet.turn.to_degrees(), "mm\u{b3} per degree")
    } else {
        (1.0, "mm\u{b3} by the move")
    }
}

/// Table of the area and volume that enter at the start, in the middle, at the end.
pub(crate) fn entering(sheet: &EnvelopeSheet) -> Table {
    let (by, unit) = rate_unit(sheet);
    let mut table = Table::new(
        "Entering faces",
        &format!("moment; curves []; area that enters [mm\u{b2}]; volume entered [{unit}]"),
    );
    for (name, e) in ["start", "middle", "end"].into_iter().zip(sheet.main_moments()) {
        table.rows.push(Row::new(vec![
            name.into(),
            e.curves.to_string().into(),
            fixed(e.area, 3).into(),
            fixed(e.rate / by, 4).into(),
        ]));
    }
    table.notes.push(
        "Of the whole surface of the tool with shank and holder, as if all around it were material."
            .to_owned(),
    );
    table
}

/// The main numbers.
pub(crate) fn facts(sheet: &EnvelopeSheet) -> Vec<Fact> {
    let mesh = &sheet.trimmed.mesh;
    let size = mesh.bounds().size();
    let exact = sheet.exact_volume.map_or(String::new(), |v| format!("closed form {} mm\u{b3}", fixed(v, 3)));
    let by_lines = format!("{} mm\u{b3} on the lines", fixed(sheet.trimmed.volume, 3));
    let note = if exact.is_empty() { by_lines } else { exact };
    let [area, inside, _] = sheet.wall_areas();
    let share = if area > 0.0 { inside / area } else { 0.0 };
    vec![
        Fact::new("Way of the tip", format!("{} mm", fixed(sheet.length, 3)))
            .note(format!("axis turns by {}\u{b0}", fixed(sheet.turn.to_degrees(), 3))),
        Fact::new("Volume", format!("{} mm\u{b3}", fixed(mesh.volume(), 3))).note(note),
        Fact::new("Tool's own volume", format!("{} mm\u{b3}", fixed(sheet.tool_volume, 3))),
        Fact::new(
            "Size",
            format!("{} \u{d7} {} \u{d7} {} mm", fixed(size.x, 2), fixed(size.y, 2), fixed(size.z, 2)),
        ),
        Fact::new("Mesh", format!("{} triangles", mesh.triangles.len()))
            .note(format!("tolerance {} mm, lines {} mm apart", sheet.tolerance, sheet.trimmed.step)),
        Fact::new("Locally inside", area_share(share)).note("of the walls: F_tt < 0"),
    ]
}
