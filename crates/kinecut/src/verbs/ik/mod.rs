//! The verb `kinecut ik`: poses to joint positions; all solutions of each, the best along a path, and a spare axis swept.

mod inverse;
mod path;
mod straight;
mod sweep;

pub(super) use inverse::held;
pub use inverse::{InversePose, InverseSolution, InverseWants, inverse};
pub use path::{PathSheet, PathWants, RetractRow, path};
pub use straight::{StraightStep, StraightWants};
pub use sweep::{
    HeldPlace, MOST_PLACES, Margin, SweepWants, SweptPath, SweptPlace, SweptPose, sweep, sweep_path,
};
