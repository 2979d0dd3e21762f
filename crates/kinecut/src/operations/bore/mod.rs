//! Milling of bores: from the table over the planner's strategies to moves, its wall measured on the simulated stock.

mod check;
mod plan;
mod spec;
mod table;

pub use check::BoreOperation;
pub use plan::PlannedBore;
pub(crate) use spec::spec;
pub use table::*;
