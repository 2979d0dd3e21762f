//! Long runs of moves of which only the outcome counts: what all take together, in any order.
//!
//! The stock is divided into bricks of 16 x 16 x 16 lines (`cells.rs`). A brick that one pose of a tool swallows is void; in each
//! that is left the spans near it are sought, then in smaller and smaller cells (`brick.rs`), with bounds by tangent planes
//! (`near.rs`). In the smallest cell the span that reaches deepest comes first (`planes.rs`), so that nearly all others have nothing
//! left to cut, which closer bounds tell (`away.rs`); what is asked of many spans, or about many bricks, is asked side by side
//! (`lanes.rs`). Each stretch of a line is cut as it is in order, by the same functions, so that the lines are the same up to the
//! rounding of an end or two; but a line that lies in a flat face, to within 2 nm, may be taken in order and be left here.
//!
//! The lines along one axis of the stock are cut alone where all tools are near to it; those across it are cut when somebody reads them
//! (`owed.rs`).
//!
//! A run holds moves of tools without a core that are meant to cut, and whose shank and holder stay away from all material there is before it.
//! The amount that a move removes depends on the order: it is measured on some of the lines (`account.rs`).

mod about;
mod account;
mod away;
mod borders;
mod brick;
mod bundle;
mod cells;
mod lanes;
mod near;
mod owed;
mod places;
mod planes;
mod shadow;

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use self::account::{account, measured_along};
use self::brick::Grids;
pub(super) use self::cells::Cells;
use self::cells::Room;
use self::near::SweptPart;
pub(in crate::stock) use self::owed::OwedAcross;
pub(super) use self::owed::settle_near;
use super::super::effect::{Effect, Looked, Sum};
use super::super::list::CutList;
use super::task::{Batch, SpanTask};
use crate::base::Progress;
use crate::stock::{Axis, TriDexel};

/// Spans from which on a run is cut at once.
pub(super) const LEAST: usize = 256;

/// By move of a batch: true if only its outcome counts.
pub(super) fn may_be_cut_at_once(cells: &Cells, batch: &Batch) -> Vec<bool> {
    let able = |room: &mut Room, task: &SpanTask| {
        let mut keeps_off = |looked: Looked| {
            let grown = task.tool.grown.as_ref().map(|(grown, _)| &grown[looked as usize]);
            let body = grown.unwrap_or(task.tool.looked_at(looked));
            body.parts.iter().all(|part| {
                let swept = SweptPart::new(task, part, 0);
                let mut meets = false;
                cells.each_near(room, &swept, |_, _| meets = true);
                !meets
            })
        };
        // An edge that leaves a core asks of each move whether it went across its axis in material.
        let cuts = task.one.removes && !task.one.watch && task.tool.hollow.is_none();
        cuts && keeps_off(Looked::Shank) && keeps_off(Looked::Holder)
    };
    let spans: Vec<bool> = batch.tasks.par_iter().with_max_len(64).map_init(Room::default, able).collect();
    let mut all = vec![true; batch.moves.len()];
    for (task, able) in batch.tasks.iter().zip(spans) {
        all[task.index as usize] &= able;
    }
    all
}

/// Cuts a range of moves of a batch, of a list from some move on, and adds up what each does. Lines across the axis that all tools are
/// near to are left for later.
pub(super) fn cut_at_once(
    stock: &mut TriDexel,
    cells: &Cells,
    (batch, list, first): (&Batch, &Arc<CutList>, usize),
    moves: Range<usize>,
    sums: &mut [Sum],
    progress: &dyn Progress,
) {
    let tasks = batch.tasks_of(moves.clone());
    let mut seen = vec![false; moves.len()];
    let swept = swept_parts(tasks);
    let main = measured_along(tasks);
    let usual = main.first().map(|of| Axis::ALL[*of]).filter(|of| main.iter().all(|k| *k == of.index()));
    if usual.is_none_or(|usual| stock.owed.as_ref().is_some_and(|owed| owed.is_across(usual))) {
        stock.settle(progress);
    }
    account(stock, (tasks, &main), &swept, progress, |effect| {
        let index = effect.index as usize;
        seen[index - moves.start] |= effect.first.is_some();
        sums[index].add(effect, 0);
    });
    let axes = usual.as_ref().map_or(&Axis::ALL[..], std::slice::from_ref);
    let bricks = cells.bricks_with_material();
    let grids = Grids::share(&mut stock.grids);
    let touched = unite((cells, &bricks), (&grids, axes), &swept, progress);
    let winners = touched.par_iter().map(|brick| brick::winners(cells, (&grids, axes), *brick, batch));
    let winners = winners.collect::<Vec<_>>().concat();
    for (index, point) in winners.into_iter().filter(|(index, _)| moves.contains(&(*index as usize))) {
        if !std::mem::replace(&mut seen[index as usize - moves.start], true) {
            // It has left an end, so it has taken something.
            let first = Some((1.0, point));
            sums[index as usize].add(&Effect { index, removed: 1, first, ..Effect::default() }, 0);
        }
    }
    if let Some(usual) = usual {
        let owed = stock.owed.get_or_insert_with(|| OwedAcross::new(usual, cells));
        owed.note_swallowed(bricks.iter().copied().filter(|brick| !cells.has_material(*brick)));
        owed.owe(list, first + moves.start..first + moves.end, (tasks, moves.start));
    }
}

/// The convex parts of the tools of spans, one after another.
fn swept_parts<'a>(tasks: &'a [SpanTask<'a>]) -> Vec<SweptPart<'a>> {
    let parts = |task: &'a SpanTask<'a>| {
        task.tool.cutting.parts.iter().enumerate().map(|(i, part)| SweptPart::new(task, part, i))
    };
    tasks.iter().flat_map(parts).collect()
}

/// Takes all that spans sweep out of lines along some axes, through bricks; tells those of them that something came near to and that
/// may have material left.
fn unite(
    (cells, bricks): (&Cells, &[u32]),
    (grids, axes): (&[Grids; 3], &[Axis]),
    swept: &[SweptPart],
    progress: &dyn Progress,
) -> Vec<u32> {
    let thinnest = swept.iter().map(|one| one.part.r1).fold(f64::INFINITY, f64::min);
    let leaf = brick::leaf(thinnest, cells.lattice().step);
    let mut from = 0;
    let mut touched = vec![false; bricks.len()];
    while from < swept.len() && !progress.cancelled() {
        let near = cells.near(swept, from, progress);
        touched.par_iter_mut().zip(bricks).with_max_len(4).for_each(|(touched, brick)| {
            let list = near.of(*brick);
            if !list.is_empty() && !progress.cancelled() {
                brick::cut((cells, leaf), (grids, axes), swept, *brick, list);
                *touched = true;
            }
        });
        from = near.end;
    }
    let mut gone = vec![false; cells.count()];
    bricks.iter().for_each(|brick| gone[*brick as usize] = !cells.has_material(*brick));
    brick::empty_all(cells, (grids, axes), &gone);
    let left = touched.iter().zip(bricks).filter(|(touched, brick)| **touched && cells.has_material(**brick));
    left.map(|(_, brick)| *brick).collect()
}
