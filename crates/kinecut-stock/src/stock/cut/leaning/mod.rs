//! Moves of a tool that leans or turns: on all three grids alike, line by line.
//!
//! A move becomes spans (`span.rs`); a convex part of the tool covers a stretch of a line over a span (`swept.rs`), found from
//! chords at single poses (`chord.rs`). A tile of lines takes all spans in order (`tiles.rs`); long runs of moves of which only the
//! outcome counts are cut at once (`at_once`). What may lie between the lines is noted (`edge.rs`). An edge that leaves a core is
//! cut as it is on a move along its axis (`hollow.rs`), else as filled.

mod at_once;
mod chord;
mod edge;
mod furthest;
#[cfg(test)]
mod golden;
mod hollow;
mod look;
mod nearest;
mod rest;
mod run;
mod span;
mod swept;
mod task;
mod tiles;

pub(in crate::stock) use at_once::OwedAcross;
pub(in crate::stock) use rest::{may_meet_at_rest, meets_at_rest};
pub(super) use run::{cut_leaning, cut_leaning_one_by_one};
pub(super) use span::{Pose, PoseSpan, spans};
