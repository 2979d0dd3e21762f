//! One hole at a time: a bore operation with its tool, planned alone or compared over all strategies.
//!
//! Input is a table, or a list of tables, in TOML (`[[hole]]`) or JSON; the operation is the same table as in a job. A
//! list gives a list, and an item that fails carries its own error.

mod compare;
mod compare_page;
mod comparison;
mod job;
mod page;
mod passes;
mod plan;
mod table;

pub use comparison::{HoleComparison, compare_hole};
pub(super) use job::{job_file, own_key};
pub use passes::HoleCurve;
pub use plan::{HoleEntry, HoleLimits, HolePass, HolePlan, HoleSamples, plan_hole, plan_hole_sheet};
pub use table::{HoleTable, PartTable, hole_schema, read_holes};
