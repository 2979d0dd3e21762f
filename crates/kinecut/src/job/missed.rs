//! Overlaps of tool and material that lie between the lines of the stock.

use std::f64::consts::SQRT_2;

use crate::stock::cut::{Edge, MoveEffect};

/// The overlaps of a tool at rapid or with a standing spindle, of a shank or of a holder with material that can lie
/// between the lines of the stock model and be missed.
///
/// Walls and floors are met however little a body reaches into them. Between the lines lies only what is lower than a step
/// **and** narrower than the diagonal of four lines: where a tool clips an edge. Edges that may be clipped are found by
/// themselves ([`MoveEffect::edge`]) and are doubts from [`Missed::UNTOLD`] on; a spike of material thinner than a step in
/// both directions across the tool is not seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Missed {
    /// The distance of the lines [mm].
    pub step: f64,
    /// Widest overlap at an edge of the stock that can be missed without a doubt [mm].
    pub width: f64,
}

impl Missed {
    /// Wider overlaps than this are found, or doubts [mm].
    pub const UNTOLD: f64 = 0.05;

    /// Between lines at a distance of `step` [mm].
    pub(super) fn between(step: f64) -> Missed {
        Missed { step, width: Missed::UNTOLD.min(SQRT_2 * step) }
    }
}

/// The edge that what should meet nothing may clip between the lines, by more than is left untold.
pub(super) fn may_clip(effect: &MoveEffect) -> Option<Edge> {
    effect.edge().filter(|edge| edge.width > Missed::UNTOLD)
}
