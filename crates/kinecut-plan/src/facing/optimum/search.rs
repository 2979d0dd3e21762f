//! Best-first branch and bound, in rounds: the best nodes are split and their halves bounded in parallel, results are
//! gathered in order. The same nodes in the same order whatever the number of threads.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::domain::Extent;
use super::objective::Valued;
use crate::base::Progress;

/// A box of placements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) angle: Extent,
    /// Local offsets; may be wider than what is allowed.
    pub(super) offset: Extent,
}

/// Bounds known of a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounded {
    /// No allowed placement of the node has a lesser value; infinite where none is allowed.
    pub(super) lower: f64,
    /// A promising placement: angle and local offset.
    pub(super) at: [f64; 2],
}

/// A problem for the search.
pub(super) trait Relaxation: Sync {
    /// Memory used again and again.
    type Scratch: Default + Send;
    fn bound(&self, node: &Node, scratch: &mut Self::Scratch) -> Bounded;
    /// The halves of a node; `None` where it is as small as numbers allow.
    fn split(&self, node: &Node) -> Option<[Node; 2]>;
    /// The value at a placement or at a nearby one that is allowed; `None` without one.
    fn value(&self, at: [f64; 2]) -> Option<Valued>;
}

/// Limits at which the search stops.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Gap at which it ends, absolute.
    pub(super) gap: f64,
    pub(super) max_nodes: usize,
}

/// The outcome.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// Best value with its angle and local offset.
    pub(super) best: Option<Valued>,
    /// No allowed placement has a lesser value; infinite where none is allowed.
    pub(super) lower: f64,
    pub(super) nodes: usize,
    /// The gap was reached.
    pub(super) complete: bool,
}

struct Open {
    lower: f64,
    /// Order of creation: ties are decided by it.
    id: usize,
    node: Node,
}

impl PartialEq for Open {
    fn eq(&self, other: &Open) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Open {}
impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Open) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Open {
    /// The least bound is the greatest element: the heap gives it first.
    fn cmp(&self, other: &Open) -> Ordering {
        other.lower.total_cmp(&self.lower).then(other.id.cmp(&self.id))
    }
}

/// Nodes split in a round: enough for some threads, few enough that the order stays nearly best-first.
const ROUND: usize = 32;
/// Boxes that one thread takes at once at least.
const GRAIN: usize = 4;

/// Searches the boxes. `best`: a value known before, with its placement.
pub(super) fn search<R: Relaxation>(
    problem: &R,
    roots: Vec<Node>,
    best: Option<Valued>,
    limits: Limits,
    progress: &dyn Progress,
) -> Found {
    let mut found = Found { best, lower: f64::INFINITY, nodes: 0, complete: false };
    let mut heap: BinaryHeap<Open> = BinaryHeap::new();
    let mut fresh = roots;
    let mut settled = f64::INFINITY;
    let mut stopped = false;
    loop {
        let target = found.best.map_or(f64::INFINITY, |b| b.0 - limits.gap);
        let results: Vec<(Bounded, Option<Valued>)> = fresh
            .par_iter()
            .with_min_len(GRAIN)
            .map_init(R::Scratch::default, |scratch, node| {
                let bounded = problem.bound(node, scratch);
                let value = if bounded.lower < target { problem.value(bounded.at) } else { None };
                (bounded, value)
            })
            .collect();
        for value in results.iter().filter_map(|r| r.1) {
            if found.best.is_none_or(|b| value.0 < b.0) {
                found.best = Some(value);
            }
        }
        let target = found.best.map_or(f64::INFINITY, |b| b.0 - limits.gap);
        for (node, (bounded, _)) in fresh.drain(..).zip(results) {
            found.nodes += 1;
            if bounded.lower < target {
                heap.push(Open { lower: bounded.lower, id: found.nodes, node });
            } else if bounded.lower < settled {
                settled = bounded.lower;
            }
        }
        if stopped || progress.cancelled() || found.nodes >= limits.max_nodes {
            break;
        }
        while fresh.len() < 2 * ROUND {
            let Some(open) = heap.pop() else { break };
            if open.lower >= target {
                heap.push(open);
                break;
            }
            match problem.split(&open.node) {
                Some(halves) => fresh.extend(halves),
                // Its bound stays as it is, and limits the certificate.
                None if open.lower < settled => settled = open.lower,
                None => {}
            }
        }
        stopped = fresh.is_empty();
        if stopped {
            break;
        }
    }
    let open = heap.peek().map_or(f64::INFINITY, |o| o.lower);
    found.lower = if open < settled { open } else { settled };
    if let Some((value, _)) = found.best {
        if value < found.lower {
            found.lower = value;
        }
        found.complete = value - found.lower <= limits.gap;
    } else {
        found.complete = found.lower == f64::INFINITY;
    }
    found
}
