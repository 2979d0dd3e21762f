//! What a moving tool sweeps: the grazing curve of any tool of revolution under any motion, and the envelope of a move.
//!
//! Source: the paper on the grazing curve of a tool of arbitrary shape (NCManager), corrected and closed. Coordinates of the
//! tool: the axis is Z, the origin the point whose velocity a twist states, mostly the tip.

mod chain;
mod motion;

pub use chain::{ChainPiece, PieceKind, PieceShape, ProfileChain};
pub use motion::{MotionJet, ToolMotion};
