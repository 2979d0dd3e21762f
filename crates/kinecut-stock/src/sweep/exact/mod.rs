//! Closed sweeps of moves in which the tool does not turn: heights of what is left over a point, the stretch of a line that is
//! removed, volumes. Coordinates of the tool: its axis is Z.

mod chord;
mod height;
mod lower;
mod volume;

pub use chord::ConvexTool;
pub use lower::{LowerPiece, LowerProfile, LowerShape};
pub use volume::{arc_volume, line_volume, tool_volume};
