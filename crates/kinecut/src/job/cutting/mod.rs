//! Cutting data of operations that have none of their own: of the preset of their tool for the material of the job, else values to
//! start with. Each number carries its origin.

mod limit;
mod note;
mod preset;
mod start;
mod take;
mod taken;

pub(in crate::job) use limit::within_limit;
pub(in crate::job) use note::notes;
pub(in crate::job) use take::take_data;
pub use taken::{DataOrigin, SpeedLimit, TakenData, TakenNumber};
