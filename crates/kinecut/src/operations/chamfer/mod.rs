//! Chamfers along the edges of an outline: from the table over depth and offset of a V cutter to moves, measured on the simulated
//! stock.

mod check;
mod plan;
mod table;

pub use check::ChamferOperation;
pub use plan::PlannedChamfer;
pub use table::*;
