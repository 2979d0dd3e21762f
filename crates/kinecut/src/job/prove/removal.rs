//! An operation, or a program of others, that takes nothing out of the stock: nothing is known to be made by it.
//!
//! The lines along the tool axis can miss a shaving that is thinner than their distance; the lines across it keep the number
//! of the cut that made their ends. Both have to say that nothing was met.

use std::collections::BTreeSet;

use super::work::{Work, beside};
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::geom::Aabb;
use crate::stock::{Axis, CutId, DexelGrid};
use crate::tool::Cutter;

pub(super) fn removal(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut pieces: Vec<(usize, String, Vec<&Work<'_>>)> = Vec::new();
    for work in simulated.works {
        let external = simulated.setups[work.setup].external.is_some();
        match pieces.last_mut() {
            Some((setup, _, parts))
                if *setup == work.setup && (external || same_operation(parts[0], work)) =>
            {
                parts.push(work);
            }
            _ => {
                let name = match external {
                    true => format!("program `{}`", simulated.setups[work.setup].file),
                    false => work.name.clone(),
                };
                pieces.push((work.setup, name, vec![work]));
            }
        }
    }
    let idle: Vec<_> = pieces.into_iter().filter(|(_, _, parts)| is_idle(parts)).collect();
    if idle.is_empty() {
        return Vec::new();
    }
    let cuts = cuts(simulated);
    let cut = |setup: usize, d: &Done<'_>| {
        cuts.contains(&(simulated.simulation.first_cut[setup] + d.index as u32 + 1))
    };
    let mut found = Vec::new();
    for (setup, name, parts) in idle {
        if parts.iter().flat_map(|w| &w.done).any(|d| cut(setup, d)) {
            continue;
        }
        let Some(first) = parts.iter().flat_map(|w| w.feeds().next().or(w.done.first())).next() else {
            continue;
        };
        let stock = simulated.job.stock.bounds();
        let feeds = || parts.iter().flat_map(|w| w.feeds().map(|d| (w.radius(), d)));
        let axis = first.segment.axis;
        let swept = feeds().fold(Aabb::EMPTY, |b, (r, d)| b.union(d.segment.curve.bounds().grown(r)));
        let alike = feeds().all(|(_, d)| (d.segment.axis - axis).length() < 1e-9);
        let finding = if alike && !swept.is_empty() && beside(swept, stock, axis) {
            Finding::error(Code::BESIDE_STOCK, format!("{name} lies beside the stock"))
                .help("correct its coordinates, the work offset, or the stock")
        } else if only_taps(&parts) {
            // A tap runs in a hole that is there: its thread is not simulated.
            continue;
        } else {
            Finding::doubt(Code::NOTHING_REMOVED, format!("{name} removes nothing"))
                .help("look at its zero, its heights, the length of its tool and the stock")
        };
        found.push(simulated.at(setup, first.segment.item, finding));
    }
    found
}

/// Whether two pieces are of one operation: its first moves may still be made with the tool before.
fn same_operation(a: &Work<'_>, b: &Work<'_>) -> bool {
    matches!((a.operation, b.operation), (Some(a), Some(b)) if std::ptr::eq(a, b))
}

/// Whether a tap makes all of its feed moves: its first moves may still be made with the tool before.
fn only_taps(parts: &[&Work<'_>]) -> bool {
    let tap = |w: &&Work<'_>| matches!(w.tool.cutter, Cutter::Tap(_));
    parts.iter().any(tap) && parts.iter().all(|w| tap(w) || w.feeds().next().is_none())
}

/// Whether it met nothing.
fn is_idle(parts: &[&Work<'_>]) -> bool {
    parts.iter().flat_map(|w| &w.done).all(|d| !d.met())
}

/// The cuts that have made an end of a line.
fn cuts(simulated: &Simulated<'_>) -> BTreeSet<CutId> {
    let stock = &simulated.simulation.stock;
    let counts = stock.lattice().counts;
    let mut cuts = BTreeSet::new();
    for axis in Axis::ALL {
        let (a, b) = axis.others();
        for j in 0..counts[b.index()] {
            for i in 0..counts[a.index()] {
                for interval in stock.line(axis, i, j) {
                    for end in [interval.lo, interval.hi] {
                        cuts.insert(end.cut);
                    }
                }
            }
        }
    }
    cuts
}
