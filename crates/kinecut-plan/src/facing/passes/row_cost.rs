//! Cost of a row: the bad length of one straight pass over the strip that earlier rows left.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use crate::facing::{FaceCase, Placement, Sweep, bad_stretches};
use crate::geom::OutlineEdge;

/// Heights per size of the part that are the same: an edge along the feed at the border of a strip.
const ZERO: f64 = 1e-12;

/// A piece of bad edge that rises or falls throughout, by height in the turned frame.
struct Rising {
    low: f64,
    high: f64,
    /// Weighted length [mm].
    length: f64,
    /// Height of the centre and radius, for a piece of an arc.
    round: Option<(f64, f64)>,
}

impl Rising {
    /// Weighted length above a height [mm].
    fn above(&self, height: f64) -> f64 {
        if height <= self.low {
            return self.length;
        }
        if height >= self.high {
            return 0.0;
        }
        let share = match self.round {
            None => (self.high - height) / (self.high - self.low),
            Some((centre, radius)) => {
                let angle = |y: f64| ((y - centre) / radius).clamp(-1.0, 1.0).asin();
                (angle(self.high) - angle(height)) / (angle(self.high) - angle(self.low))
            }
        };
        self.length * share
    }
}

/// The face seen by rows of one orientation.
pub(super) struct RowCost<'a> {
    case: &'a FaceCase,
    angle: f64,
    near: f64,
    /// Least and greatest height of the outline [mm].
    pub(super) heights: [f64; 2],
    /// The case's edges in the turned frame.
    turned: Vec<OutlineEdge>,
}

