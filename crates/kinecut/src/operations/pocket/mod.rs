//! Milling of a pocket: from the table over passes of bounded engagement and a lap along the wall to moves, its wall and floor
//! measured on the simulated part.

mod check;
mod json;
mod plan;
mod section;
mod table;

pub use check::PocketOperation;
pub use plan::PlannedPocket;
pub use table::*;
