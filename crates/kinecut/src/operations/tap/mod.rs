//! Tapping: threads cut or formed in core holes that are there, each by the control's own rigid tapping.
//!
//! The feed is pitch times speed, so the table gives the speed only. A core hole is one that the raw stock has, one that an
//! operation before leaves, or one that the table states; its diameter and depth are checked before anything is planned, and
//! in the simulated stock it is measured down to the lowest point of the tap. The thread itself is not simulated.

mod check;
mod core;
mod json;
mod plan;
mod prove;
mod section;
mod table;

pub use check::TapOperation;
pub use plan::{PlannedTapping, PlannedThread};
pub use table::*;

pub use crate::operations::core_hole::{Core, CoreTable};
