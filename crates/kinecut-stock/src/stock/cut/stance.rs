//! The way a tool stands on a move.

use std::sync::Arc;

use super::CutAxis;
use crate::sweep::ToolMotion;

/// The direction of a tool along one move.
#[derive(Clone, Debug, PartialEq)]
pub enum Stance {
    /// Along an axis of the stock, the whole move: the tip keeps to the move's curve.
    Along(CutAxis),
    /// Any other direction, kept or turning: the tip and the axis go as the motion has them [coordinates of the stock].
    Leaning(Arc<ToolMotion>),
}

impl Stance {
    /// The axis of the stock along which the tool stands; `None` where it leans or turns.
    pub fn axis(&self) -> Option<CutAxis> {
        match self {
            Stance::Along(axis) => Some(*axis),
            Stance::Leaning(_) => None,
        }
    }
}
