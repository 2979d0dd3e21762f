//! Milling of a pocket: from the table over passes of bounded engagement and a lap along the wall to moves, its wall and floor
//! measured on the simulated part.

mod check;
mod island;
mod json;
mod plan;
mod rest;
mod section;
mod table;

pub use check::{CentredSlot, PocketOperation};
pub(crate) use check::{USUAL_ENGAGEMENT, checked};
pub(crate) use json::PocketJson;
pub use plan::PlannedPocket;
pub(crate) use plan::planned;
pub(crate) use section::section;
pub use table::*;
