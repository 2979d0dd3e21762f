//! Moves of tools that stand along one axis: in long runs from above, and line by line where a move has to be looked at so.

use std::ops::Range;
use std::sync::Arc;

use super::above::{Done, are_clear, cut_from_above, settle_near, stride};
use super::axis::ToolFrame;
use super::effect::Sum;
use super::followed::is_followed;
use super::hollow::standing;
use super::in_order::cut_in_order;
use super::list::CutList;
use super::piece::{MovePiece, pieces};
use super::run::{BATCH, Order, still_wanted};
use super::task::Task;
use super::{CutAxis, CutMove, MoveEffect};
use crate::base::{Progress, Result};
use crate::stock::{DexelGrid, FIXED_STEP, TriDexel};

/// Moves that are cut from above at once: bounds the memory of their lists.
const MOST: usize = 32_768;

/// Tasks that are cut from above at once, as one move may have many.
const MOST_TASKS: usize = 65_536;

/// Tasks of a run from which on they are cut at once.
const LEAST: usize = 1024;

/// Moves of one tool axis made ready.
struct Batch<'a> {
    tasks: Vec<Task<'a>>,
    /// By move: how far its path was replaced [mm].
    errors: Vec<f64>,
    /// By move: a hollow tool is cut as if it were none.
    filled: Vec<bool>,
}

impl<'a> Batch<'a> {
    /// Of a range of moves, as many as there is room for; tasks count them from its start. `free` says of a move that its cutting part
    /// and shank are known to meet nothing.
    fn new(
        list: &'a CutList,
        range: Range<usize>,
        frame: &ToolFrame,
        free: impl Fn(usize) -> bool,
    ) -> Batch<'a> {
        let mut batch = Batch {
            tasks: Vec::with_capacity(range.len().min(MOST_TASKS)),
            errors: Vec::with_capacity(range.len()),
            filled: Vec::with_capacity(range.len()),
        };
        for i in range.clone() {
            if batch.tasks.len() >= MOST_TASKS {
                break;
            }
            let first = batch.tasks.len();
            let (error, filled) = tasks_of(list, i, frame, (i - range.start) as u32, &mut batch.tasks);
            let free = free(i);
            batch.tasks[first..].iter_mut().for_each(|task| task.free = free);
            batch.errors.push(error);
            batch.filled.push(filled);
        }
        batch
    }

    /// The tasks of a range of moves.
    fn tasks_of(&self, moves: Range<usize>) -> &[Task<'a>] {
        let at = |index: usize| self.tasks.partition_point(|t| (t.index as usize) < index);
        &self.tasks[at(moves.start)..at(moves.end)]
    }

    /// Cuts a range of moves line by line and tells what they do.
    fn cut_in_order(
        &self,
        stock: &mut TriDexel,
        frame: &ToolFrame,
        moves: Range<usize>,
        progress: &dyn Progress,
    ) -> Vec<MoveEffect> {
        let mut sums: Vec<Sum> = moves.clone().map(|_| Sum::new(false)).collect();
        let mut tasks = self.tasks_of(moves.clone()).to_vec();
        for task in &mut tasks {
            task.index -= moves.start as u32;
        }
        settle_near(stock, &tasks, progress);
        cut_in_order(stock, frame, &tasks, &mut sums, progress);
        let step = stock.lattice().step;
        let told = sums.iter().zip(&self.errors[moves.clone()]).zip(&self.filled[moves]);
        told.map(|((sum, error), filled)| sum.effect(step, *error, *filled)).collect()
    }
}

/// Whether a move may bring its tool below the top of the box of the stock.
fn goes_below(stock: &TriDexel, frame: &ToolFrame, m: &CutMove) -> bool {
    let (bounds, path, along) = (stock.bounds(), m.curve.bounds(), frame.axes[2].index());
    // Whether it may meet something is asked more closely then.
    let room = 2.0 * stock.lattice().step;
    match frame.sign > 0.0 {
        true => path.min[along] - room < bounds.max[along],
        false => path.max[along] + room > bounds.min[along],
    }
}

/// Looks at a move that should meet nothing: line by line where that is not known without.
fn look(
    stock: &mut TriDexel,
    (axis, frame): (CutAxis, &ToolFrame),
    list: &CutList,
    at: usize,
    progress: &dyn Progress,
) -> MoveEffect {
    let batch = Batch::new(list, at..at + 1, frame, |_| false);
    if are_clear(stock, (axis, frame), &batch.tasks) {
        return MoveEffect { path_error: batch.errors[0], ..MoveEffect::default() };
    }
    batch.cut_in_order(stock, frame, 0..1, progress).swap_remove(0)
}

/// Adds the tasks of a move, which carry an index; tells how far its path was replaced [mm], and whether a hollow tool is cut as if
/// it were none.
pub(super) fn tasks_of<'a>(
    list: &'a CutList,
    at: usize,
    frame: &ToolFrame,
    index: u32,
    tasks: &mut Vec<Task<'a>>,
) -> (f64, bool) {
    let m = &list.moves[at];
    let tool = &list.tools[m.body as usize];
    let (pieces, error) = pieces(&m.curve, frame, list.options.path_tolerance);
    let across = |piece: &MovePiece| tool.hollow.is_some() && standing(&piece.plan).is_none();
    let filled = pieces.iter().any(across);
    tasks.extend(pieces.into_iter().map(|piece| Task {
        piece,
        index,
        cut: list.cut(at),
        removes: m.removes,
        watch: m.watch || across(&piece),
        free: false,
        frame: *frame,
        tool,
        clearance: list.options.clearance,
        step: list.step,
        plan_box: piece.plan.bounds(),
    }));
    (error, filled)
}

