//! Thread milling: threads in holes or on bosses by helices of a full-form tool.
//!
//! The helix of the posted text is compared with the wanted thread: radius, pitch, hand, direction, heights, and the pitch
//! diameter by the envelope of the tool's flanks. In the simulated part the tool is the cylinder of its crests, whose wall is
//! measured; the form of the flanks is not.

mod check;
mod core;
mod envelope;
mod json;
mod plan;
mod posted;
mod prove;
mod reach;
mod section;
mod standard;
mod table;
mod wanted;

pub use check::ThreadMillOperation;
pub use plan::PlannedThreadMilling;
pub use table::*;
