//! Tests of cutting. The reference shares no code with the kernels: it samples poses and measures the distance of
//! points from the tool with formulas of its own.

mod against_poses;
mod at_once;
mod closed_forms;
mod ends_in_foot;
mod from_above;
mod hollow;
mod in_two_ways;
mod late;
mod leaning;
mod owed;
pub(super) mod reference;
mod sieved;
