//! Poses of machines: joint positions to poses and back, what a machine reaches; as tables of letters and numbers in
//! the units of the shop, for the command line and for callers that speak JSON.

mod forward;
mod inverse;
mod path;
mod poses;
mod reach;
mod straight;
mod sweep;
mod values;

pub use forward::{ForwardPose, forward};
pub use inverse::{InversePose, InverseSolution, InverseWants, inverse};
pub use path::{PathSheet, PathWants, RetractRow, path};
pub use poses::{PoseTexts, PoseWords};
pub use reach::{AxisReach, DirectionAnswer, ReachSheet, reach};
pub use straight::{StraightStep, StraightWants};
pub use sweep::{
    HeldPlace, MOST_PLACES, Margin, SweepWants, SweptPath, SweptPlace, SweptPose, sweep, sweep_path,
};
pub use values::AxisValues;
