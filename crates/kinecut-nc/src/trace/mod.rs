//! The trace: a program on a machine, as the tool really moves.
//!
//! Motion and stock read only this: cycles are expanded, frames and cutter compensation applied, and each segment's pose and axis
//! positions are exact functions of arc length with three derivatives.

mod axis_path;
mod chain;
mod comp;
mod follow;
mod follow_rapids;
mod joint_way;
mod passing;
mod rapids;
mod register_state;
mod rotary;
mod segment;
mod stand;
mod straight;
mod travel;
mod turning;

pub use axis_path::AxisPath;
pub use chain::{axis_frame, axis_positions, rotary_positions};
pub use comp::CompStart;
pub use follow::{TraceOptions, trace};
pub use joint_way::{AxisRates, JointWay};
pub use passing::{Taker, trace_passing};
pub use register_state::RegisterState;
pub use segment::{AxisJet, Pose, Segment, SegmentPace, Trace, Untraced};
pub use stand::{Stand, StandKind};
pub use travel::travel_findings;
pub use turning::{AxisTurning, Carried};
