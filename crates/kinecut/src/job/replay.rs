//! The programs of a job once more, in the order in which they change the stock.

use super::closer::Story;
use crate::operations::measured::Loose;
use crate::stock::cut::CutMove;

/// A part of what happens to the stock.
pub(super) enum Part<'a> {
    /// Moves of a setup, and its index.
    Moves(usize, &'a [CutMove]),
    /// A person takes a core out; its number, counted over all setups.
    Core(&'a Loose, u32),
}

/// All parts in order. Each setup has at least one part with moves, if an empty one.
pub(super) fn parts<'a>(story: &Story<'a>) -> Vec<Part<'a>> {
    let mut parts = Vec::new();
    let mut core_number = 0;
    for (i, list) in story.moves.iter().enumerate() {
        let segments = &story.traces[i].segments;
        let mut done = 0;
        let mut moves = |parts: &mut Vec<Part<'a>>, to: usize| {
            parts.push(Part::Moves(i, &list.moves()[done..to]));
            done = to;
        };
        for core in story.loose.get(i).map_or(&[][..], Vec::as_slice) {
            moves(&mut parts, segments.partition_point(|s| s.item < core.item));
            parts.push(Part::Core(core, core_number));
            core_number += 1;
        }
        moves(&mut parts, segments.len());
    }
    parts
}
