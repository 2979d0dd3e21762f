//! Every crossing of every tooth with the outline, a line each.

use super::MilledFace;
use crate::facing::Crossing;
use crate::page::fixed;

/// Head of the list, and a line for each crossing; nothing where there are none. Places and edges are those of the
/// outline as given, angles in degrees, lengths in mm.
pub(super) fn crossing_lines(face: &MilledFace<'_>) -> Vec<String> {
    if face.events.is_empty() {
        return Vec::new();
    }
    let exits = face.events.iter().filter(|c| c.exit).count();
    let counted =
        format!("crossings of the teeth: {}, of these {exits} exits; tooth by tooth", face.events.len());
    let head = row(["tooth", "edge", "X", "Y", "", "half", "exit deg", "spindle deg"].map(str::to_owned));
    let mut lines = vec![String::new(), counted, head];
    lines.extend(face.events.iter().map(|c| line(face, c)));
    lines.push(
        "exit deg: from the edge to the velocity of the tooth; front: ahead of the cutter's centre, removes stock"
            .to_owned(),
    );
    lines
}

fn line(face: &MilledFace<'_>, c: &Crossing) -> String {
    let edge = c.edge as usize;
    let at = face.plan.case.outline.edges().get(edge).map(|e| face.seen_point(e.at(c.share)));
    let place = |v: Option<f64>| v.map_or_else(String::new, |v| fixed(v, 3));
    row([
        c.tooth.to_string(),
        face.seen_edge(edge).to_string(),
        place(at.map(|p| p.x)),
        place(at.map(|p| p.y)),
        if c.exit { "exit" } else { "entry" }.to_owned(),
        if c.front { "front" } else { "back" }.to_owned(),
        if c.exit { fixed(c.exit_angle().to_degrees(), 2) } else { String::new() },
        fixed(c.time.to_degrees(), 2),
    ])
}

fn row([tooth, edge, x, y, kind, half, angle, turned]: [String; 8]) -> String {
    format!("{tooth:>5}{edge:>6}{x:>12}{y:>12}  {kind:<6}{half:<6}{angle:>9}{turned:>14}")
}
