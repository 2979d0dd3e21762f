//! The sheet of an envelope for a terminal.

use std::fmt::Write as _;

use super::tables::{cusps, entering, events, move_lines, second_order, title, volume_note};
use crate::page::{fixed, terminal};
use crate::verbs::envelope::EnvelopeSheet;
use crate::verbs::grazing::show::table_text;

/// The sheet as text.
pub fn envelope_text(sheet: &EnvelopeSheet) -> String {
    let mut out = String::new();
    let mut line = |label: &str, text: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "  {label:<9}{}", terminal(text));
    };
    for (i, text) in move_lines(sheet).iter().enumerate() {
        line(if i == 0 { "move" } else { "" }, text);
    }
    for note in &sheet.notes {
        line("tool", note);
    }
    let (envelope, mesh) = (&sheet.envelope, &sheet.envelope.mesh);
    line(
        "mesh",
        &format!(
            "{} triangles from {} moments, tolerance {} mm; straight ways between the moments leave it by {} mm at most",
            mesh.triangles.len(),
            envelope.moments.len(),
            sheet.tolerance,
            fixed(envelope.pose_error, 6)
        ),
    );
    line("volume", &format!("{} mm3 {}", fixed(mesh.volume(), 3), volume_note(sheet)));
    if let Some(exact) = sheet.exact_volume {
        line("", &format!("{} mm3 in closed form", fixed(exact, 3)));
    }
    line("", &format!("{} mm3 of the tool itself", fixed(sheet.tool_volume, 3)));
    let b = mesh.bounds();
    let side = |k: usize| format!("{} to {}", fixed(b.min[k], 3), fixed(b.max[k], 3));
    line("box", &format!("X {}, Y {}, Z {} mm", side(0), side(1), side(2)));
    for (i, text) in second_order(sheet).iter().enumerate() {
        line(if i == 0 { "walls" } else { "" }, text);
    }
    if envelope.events.is_empty() {
        line("curves", "none is born, joins, parts or ends");
    }
    let mut out = format!("{}\n{out}", terminal(title(sheet)));
    for table in [events(sheet), cusps(sheet), Some(entering(sheet))].into_iter().flatten() {
        out.push('\n');
        out += &table_text(&table);
    }
    out
}
