//! Volumes swept by a moving tool: the grazing curve of any tool of revolution under any motion, and the envelope of a
//! move.
//!
//! Source: the paper on the grazing curve of a tool of arbitrary shape (NCManager), corrected and closed. Coordinates of the
//! tool: the axis is Z, the origin the point whose velocity a twist states, mostly the tip.

mod chain;
mod cone_chain;
mod discriminant;
mod entered_area;
mod entering;
mod envelope;
mod exact;
mod grazing;
mod motion;
mod normal_velocity;
mod twist;

pub use chain::{ChainPiece, PieceKind, PieceShape, ProfileChain};
pub use cone_chain::{cone_chain, cone_chain_error};
pub use entered_area::EnteredArea;
pub use entering::{Entering, EnteringRegion};
pub use envelope::{Depth, Envelope, EnvelopeEvent, EnvelopePoint, SweptDepth};
pub use exact::{ConvexTool, LowerPiece, LowerProfile, LowerShape, arc_volume, line_volume, tool_volume};
pub use grazing::{Grazing, GrazingLoop, GrazingPoint, GrazingSpan, Motion, SegmentKind};
pub(crate) use motion::chain_acceleration;
pub use motion::{GivenTwist, MotionJet, ScrewMove, TipMove, TipPath, ToolMotion, twist_of_rows};
pub use normal_velocity::{GrazingBranch, NormalVelocity};
pub use twist::twist_of;
