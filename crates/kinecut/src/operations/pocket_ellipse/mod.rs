//! Milling of elliptic pockets: from the table to moves, its wall measured on the simulated stock.

mod plan;
mod table;

pub use plan::PlannedEllipse;
pub use table::*;