impl<'a> RowCost<'a> {
    pub(super) fn new(case: &'a FaceCase, angle: f64) -> RowCost<'a> {
        let turned: Vec<OutlineEdge> =
            case.outline.edges().iter().map(|e| e.moved(angle, DVec2::ZERO)).collect();
        let heights = case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        let near = ZERO * (case.radius + heights[0].abs() + heights[1].abs());
        RowCost { case, angle, near, heights, turned }
    }

    /// Number of edges of the face; one at least.
    pub(super) fn edges(&self) -> usize {
        self.turned.len().max(1)
    }

    /// The bad length of a row at `offset`, fed towards +x of the turned frame or back, over what lies above `top`.
    pub(super) fn of(&self, top: f64, offset: f64, forward: bool) -> f64 {
        let mut sum = 0.0;
        self.pieces(offset, forward, |piece| sum += self.owned(&piece, top));
        sum
    }

    /// The same for each of many tops, ascending.
    pub(super) fn of_tops(&self, tops: &[f64], offset: f64, forward: bool, costs: &mut [f64]) {
        costs.fill(0.0);
        // Lengths that every top up to an index has whole: added there, summed from the end.
        self.pieces(offset, forward, |piece| {
            let whole = tops.partition_point(|&t| t <= piece.low.min(piece.high - self.near));
            if whole > 0 {
                costs[whole - 1] += piece.length;
            }
        });
        for i in (1..tops.len()).rev() {
            costs[i - 1] += costs[i];
        }
        self.pieces(offset, forward, |piece| {
            let first = tops.partition_point(|&t| t <= piece.low.min(piece.high - self.near));
            for (top, cost) in tops.iter().zip(costs.iter_mut()).skip(first) {
                let owned = self.owned(&piece, *top);
                if !(owned > 0.0) {
                    break;
                }
                *cost += owned;
            }
        });
    }

    fn owned(&self, piece: &Rising, top: f64) -> f64 {
        if piece.high - piece.low <= self.near {
            // An edge along the border is not covered by the row below it.
            return if piece.high > top - self.near { piece.length } else { 0.0 };
        }
        piece.above(top)
    }

    fn pieces(&self, offset: f64, forward: bool, mut found: impl FnMut(Rising)) {
        let placement = if forward {
            Placement { angle: self.angle, offset }
        } else {
            Placement { angle: self.angle + PI, offset: -offset }
        };
        let edges = self.case.outline.edges().iter().zip(&self.turned).zip(&self.case.weights);
        for ((edge, turned), &edge_weight) in edges.filter(|(_, w)| **w > 0.0) {
            let per_share = edge.length() * edge_weight;
            bad_stretches(edge, self.case, placement, Sweep::Front, 0.0, |bad| {
                let length = |from: f64, to: f64| (to - from) * per_share * bad.weight;
                let mut piece = |from: f64, to: f64, round| {
                    let (a, b) = (turned.at(from).y, turned.at(to).y);
                    let (low, high) = if a < b { (a, b) } else { (b, a) };
                    found(Rising { low, high, length: length(from, to), round });
                };
                let Some(turn) = turned.turn else {
                    piece(bad.from, bad.to, None);
                    return;
                };
                let round = Some((turn.centre.y, turn.radius));
                let mut from = bad.from;
                for k in peaks(&turn.from, turn.sweep) {
                    if from < k && k < bad.to {
                        piece(from, k, round);
                        from = k;
                    }
                }
                piece(from, bad.to, round);
            });
        }
    }

    /// Offsets at which the cost of a row at `offset` may bend or jump, and how far above `offset` the top of the row
    /// below may bend it: calls `offset_at` with the former, `above_top` with the latter.
    pub(super) fn bends(&self, mut offset_at: impl FnMut(f64), mut above_top: impl FnMut(f64)) {
        let radius = self.case.radius;
        for (edge, &weight) in self.turned.iter().zip(&self.case.weights) {
            if !(weight > 0.0) {
                continue;
            }
            let [low, high] = edge.extent(DVec2::Y);
            let ends = [edge.start.y, edge.end.y, low, high];
            let count = if edge.turn.is_some() { 4 } else { 2 };
            for &y in &ends[..count] {
                offset_at(y - radius);
                offset_at(y + radius);
            }
            for psi in self.case.bad.parts().iter().flat_map(|p| [p.from, p.to]) {
                if edge.turn.is_none() {
                    let level = radius * (edge.outward(0.0) + psi).sin();
                    ends[..2].iter().for_each(|y| offset_at(y - level));
                    above_top(level);
                } else {
                    for (s, y) in [(0.0, edge.start.y), (1.0, edge.end.y)] {
                        offset_at(y - radius * (edge.outward(s) + psi).sin());
                    }
                }
            }
        }
    }

    /// Least and greatest abscissa, in the turned frame, of what a row at `offset` reaches; none if that is nothing.
    pub(super) fn extent(&self, offset: f64) -> Option<[f64; 2]> {
        use super::meet::{Whole, meet};
        let (low, high) = (offset - self.case.radius, offset + self.case.radius);
        let mut extent: Option<[f64; 2]> = None;
        let mut shares = Vec::new();
        for edge in &self.turned {
            shares.clear();
            shares.extend([0.0, 1.0]);
            for y in [low, high] {
                meet(edge, Whole::Line { point: DVec2::new(0.0, y), along: DVec2::X }, &mut shares);
            }
            if let Some(t) = edge.turn {
                meet(edge, Whole::Line { point: t.centre, along: DVec2::X }, &mut shares);
            }
            for p in shares.iter().map(|&s| edge.at(s)) {
                if p.y < low - self.near || p.y > high + self.near {
                    continue;
                }
                let [least, most] = extent.unwrap_or([p.x, p.x]);
                extent = Some([least.min(p.x), most.max(p.x)]);
            }
        }
        extent
    }
}

/// Shares at which an arc is highest or lowest, ascending.
fn peaks(from: &f64, sweep: f64) -> impl Iterator<Item = f64> {
    let first = if sweep > 0.0 { FRAC_PI_2 - from } else { from - FRAC_PI_2 }.rem_euclid(PI);
    let span = sweep.abs();
    [first, first + PI, first + TAU].into_iter().filter(move |g| *g < span).map(move |g| g / span)
}
