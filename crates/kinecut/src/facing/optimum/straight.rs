//! The search where all edges are straight: nodes are intervals of angles, exact in the offset.

use super::domain::{Domain, Turned};
use super::lines::Lines;
use super::search::{Bounded, Node, Relaxation};
use super::sweep::Sweep;
use crate::facing::{FaceCase, bad_length};

/// The problem of a case whose edges are straight.
pub(super) struct Straight<'a> {
    pub(super) case: &'a FaceCase,
    pub(super) domain: &'a Domain,
    pub(super) lines: Lines,
}

/// Angles nearer than this are one [rad]: at the edge of a metre they differ by 10 picometres.
pub(super) const LEAST_ANGLE: f64 = 1e-11;

impl Straight<'_> {
    /// The least value at one angle, and the local offset that has it.
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
