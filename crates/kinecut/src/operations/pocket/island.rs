//! Islands in a pocket that is an edge of a mesh.

use super::PocketTable;
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::Outline;
use crate::operations::outlines::outline_keys;
use crate::page::trimmed;

/// Height over the floor at which islands are looked for [mm]: lower ones are uneven places of a floor.
const ABOVE: f64 = 0.05;

/// Checks that nothing of a mesh is higher than the floor within a pocket that is one of its edges: an edge has no islands.
///
/// # Errors
/// `KC0102` with the key `edge_at` and the place of an island.
pub(super) fn has_no_island(t: &PocketTable, outline: &Outline, loader: &dyn Loader) -> Result<()> {
    if t.edge_at.is_none() {
        return Ok(());
    }
    let height = t.top - t.depth + ABOVE;
    let cut = PocketTable { edge_at: None, section: Some(height), ..t.clone() };
    // Without a section there the floor lies below the mesh, or below the floor that it has.
    let Ok(enclosed) = outline_keys!(cut).of_pocket().read(loader) else { return Ok(()) };
    let start = |edges: &std::ops::Range<usize>| enclosed.outline.edges()[edges.start].start;
    let islands = enclosed.outline.loops().iter().filter(|l| !l.outer).map(|l| start(&l.edges));
    let Some(place) = islands.into_iter().find(|p| outline.contains(*p)) else { return Ok(()) };
    let shown = [place.x, place.y].map(|v| trimmed(v, 3)).join(", ");
    let what =
        format!("part of the mesh is higher than the floor within the edge at `edge_at`, at [{shown}]");
    let help =
        format!("an edge has no islands: write section = {} in place of `edge_at`", trimmed(height, 3));
    let finding = Finding::error(Code::JOB_SHAPE, what).point([place.x, place.y, height]);
    Err(finding.help(help).key("edge_at").into())
}
