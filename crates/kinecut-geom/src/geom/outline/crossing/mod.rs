//! Check that an outline neither crosses nor touches itself.
//!
//! Sort and sweep: the edges' extents along one direction are sorted, and an edge meets those before it that have not
//! ended yet; pairs whose extents across overlap too are tested exactly ([`contact`]). The direction is the one of eight
//! in which the edges are shortest in sum, so that combs of long parallel edges at any angle stay cheap.

use std::f64::consts::PI;

use glam::DVec2;

use super::contact::{Shared, contact};
use super::{OutlineEdge, OutlineLoop};

/// Directions that are tried for the sweep.
const DIRECTIONS: u32 = 8;

/// Two edges that meet where they must not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeCrossing {
    /// The edges, the lower index first.
    pub edges: [usize; 2],
    /// Point at which they meet [mm].
    pub point: DVec2,
}

/// First place at which one closed loop of edges crosses, touches or overlaps itself; points within `tolerance` [mm] of
/// an edge touch it.
pub fn loop_crossing(edges: &[OutlineEdge], tolerance: f64) -> Option<EdgeCrossing> {
    first_crossing(edges, &[OutlineLoop { edges: 0..edges.len(), outer: true }], false, tolerance)
}

/// The crossing with the lowest edge numbers among those that the sweep meets first, if the loops cross, touch or
/// overlap themselves or one another; points within `tolerance` [mm] of an edge touch it. `of_lines`: the loops are open lines,
/// whose last edge does not meet the first.
pub(super) fn first_crossing(
    edges: &[OutlineEdge],
    loops: &[OutlineLoop],
    of_lines: bool,
    tolerance: f64,
) -> Option<EdgeCrossing> {
    let spans = sweep_spans(edges, tolerance);
    let next = successors(edges.len(), loops, of_lines);
    let mut order: Vec<usize> = (0..edges.len()).collect();
    order.sort_by(|&a, &b| spans[a].along[0].total_cmp(&spans[b].along[0]).then(a.cmp(&b)));
    let mut open: Vec<usize> = Vec::new();
    for f in order {
        let mut found: Option<EdgeCrossing> = None;
        let span = spans[f];
        open.retain(|&e| {
            if spans[e].along[1] < span.along[0] {
                return false;
            }
            if spans[e].across[0] <= span.across[1] && span.across[0] <= spans[e].across[1] {
                let (a, b) = if e < f { (e, f) } else { (f, e) };
                let shared = Shared { end_to_start: next[a] == b, start_to_end: next[b] == a };
                if let Some(point) = contact(&edges[a], &edges[b], shared, tolerance)
                    && found.is_none_or(|old| [a, b] < old.edges)
                {
                    found = Some(EdgeCrossing { edges: [a, b], point });
                }
            }
            true
        });
        if found.is_some() {
            return found;
        }
        open.push(f);
    }
    None
}

/// Extents of an edge along and across the direction of the sweep, with the tolerance added.
#[derive(Clone, Copy)]
struct EdgeExtent {
    along: [f64; 2],
    across: [f64; 2],
}

fn sweep_spans(edges: &[OutlineEdge], tolerance: f64) -> Vec<EdgeExtent> {
    let mut best = (f64::INFINITY, DVec2::X);
    for i in 0..DIRECTIONS {
        let direction = DVec2::from_angle(PI * f64::from(i) / f64::from(DIRECTIONS));
        let sum: f64 = edges.iter().map(|e| e.extent(direction)).map(|[a, b]| b - a).sum();
        if sum < best.0 {
            best = (sum, direction);
        }
    }
    let wide = |[a, b]: [f64; 2]| [a - tolerance, b + tolerance];
    let span =
        |e: &OutlineEdge| EdgeExtent { along: wide(e.extent(best.1)), across: wide(e.extent(best.1.perp())) };
    edges.iter().map(span).collect()
}

/// The edge that follows each in its loop, or in its line; none follows the last one of a line.
fn successors(count: usize, loops: &[OutlineLoop], of_lines: bool) -> Vec<usize> {
    let mut next: Vec<usize> = (1..=count).collect();
    for one in loops.iter().filter(|l| !l.edges.is_empty()) {
        next[one.edges.end - 1] = if of_lines { usize::MAX } else { one.edges.start };
    }
    next
}

#[cfg(test)]
mod tests;
