//! Cutting data of operations that have none of their own: of the preset of their tool for the material of the job, else of
//! the shop's table, else values to start with. Each number carries its origin.

mod json;
mod limit;
mod note;
mod preset;
mod shop_table;
mod start;
mod take;
mod taken;

pub(in crate::job) use json::{CuttingJson, cutting_json};
pub(in crate::job) use limit::within_limit;
pub(in crate::job) use note::notes;
pub(in crate::job) use shop_table::ShopTable;
pub(in crate::job) use take::take_data;
pub use taken::{DataOrigin, SpeedLimit, TakenData, TakenNumber};
