//! Planner of contours: the cutter runs along the edges of a face, outside, inside or on them.
//!
//! The path of its centre is the exact offset of the outline ([`crate::geom::offset`]); it comes down along a ramp or
//! straight, level after level, leaves tabs where the part is to be held, finishes what roughing has left, and joins and
//! leaves the path on tangent arcs for which room is looked for. It may run along pieces of the loops only, each with a lead at both
//! ends.
//!
//! Open lines have a path on their left or right, with a lead at each end.
//!
//! # Signs
//! *Climb* with a clockwise spindle: the material that is kept lies on the right of the travel, so that the path runs
//! clockwise around a part and counter-clockwise inside one. Feeds are those of the cutter's centre; where the feed at the
//! wall is meant, that at each arc is `F (R - a) / R` inside and `F (R + a) / R` outside of a wall of radius `R`. Where it is asked
//! for, a finish is slower in inside corners, so that its chip is not thicker there than along a straight wall.

mod ball;
mod chamfer;
mod check;
mod corner_feed;
mod corners;
mod covered;
mod edge_break;
mod feed;
mod lead;
mod line;
mod onto_wall;
mod pieces;
mod plan;
mod room;
mod rough;
mod spec;
mod stretches;
mod tabs;
mod track;
mod travel;
mod wear;

pub use ball::BallBreak;
pub use chamfer::Chamfer;
pub use corner_feed::SlowedFeed;
pub use corners::UncutCorner;
pub use edge_break::EdgeBreak;
pub use feed::centre_feed;
pub use pieces::{CutPiece, OutlinePiece};
pub use plan::{ContourPlan, PlannedLoop, plan_contour};
pub use spec::{ContourFinish, ContourLoops, ContourSide, ContourSpec, TabShape, Tabs};
pub use stretches::{LoopStretches, SplitStretch};
pub use tabs::PlacedTab;
