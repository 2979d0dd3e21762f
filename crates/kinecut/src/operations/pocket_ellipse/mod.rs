//! Milling of elliptic pockets: from the table to moves, its wall measured on the simulated stock.

mod check;
mod plan;
mod spec;
mod table;

pub use check::EllipseOperation;
pub use plan::PlannedEllipse;
pub use table::*;
