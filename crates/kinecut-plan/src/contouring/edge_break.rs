//! The break of an edge by either kind of cutter.

use super::{BallBreak, Chamfer};

/// The break of an edge along a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeBreak {
    /// Straight, by a V cutter.
    Chamfer(Chamfer),
    /// Hollow, by a ball.
    Ball(BallBreak),
}

impl EdgeBreak {
    /// Width, in the plane of the edge [mm].
    pub fn width(&self) -> f64 {
        match self {
            EdgeBreak::Chamfer(c) => c.width,
            EdgeBreak::Ball(b) => b.width,
        }
    }

    /// Height [mm].
    pub fn leg(&self) -> f64 {
        match self {
            EdgeBreak::Chamfer(c) => c.leg(),
            EdgeBreak::Ball(b) => b.width,
        }
    }

    /// Depth of the tip below the edge [mm].
    pub fn depth(&self) -> f64 {
        match self {
            EdgeBreak::Chamfer(c) => c.depth(),
            EdgeBreak::Ball(b) => b.depth(),
        }
    }

    /// Distance of the cutter's axis from the wall [mm].
    pub fn offset(&self) -> f64 {
        match self {
            EdgeBreak::Chamfer(c) => c.offset(),
            EdgeBreak::Ball(b) => b.offset(),
        }
    }

    /// Radius of the cutter at the height of the edge, the largest that cuts [mm].
    pub fn top_radius(&self) -> f64 {
        match self {
            EdgeBreak::Chamfer(c) => c.top_radius(),
            EdgeBreak::Ball(b) => b.top_radius(),
        }
    }
}
