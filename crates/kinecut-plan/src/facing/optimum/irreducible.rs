//! The bad length that no straight pass avoids: for each loop the certified least of its own bad length over all
//! placements that are allowed for the whole part.
//!
//! The rim of a bore depends on the height of its centre over the centre line alone: a search in one variable. Other
//! loops are searched like the whole, with the other edges' weights 0 and a coarser gap.

use super::Irreducible;
use super::arc_box::Arc;
use super::domain::{Domain, Turned};
use super::lines::BadInterval;
use super::objective::Valued;
use super::prove;
use super::search::{Bounded, Limits, Node, Relaxation, search};
use crate::base::Progress;
use crate::facing::FaceCase;

/// Gap of these searches per weighted length of the loop: the number is read by people.
const GAP: f64 = 2e-3;
/// Nodes of these searches: their bound holds wherever they stop.
const NODES: usize = 3000;

/// The irreducible part of each loop; `whole`: the bound of the whole outline, of value where it has but one loop.
pub(super) fn irreducible(
    case: &FaceCase,
    domain: &Domain,
    whole: f64,
    progress: &dyn Progress,
) -> Vec<Irreducible> {
    let weight_of = |edges: std::ops::Range<usize>| -> f64 {
        edges.map(|e| case.outline.edges()[e].length() * case.weights[e]).sum()
    };
    let loops = case.outline.loops();
    let counting = loops.iter().filter(|l| weight_of(l.edges.clone()) > 0.0).count();
    let one = |(index, edges): (usize, std::ops::Range<usize>)| {
        let weighted = weight_of(edges.clone());
        let length = if weighted == 0.0 {
            0.0
        } else if counting == 1 {
            whole
        } else {
            let limits = Limits { gap: GAP * weighted, max_nodes: NODES };
            let rim = (edges.len() == 1).then(|| Rim::new(case, domain, edges.start)).flatten();
            let lower = if let Some(rim) = rim {
                let roots = rim.roots(domain);
                search(&rim, roots, None, limits, progress).lower
            } else {
                let mut weights = vec![0.0; case.weights.len()];
                weights[edges.clone()].copy_from_slice(&case.weights[edges.clone()]);
                let own = FaceCase { weights, ..case.clone() };
                prove::bound(&own, domain, limits, progress)
            };
            if lower > 0.0 && lower.is_finite() { lower } else { 0.0 }
        };
        let share = if weighted > 0.0 { length / weighted } else { 0.0 };
        Irreducible { outline_loop: index, length, share }
    };
    loops.iter().map(|l| l.edges.clone()).enumerate().map(one).collect()
}

/// The rim of a bore: nodes are intervals of the height of its centre, in the place of offsets.
struct Rim {
    arc: Arc,
    centre: glam::DVec2,
    radius: f64,
    parts: Vec<BadInterval>,
}

impl Rim {
    /// `None` unless the edge is a full circle.
    fn new(case: &FaceCase, domain: &Domain, edge: usize) -> Option<Rim> {
        let weight = case.weights[edge];
        let edge = &case.outline.edges()[edge];
        let turn = edge.turn?;
        let parts: Vec<BadInterval> = case
            .bad
            .layers()
            .iter()
            .map(|p| BadInterval { from: p.from, to: p.to, weight: p.weight })
            .collect();
        let arc = Arc::new(edge, domain.middle, weight, case.radius, &parts).filter(Arc::is_full)?;
        Some(Rim { arc, centre: turn.centre - domain.middle, radius: case.radius, parts })
    }

    /// Heights that some allowed placement has, in pieces.
    fn roots(&self, domain: &Domain) -> Vec<Node> {
        let mut height = [f64::INFINITY, f64::NEG_INFINITY];
        for node in prove::roots(domain, prove::COARSE) {
            let turned = Turned::new(node.angle);
            let y = turned.heights(self.centre, self.centre.length());
            for offset in domain.offsets_over(&turned).into_iter().filter(|s| s[0] <= s[1]) {
                if y[0] - offset[1] < height[0] {
                    height[0] = y[0] - offset[1];
                }
                if y[1] - offset[0] > height[1] {
                    height[1] = y[1] - offset[0];
                }
            }
        }
        if height[0] > height[1] { Vec::new() } else { vec![Node { angle: [0.0, 0.0], offset: height }] }
    }
}

impl Relaxation for Rim {
    type Scratch = ();

    fn bound(&self, node: &Node, (): &mut ()) -> Bounded {
        let lower = (0..self.parts.len())
            .map(|k| self.arc.sure_at(k, node.offset) * self.arc.weight * self.parts[k].weight)
            .sum();
        Bounded { lower, at: [0.0, 0.5 * (node.offset[0] + node.offset[1])] }
    }

    fn split(&self, node: &Node) -> Option<[Node; 2]> {
        let [a, b] = node.offset;
        let m = 0.5 * (a + b);
        let least = super::lines::ROUNDING * self.radius;
        (b - a > least).then_some([Node { offset: [a, m], ..*node }, Node { offset: [m, b], ..*node }])
    }

    fn value(&self, at: [f64; 2]) -> Option<Valued> {
        Some((self.bound(&Node { angle: [0.0, 0.0], offset: [at[1]; 2] }, &mut ()).lower, at))
    }
}
