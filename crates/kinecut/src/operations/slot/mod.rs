//! Milling of a slot: a line or an arc of a width. Loops of a trochoid where there is room beside the cutter, else passes as wide as
//! the cutter; wall and floor are measured as those of a pocket.

mod check;
mod plan;
mod table;

pub use check::SlotOperation;
pub use plan::PlannedSlot;
pub use table::*;
