//! Side faces of a box that moves have come to.
//!
//! Between a face and the line next to it lies half a step that no line along Z sees. It is as it was in the raw stock where no move
//! has come, and it is not known between the lowest and the highest place of all moves that have.

use super::Lattice;
use crate::geom::Aabb;

/// Moves between a face and the lines next to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strip {
    /// Their lowest and their highest place [mm].
    heights: [f64; 2],
    /// Their least and their greatest place along the face [mm].
    along: [f64; 2],
}

/// The strips at the faces of a stock: at its least and its greatest X, then Y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Skimmed([[Strip; 2]; 2]);

impl Strip {
    /// No move has come to it.
    const WHOLE: Strip = Strip { heights: NOWHERE, along: NOWHERE };
    /// Nothing is known of it.
    const UNKNOWN: Strip = Strip { heights: EVERYWHERE, along: EVERYWHERE };

    /// The heights between which it is not known beside lines that stand from one place along the face to another [mm].
    pub(super) fn unknown(&self, (from, to): (f64, f64)) -> [f64; 2] {
        if self.along[0] <= to && from <= self.along[1] { self.heights } else { NOWHERE }
    }
}

const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// The hull of two ranges.
fn hull(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

impl Skimmed {
    /// A box that no move has come to.
    pub(super) const WHOLE: Skimmed = Skimmed([[Strip::WHOLE; 2]; 2]);
    /// A body of which nothing is known beside its lines.
    pub(super) const UNKNOWN: Skimmed = Skimmed([[Strip::UNKNOWN; 2]; 2]);

    /// Notes a move that stays within a box.
    pub(super) fn note(&mut self, lattice: &Lattice, stock: Aabb, swept: Aabb) {
        for (k, strips) in self.0.iter_mut().enumerate() {
            let last = lattice.origin[k] + f64::from(lattice.counts[k] - 1) * lattice.step;
            let between = [(stock.min[k], lattice.origin[k]), (last, stock.max[k])];
            for (strip, (low, high)) in strips.iter_mut().zip(between) {
                let mut part = stock;
                (part.min[k], part.max[k]) = (low, high);
                if part.meets(swept) {
                    strip.heights = hull(strip.heights, [swept.min.z, swept.max.z]);
                    strip.along = hull(strip.along, [swept.min[1 - k], swept.max[1 - k]]);
                }
            }
        }
    }

    /// Knowledge after the moves of both.
    pub(super) fn with(self, other: Skimmed) -> Skimmed {
        let strip = |k: usize, side: usize| {
            let (a, b) = (self.0[k][side], other.0[k][side]);
            Strip { heights: hull(a.heights, b.heights), along: hull(a.along, b.along) }
        };
        Skimmed([0, 1].map(|k| [0, 1].map(|side| strip(k, side))))
    }

    /// Most volume by which ledges in the strips may be off [mm^3]: narrower than the lines are apart, they end anywhere between two
    /// lines.
    pub(super) fn ledges(&self, lattice: &Lattice, stock: Aabb) -> f64 {
        let within =
            |[low, high]: [f64; 2], k: usize| (high.min(stock.max[k]) - low.max(stock.min[k])).max(0.0);
        let strips =
            self.0.iter().enumerate().flat_map(|(k, strips)| strips.iter().map(move |strip| (k, strip)));
        // A ledge below, one above, and one at either end; half a step wide, known to half a step.
        let border =
            |(k, strip): (usize, &Strip)| 2.0 * (within(strip.along, 1 - k) + within(strip.heights, 2));
        0.25 * lattice.step * lattice.step * strips.map(border).sum::<f64>()
    }

    /// The strips at the least and the greatest X, or Y.
    pub(super) fn strips(&self, k: usize) -> &[Strip; 2] {
        &self.0[k]
    }
}
