//! Tool paths that come from elsewhere, with directions of the tool: points from a file or from the job, and their moves.

mod apt;
mod check;
mod moves;
mod path_point;
mod plan;
mod points;
mod table;
mod turned;

pub use check::PathOperation;
pub use path_point::{PathPoint, PointPace};
pub use plan::PlannedPath;
pub use table::*;
