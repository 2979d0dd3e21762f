//! The search where all edges are straight: nodes are intervals of angles, exact in the offset.

use super::domain::Turned;
use super::lines::Lines;
use super::objective::{Objective, Valued};
use super::search::{Bounded, Node, Relaxation};
use super::sweep::Sweep;

/// The problem of a case with straight edges. Of other cases, chords replace the arcs: good for samples, of no value as
/// a bound.
pub(super) struct Straight<'a> {
    objective: &'a Objective<'a>,
    lines: Lines,
}

/// Angles nearer than this are one [rad]: at the edge of a metre they differ by 10 picometres.
pub(super) const LEAST_ANGLE: f64 = 1e-11;

impl<'a> Straight<'a> {
    /// The problem of the case.
    pub(super) fn new(objective: &'a Objective<'a>) -> Straight<'a> {
        Straight { objective, lines: Lines::with_chords(objective.case, objective.domain) }
    }

    /// Number of lines.
    pub(super) fn size(&self) -> usize {
        self.lines.lines.len()
    }

    /// Angles of the full turn at which a search begins: many lines make each of them dear.
    pub(super) fn per_turn(&self) -> f64 {
        if self.objective.circular() || self.size() > 60 { 180.0 } else { 360.0 }
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
        for [from, to] in self.objective.domain.offsets_over(&turned) {
            let from = if node.offset[0] > from { node.offset[0] } else { from };
            let to = if node.offset[1] < to { node.offset[1] } else { to };
            if from <= to {
                let (lower, at) = self.lines.least(&turned, [from, to], sweep);
                if lower < best.lower {
                    best = Bounded { lower, at: [middle, at] };
                }
            }
        }
        best.at[0] = self.objective.probe_angle(node.angle);
        best
    }

    fn split(&self, node: &Node) -> Option<[Node; 2]> {
        let [from, to] = node.angle;
        let middle = 0.5 * (from + to);
        let halves = [Node { angle: [from, middle], ..*node }, Node { angle: [middle, to], ..*node }];
        (to - from > LEAST_ANGLE).then_some(halves)
    }

    fn value(&self, at: [f64; 2]) -> Option<Valued> {
        self.objective.near(at)
    }
}
