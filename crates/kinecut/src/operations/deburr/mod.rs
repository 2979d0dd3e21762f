//! Deburring: a small break of exactly those edges on which the face milling before has left a burr, or of an outline.

mod check;
mod plan;
mod table;

pub use check::DeburrOperation;
pub use plan::PlannedDeburr;
pub use table::*;
