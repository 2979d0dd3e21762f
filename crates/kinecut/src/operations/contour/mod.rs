//! Milling along a contour: from the table over tracks, leads, ramps and tabs to moves, its wall measured on the simulated stock.

mod check;
mod finish;
mod json;
mod line;
mod plan;
mod section;
mod table;

pub use check::ContourOperation;
pub use plan::PlannedContour;
pub use table::*;
