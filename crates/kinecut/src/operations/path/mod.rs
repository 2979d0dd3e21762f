//! Tool paths that come from elsewhere, with directions of the tool: points from a file or from the job, and their moves.

mod apt;
mod check;
mod moves;
mod plan;
mod points;
mod table;
mod turned;

pub use check::PathOperation;
pub use plan::PlannedPath;
pub use points::{PathPoint, PointPace};
pub use table::*;