/// Cuts moves of tools that stand along an axis line by line in their order; their effects are of no interest.
pub(super) fn cut_one_by_one(
    stock: &mut TriDexel,
    axis: CutAxis,
    list: &CutList,
    moves: Range<usize>,
    progress: &dyn Progress,
) {
    let frame = ToolFrame::new(axis);
    let mut next = moves.start;
    while next < moves.end && !progress.cancelled() {
        let batch = Batch::new(list, next..moves.end.min(next + BATCH), &frame, |_| false);
        let count = batch.errors.len();
        batch.cut_in_order(stock, &frame, 0..count, progress);
        next += count;
    }
}

/// Cuts moves of tools that stand along an axis, and adds their effects.
pub(super) fn cut_upright(
    stock: &mut TriDexel,
    (axis, order): (CutAxis, Order),
    list: &Arc<CutList>,
    moves: Range<usize>,
    effects: &mut Vec<MoveEffect>,
    progress: &dyn Progress,
) -> Result<()> {
    let (frame, step) = (ToolFrame::new(axis), stock.lattice().step);
    let is_other = stock.above.as_ref().is_some_and(|above| !above.is_along(axis));
    // What leaning tools have left for later is cut before one of these tools comes to the stock.
    let comes = |i: usize| list.swept(i).meets(stock.bounds().grown(2.0 * step));
    if is_other || stock.owed.is_some() && moves.clone().any(comes) {
        stock.settle(progress);
    }
    let (mut next, mut size, mut singly) = (moves.start, BATCH, 1);
    // By move: it was cut from above.
    let mut whole: Vec<bool> = Vec::new();
    while next < moves.end {
        let mut some = next..moves.end.min(next + size);
        // Moves that should meet nothing and go below the top: they are looked at by themselves, or known to be clear.
        let mut free = vec![false; some.len()];
        if order.is_in_runs() {
            for (i, free) in some.clone().zip(&mut free) {
                let m = &list.moves[i];
                if !(m.watch && goes_below(stock, &frame, m)) {
                    continue;
                }
                // Those that come with it in this run are cut from above, or it is not reached.
                let is_whole = |i: usize| i >= next || whole[i - moves.start];
                *free = is_followed(list, (moves.start, i), &frame, is_whole);
                if !*free {
                    some.end = i;
                    break;
                }
            }
        }
        if some.is_empty() {
            let effect = look(stock, (axis, &frame), list, next, progress);
            effects.push(effect);
            whole.push(false);
            still_wanted(progress)?;
            progress.advance(1);
            next += 1;
            continue;
        }
        let batch = Batch::new(list, some, &frame, |i| free[i - next]);
        let count = batch.errors.len();
        // What is cut from above, by move: length removed, depth, a contact.
        let mut sums = vec![(0, 0, None::<(f64, [f64; 3])>); count];
        let mut note = |done: &Done| {
            let (removed, deepest, first) = &mut sums[batch.tasks[done.task as usize].index as usize];
            *removed += done.removed;
            *deepest = done.deepest.max(*deepest);
            if let Some(new) = done.first
                && first.is_none_or(|old| new.0 < old.0)
            {
                *first = Some(new);
            }
        };
        let stopped = match order {
            Order::InRuns => {
                let stride = (batch.tasks.len() >= LEAST).then(|| stride(&batch.tasks, step));
                let stride = stride.filter(|stride| *stride > 1);
                cut_from_above(stock, (axis, &frame), (&batch.tasks, stride), progress, &mut note)
            }
            #[cfg(test)]
            Order::AtOnce => {
                let stride = Some(stride(&batch.tasks, step));
                cut_from_above(stock, (axis, &frame), (&batch.tasks, stride), progress, &mut note)
            }
            #[cfg(test)]
            Order::OneByOne => Some(0),
        };
        let from_above = stopped.map_or(count, |index| index as usize);
        if let Some(above) = &mut stock.above {
            above.owe(list, next..next + from_above);
        }
        effects.extend(sums[..from_above].iter().zip(&batch.errors).map(
            |((removed, deepest, first), error)| MoveEffect {
                removed: *removed as f64 * FIXED_STEP * step * step,
                deepest: *deepest as f64 * FIXED_STEP,
                first_contact: first.map(|(_, point)| point),
                path_error: *error,
                ..MoveEffect::default()
            },
        ));
        whole.resize(next - moves.start + from_above, true);
        let mut end = from_above;
        if stopped.is_some() {
            // The more often it stops, the more moves are looked at line by line before it is tried again.
            end = count.min(from_above + singly);
            singly = if from_above < singly { (2 * singly).min(BATCH) } else { 1 };
            effects.extend(batch.cut_in_order(stock, &frame, from_above..end, progress));
            whole.resize(next - moves.start + end, false);
            size = (size / 2).max(2 * singly);
        } else {
            size = (4 * size).min(MOST);
            singly = 1;
        }
        still_wanted(progress)?;
        progress.advance(end as u64);
        next += end;
    }
    Ok(())
}
