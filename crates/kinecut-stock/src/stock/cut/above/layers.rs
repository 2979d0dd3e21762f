//! Heights of the lines across the tool axis.

use super::super::axis::ToolFrame;
use super::patch::ROUNDING;
use crate::stock::Lattice;
use crate::stock::tri_dexel::LINE_OFFSET;

/// The layers of lines across the tool axis, counted upwards in the tool frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layers {
    /// Height of the lowest in the tool frame [mm].
    lowest: f64,
    step: f64,
    /// Layers for each mm.
    dense: f64,
    count: usize,
    reversed: bool,
}

impl Layers {
    pub(super) fn new(lattice: &Lattice, frame: &ToolFrame) -> Layers {
        let axis = frame.axes[2];
        let count = lattice.counts[axis.index()];
        let reversed = frame.sign < 0.0;
        let lowest = if reversed { count - 1 } else { 0 };
        Layers {
            lowest: frame.sign * (lattice.coordinate(axis, lowest) + LINE_OFFSET),
            step: lattice.step,
            dense: 1.0 / lattice.step,
            count: count as usize,
            reversed,
        }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Number of layers below a height.
    fn below(&self, height: f64) -> usize {
        let layers = ((height - self.lowest) / self.step).clamp(0.0, self.count as f64);
        // Upwards by a cast: `ceil` is a call of the C library.
        let whole = layers as usize;
        whole + usize::from(layers > whole as f64)
    }

    /// False only if no layer lies between two heights; without branches.
    #[inline(always)]
    pub(super) fn may_be_between(&self, low: f64, high: f64) -> bool {
        /// Added and taken off again it leaves a whole number.
        const WHOLE: f64 = 6_755_399_441_055_744.0;
        /// Rounding of the quotients, far more than there is.
        const NEAR: f64 = 1e-6;
        let below = |height: f64, near: f64| {
            let layers = (height - self.lowest) * self.dense + near;
            let whole = (layers + WHOLE) - WHOLE;
            whole + if whole < layers { 1.0 } else { 0.0 }
        };
        below(low, -NEAR) < below(high, NEAR)
    }

    /// The layers that lie between a height that a part may come down to and a ceiling; in the order of the stock.
    pub(super) fn between(&self, low: f64, ceiling: f64) -> (u32, u32) {
        let (from, to) = (self.below(low - ROUNDING), self.below(ceiling + 2.0 * ROUNDING));
        let (from, to) =
            if self.reversed { (self.count - to.max(from), self.count - from) } else { (from, to) };
        (from as u32, to as u32)
    }

    /// The lowest layer above a ceiling.
    pub(super) fn above(&self, ceiling: f64) -> usize {
        self.below(ceiling + ROUNDING)
    }

    /// Index in the stock of a layer counted upwards.
    pub(super) fn in_stock(&self, layer: usize) -> usize {
        if self.reversed { self.count - 1 - layer } else { layer }
    }
}
