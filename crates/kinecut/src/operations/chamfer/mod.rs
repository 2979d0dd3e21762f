//! Chamfers along the edges of an outline: from the table over depth and offset of a V cutter to moves, measured on the simulated
//! stock.

mod check;
mod json;
mod plan;
mod section;
mod table;
mod webs;

pub use check::ChamferOperation;
pub use plan::PlannedChamfer;
pub use table::*;
