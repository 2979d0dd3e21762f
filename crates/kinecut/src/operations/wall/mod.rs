//! Milled walls, round or elliptic: words of their tables, their moves, their section of the report.

mod moves;
mod paper;
mod section;
mod spec;
mod table;

pub(crate) use moves::write_moves;
pub(crate) use section::{ShownWall, sections};
pub(crate) use spec::{CLEARANCE, cutter};
pub use table::*;
