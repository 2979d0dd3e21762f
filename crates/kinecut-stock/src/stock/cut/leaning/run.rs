//! Moves of tools that lean or turn: long runs of which only the outcome counts at once, the others in order.

use std::ops::Range;
use std::sync::Arc;

use super::super::MoveEffect;
use super::super::effect::Sum;
use super::super::list::CutList;
use super::super::run::{Order, still_wanted};
use super::at_once::{Cells, LEAST, cut_at_once, may_be_cut_at_once, settle_near};
use super::task::Batch;
use super::tiles::cut_in_order;
use crate::base::{Progress, Result};
use crate::stock::{DexelGrid, TriDexel};

/// Cuts moves that lean, and adds their effects to those of the moves before them.
pub(in super::super) fn cut_leaning(
    stock: &mut TriDexel,
    order: Order,
    list: &Arc<CutList>,
    moves: Range<usize>,
    effects: &mut Vec<MoveEffect>,
    progress: &dyn Progress,
) -> Result<()> {
    let step = stock.lattice().step;
    stock.settle_upright(progress);
    let mut next = moves.start;
    while next < moves.end {
        let batch = Batch::new((stock.lattice(), stock.bounds()), list, next..moves.end);
        let mut sums: Vec<Sum> = batch.moves.iter().map(|_| Sum::new(true)).collect();
        let at_once = match order {
            Order::InRuns if batch.tasks.len() >= LEAST => {
                let cells = Cells::new(stock);
                let able = may_be_cut_at_once(&cells, &batch);
                Some((cells, able))
            }
            _ => None,
        };
        let mut from = 0;
        while from < batch.moves.len() && !progress.cancelled() {
            let all = from..batch.moves.len();
            let (end, cells) = match &at_once {
                Some((cells, able)) => next_run(&batch, able, from, cells),
                None => (all.end, None),
            };
            match cells {
                Some(cells) => {
                    let from_list = (&batch, list, next);
                    cut_at_once(stock, cells, from_list, from..end, &mut sums, progress);
                }
                None => {
                    settle_near(stock, batch.tasks_of(from..end), progress);
                    cut_in_order(stock, &batch, from..end, &mut sums, progress);
                }
            }
            progress.advance((end - from) as u64);
            from = end;
        }
        still_wanted(progress)?;
        let done = sums.iter().zip(batch.errors.iter().zip(&batch.filled));
        effects.extend(done.map(|(sum, (error, filled))| sum.effect(step, *error, *filled)));
        next += batch.moves.len();
    }
    Ok(())
}

/// Cuts moves that lean in their order; their effects are of no interest.
pub(in super::super) fn cut_leaning_one_by_one(
    stock: &mut TriDexel,
    list: &CutList,
    moves: Range<usize>,
    progress: &dyn Progress,
) {
    let mut next = moves.start;
    while next < moves.end && !progress.cancelled() {
        let batch = Batch::new((stock.lattice(), stock.bounds()), list, next..moves.end);
        let mut sums: Vec<Sum> = batch.moves.iter().map(|_| Sum::new(true)).collect();
        cut_in_order(stock, &batch, 0..batch.moves.len(), &mut sums, progress);
        next += batch.moves.len();
    }
}

/// The end of the run that begins at a move, and the cells if it may be cut at once: a run of moves that may, if it has enough
/// spans, else all moves up to one of those.
fn next_run<'c>(batch: &Batch, able: &[bool], from: usize, cells: &'c Cells) -> (usize, Option<&'c Cells>) {
    let mut start = from;
    while start < able.len() {
        let end = start + able[start..].iter().take_while(|a| **a).count();
        if batch.tasks_of(start..end).len() >= LEAST {
            return if start == from { (end, Some(cells)) } else { (start, None) };
        }
        start = end + able[end..].iter().take_while(|a| !**a).count();
    }
    (able.len(), None)
}
