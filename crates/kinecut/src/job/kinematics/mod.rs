//! Poses of machines: joint positions to poses and back, what a machine reaches; as tables of letters and numbers in
//! the units of the shop, for the command line and for callers that speak JSON.

mod forward;
mod inverse;
mod poses;
mod reach;
mod values;

pub use forward::{ForwardPose, forward};
pub use inverse::{InversePose, InverseSolution, InverseWants, inverse};
pub use poses::{PoseTexts, PoseWords};
pub use reach::{AxisReach, DirectionAnswer, ReachSheet, reach};
pub use values::AxisValues;
