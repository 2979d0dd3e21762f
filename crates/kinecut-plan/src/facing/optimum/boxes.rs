//! The search with circular edges: nodes are boxes of angles and offsets.
//!
//! Two bounds of the value on a box, the greater counts. *Sure*: the length that is bad at every placement of the box;
//! it tends to the value as fast as the box shrinks. *Centred*: for edges without a kink on the box the mean value
//! theorem gives f >= f(middle) - |df/dangle| half the angles - |df/dc| half the offsets; derivatives of these edges
//! are added as intervals before the absolute value is taken, so that at a smooth minimum, where they cancel, the bound
//! is off by the square of the box's size; edges with a kink count with what is sure.

use super::domain::Turned;
use super::interval::{Smooth, most};
use super::line_box;
use super::objective::{Objective, Valued};
use super::place::PlacementBox;
use super::search::{Bounded, Node, Relaxation};
use super::straight::LEAST_ANGLE;

/// The problem of a case with circular edges.
pub(super) struct Boxes<'a>(pub(super) &'a Objective<'a>);

/// Offsets nearer than this are one, per radius of the cutter.
const LEAST_OFFSET: f64 = 1e-11;

impl Boxes<'_> {
    /// Both bounds: what is surely bad on the box, and the centred one.
    fn bounds(&self, place: &PlacementBox) -> [f64; 2] {
        let (mut sure, mut kinked) = (0.0, 0.0);
        let mut sum = Smooth::default();
        let mut take = |weight: f64, least: f64, smooth: Option<Smooth>| {
            sure += weight * least;
            match smooth {
                Some(smooth) => sum.add(weight, &smooth),
                None => kinked += weight * least,
            }
        };
        let (radius, near) = (self.0.lines.radius, self.0.lines.near);
        for line in &self.0.lines.lines {
            let per_mm = line.weight / line.length;
            for part in &self.0.lines.parts {
                let least = line_box::sure(line, part, place, radius, near);
                take(per_mm * part.weight, least, line_box::smooth(line, part, place, radius));
            }
        }
        for arc in &self.0.arcs {
            for (k, part) in self.0.lines.parts.iter().enumerate() {
                take(arc.weight * part.weight, arc.sure(k, place), arc.smooth(k, place));
            }
        }
        let half = [place.turned.angle, place.offset].map(|s| 0.5 * (s[1] - s[0]));
        [sure, kinked + sum.value - most(sum.by_angle) * half[0] - most(sum.by_offset) * half[1]]
    }
}

impl Relaxation for Boxes<'_> {
    type Scratch = ();

    fn bound(&self, node: &Node, (): &mut ()) -> Bounded {
        let mut lower = f64::INFINITY;
        let mut at = [0.5 * (node.angle[0] + node.angle[1]), 0.0];
        for [from, to] in self.0.domain.offsets_over(&Turned::new(node.angle)) {
            let offset = [
                if node.offset[0] > from { node.offset[0] } else { from },
                if node.offset[1] < to { node.offset[1] } else { to },
            ];
            if offset[0] > offset[1] {
                continue;
            }
            let place = PlacementBox::new(node.angle, offset, self.0.domain.reach);
            let [sure, centred] = self.bounds(&place);
            let bound = if sure > centred { sure } else { centred };
            if bound < lower {
                lower = bound;
                at = place.middle;
            }
        }
        at[0] = self.0.probe_angle(node.angle);
        Bounded { lower, at }
    }

    fn split(&self, node: &Node) -> Option<[Node; 2]> {
        let [a, b] = node.angle;
        // Unsplit offsets are as wide as allowed.
        let [from, to] = node.offset;
        let (m, n) = (0.5 * (a + b), 0.5 * (from + to));
        let wide = (b - a) * self.0.case.radius;
        if wide >= to - from {
            (b - a > LEAST_ANGLE)
                .then_some([Node { angle: [a, m], ..*node }, Node { angle: [m, b], ..*node }])
        } else {
            (to - from > LEAST_OFFSET * self.0.case.radius)
                .then_some([Node { offset: [from, n], ..*node }, Node { offset: [n, to], ..*node }])
        }
    }

    fn value(&self, at: [f64; 2]) -> Option<Valued> {
        self.0.near(at)
    }
}
