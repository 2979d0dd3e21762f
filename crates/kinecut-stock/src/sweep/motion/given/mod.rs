//! Motions of a tool as written in files: lengths in mm, angles in degrees, checked where they are made.

mod number;
mod pose;
mod screw;
mod tip_move;
mod tip_path;
mod twist;

pub use pose::twist_of_rows;
pub use screw::ScrewMove;
pub use tip_move::TipMove;
pub use tip_path::TipPath;
pub use twist::GivenTwist;
