//! Milling of bores: from the table over the planner's strategies to moves, its wall measured on the simulated stock.

mod plan;
mod table;

pub use plan::PlannedBore;
pub(crate) use plan::spec;
pub use table::*;
