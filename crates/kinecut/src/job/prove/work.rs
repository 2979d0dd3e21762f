//! Pieces of work: what one operation does, or what a program of others does with one tool between two changes.

use glam::DVec3;

use super::{Done, Simulated};
use crate::geom::Aabb;
use crate::operations::Operation;
use crate::tool::Tool;

/// Sine below which a direction is square to an axis of the part: a nanometre over a metre.
const LEVEL: f64 = 1e-9;

/// A piece of work.
#[derive(Debug)]
pub(super) struct Work<'a> {
    /// Index of the setup.
    pub(super) setup: usize,
    /// The operation; none of a program of others.
    pub(super) operation: Option<&'a Operation>,
    /// Its number over all setups.
    pub(super) number: Option<u32>,
    /// Name for a person.
    pub(super) name: String,
    /// The tool.
    pub(super) tool: &'a Tool,
    /// Its moves, in order.
    pub(super) done: Vec<Done<'a>>,
}

impl<'a> Work<'a> {
    /// Radius of the tool [mm].
    pub(super) fn radius(&self) -> f64 {
        radius(self.tool)
    }

    /// Feed moves.
    pub(super) fn feeds(&self) -> impl Iterator<Item = &Done<'a>> {
        self.done.iter().filter(|d| d.feed().is_some())
    }
}

/// Largest radius of a tool's edges [mm].
pub(super) fn radius(tool: &Tool) -> f64 {
    0.5 * tool.cutter.diameter(tool.flute_length)
}

/// All pieces of work, in the order of the programs.
pub(super) fn works<'a>(simulated: &Simulated<'a>) -> Vec<Work<'a>> {
    let operations: Vec<&Operation> = simulated.job.setups.iter().flat_map(|s| &s.operations).collect();
    let mut list: Vec<Work<'a>> = Vec::new();
    for (setup, outcome) in simulated.setups.iter().enumerate() {
        let mut last: Option<Option<u32>> = None;
        for done in simulated.segments(setup) {
            let Some(tool) = simulated.tool(done.segment.tool) else { continue };
            let number = match outcome.external {
                Some(_) => None,
                None => {
                    let planned = outcome.planned_item(done.segment.item);
                    let of = planned.and_then(|p| outcome.planned.program.origin(p as usize).operation);
                    // A move of no operation belongs to the passage between them.
                    let Some(number) = of else { continue };
                    Some(number)
                }
            };
            let same = last == Some(number)
                && list.last().is_some_and(|w| w.setup == setup && w.tool.number == tool.number);
            if !same {
                let operation = number.and_then(|n| operations.get(n as usize).copied());
                let name = match operation {
                    Some(operation) => operation.name(),
                    None => format!("{} in `{}`", tool.number, outcome.file),
                };
                list.push(Work { setup, operation, number, name, tool, done: Vec::new() });
            }
            last = Some(number);
            if let Some(work) = list.last_mut() {
                work.done.push(done);
            }
        }
    }
    list
}

/// Whether the line through a point along a direction passes a box.
pub(super) fn passes(point: DVec3, along: DVec3, b: Aabb) -> bool {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for i in 0..3 {
        let [low, high] = [b.min[i], b.max[i]].map(|side| side - point[i]);
        if along[i].abs() < LEVEL {
            if low > 0.0 || high < 0.0 {
                return false;
            }
            continue;
        }
        let [a, b] = [low, high].map(|side| side / along[i]);
        (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
    }
    from <= to
}

/// The greatest height of a box along a direction [mm].
pub(super) fn highest(b: Aabb, along: DVec3) -> f64 {
    (b.min * along).max(b.max * along).element_sum()
}

/// Whether a box overlaps the stock, seen along a direction that is an axis of the part.
pub(super) fn beside(swept: Aabb, stock: Aabb, axis: DVec3) -> bool {
    (0..3).any(|i| axis[i].abs() < 0.5 && (swept.max[i] <= stock.min[i] || swept.min[i] >= stock.max[i]))
}
