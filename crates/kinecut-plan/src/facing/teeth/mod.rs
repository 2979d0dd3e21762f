//! Real teeth: their trochoids, every crossing with the outline, and the bad length they leave.

mod arc;
mod crossing;
mod line;
mod objective;
mod pass;
mod pieces;

pub use crossing::ToothCrossing;
pub use objective::{ToothedLengths, toothed_lengths};
pub use pass::{Tooth, ToothedPass};
