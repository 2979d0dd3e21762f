//! Milled walls, round or elliptic: words of their tables, their moves, their section of the report.

mod lead_figures;
mod moves;
mod paper;
mod section;
mod table;
mod wear;

pub use lead_figures::LeadFigure;
pub(crate) use lead_figures::{lead_drawings, lead_figure};
pub(crate) use moves::{CLEARANCE, write_moves, write_told_moves, write_worn_moves};
pub(crate) use section::{ShownWall, sections};
pub use table::*;
pub(crate) use wear::WearKeys;
