//! The search where all edges are straight: nodes are intervals of angles, exact in the offset.

use std::f64::consts::PI;

use super::domain::{Domain, Span, Turned};
use super::lines::Lines;
use super::search::{Bounded, Node, Relaxation};
use super::sweep::Sweep;
use crate::facing::{FaceCase, bad_length};
use crate::num::angle::wrap_positive;

/// The problem of a case whose edges are straight.
pub(super) struct Straight<'a> {
    case: &'a FaceCase,
    domain: &'a Domain,
    lines: Lines,
    parallel: Vec<f64>,
}

/// Angles nearer than this are one [rad]: at the edge of a metre they differ by 10 picometres.
pub(super) const LEAST_ANGLE: f64 = 1e-11;

impl<'a> Straight<'a> {
    /// The problem of the case; circular edges, if it has any, are replaced by chords.
    pub(super) fn new(case: &'a FaceCase, domain: &'a Domain) -> Straight<'a> {
        Straight { case, domain, lines: Lines::with_chords(case, domain), parallel: parallel_angles(case) }
    }

    /// Number of lines.
    pub(super) fn size(&self) -> usize {
        self.lines.lines.len()
    }

    /// Angles of the full turn at which a search begins: many lines make each of them dear.
    pub(super) fn per_turn(&self, circular: bool) -> f64 {
        if circular || self.size() > 60 { 180.0 } else { 360.0 }
    }

    /// The least value at one angle, and the local offset that has it: of the chords where edges are circular.
    pub(super) fn least_at(&self, angle: f64, sweep: &mut Sweep) -> Bounded {
        let node = Node { angle: [angle, angle], offset: [f64::NEG_INFINITY, f64::INFINITY] };
        self.bound(&node, sweep)
    }
}

impl Relaxation for Straight<'_> {
    type Scratch = Sweep;

    fn bound(&self, node: &Node, sweep: &mut Sweep) -> Bounded {
        let turned = Turned::new(node.angle);
        let middle = 0.5 * (node.angle[0] + node.angle[1]);
        let mut best = Bounded { lower: f64::INFINITY, at: [middle, 0.0] };
        for [from, to] in self.domain.offsets_over(&turned) {
            let from = if node.offset[0] > from { node.offset[0] } else { from };
            let to = if node.offset[1] < to { node.offset[1] } else { to };
            if from <= to {
                let (lower, at) = self.lines.least(&turned, [from, to], sweep);
                if lower < best.lower {
                    best = Bounded { lower, at: [middle, at] };
                }
            }
        }
        best.at[0] = probe_angle(&self.parallel, node.angle);
        best
    }

    fn split(&self, node: &Node) -> Option<[Node; 2]> {
        let [from, to] = node.angle;
        let middle = 0.5 * (from + to);
        let halves = [Node { angle: [from, middle], ..*node }, Node { angle: [middle, to], ..*node }];
        (to - from > LEAST_ANGLE).then_some(halves)
    }

    fn value(&self, at: [f64; 2]) -> Option<f64> {
        value(self.case, self.domain, at)
    }
}

/// The value at an angle and a local offset, which is moved into what is allowed if that is near.
pub(super) fn value(case: &FaceCase, domain: &Domain, [angle, local]: [f64; 2]) -> Option<f64> {
    let local = clamped(domain, angle, local)?;
    Some(bad_length(case, domain.placement(angle, local)))
}

/// The allowed local offset nearest to the given one, if the angle has any.
pub(super) fn clamped(domain: &Domain, angle: f64, local: f64) -> Option<f64> {
    let inside = domain.offsets(angle).into_iter().filter(|s| s[0] <= s[1]).map(|s| local.clamp(s[0], s[1]));
    inside.min_by(|a, b| (a - local).abs().total_cmp(&(b - local).abs()))
}

/// Angles in [0, 2 pi) at which an edge that counts is parallel to the feed, ascending: the value jumps there, to what
/// may be the least of all.
pub(super) fn parallel_angles(case: &FaceCase) -> Vec<f64> {
    let edges = case.outline.edges().iter().zip(&case.weights).filter(|(e, w)| e.turn.is_none() && **w > 0.0);
    let mut angles: Vec<f64> =
        edges.flat_map(|(e, _)| [-e.heading(0.0), PI - e.heading(0.0)]).map(wrap_positive).collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    angles
}

/// Where to try a node: in its middle, or where an edge is parallel to the feed.
pub(super) fn probe_angle(parallel: &[f64], angle: Span) -> f64 {
    let middle = 0.5 * (angle[0] + angle[1]);
    if angle[1] - angle[0] > WIDE {
        return middle;
    }
    let next = parallel.partition_point(|p| *p < middle);
    let near = [next.checked_sub(1), Some(next)].into_iter().flatten().filter_map(|i| parallel.get(i).copied());
    let inside = near.filter(|p| angle[0] <= *p && *p <= angle[1]);
    inside.min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs())).unwrap_or(middle)
}

/// Nodes wider than this [rad] are tried in their middle only.
const WIDE: f64 = 0.02;
