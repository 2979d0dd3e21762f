//! Drilling in a job: from an operation to planned holes, and from those to moves and cycles.

mod bodies;
mod holes;
mod moves;
mod prove;
mod sheet;
mod sheet_json;
mod surfaces;

pub use holes::{DrilledHoles, PlannedHole};
pub use prove::ProbedHole;
pub use sheet::{DrillSheet, plan_drill_sheet};

pub(super) use holes::plan_holes;
pub(super) use moves::{Drilling, push_holes};
pub(super) use prove::{ZonesProof, judge, probes, zero_height};
pub(super) use sheet_json::{HoleJson, hole_json};
