//! Moves of tools that stand along one axis: in long runs from above, and line by line where a move has to be looked at so.

use super::above::{Done, cut_from_above};
use super::axis::ToolFrame;
use super::effect::Sum;
use super::hollow::standing;
use super::in_order::cut_in_order;
use super::piece::pieces;
use super::run::{BATCH, Order};
use super::task::{Task, Tool};
use super::{CutAxis, CutMove, CutOptions, MoveEffect};
use crate::base::{Code, Finding, Progress, Result};
use crate::stock::{DexelGrid, FIXED_STEP, TriDexel};

/// Moves that are cut from above at once: bounds the memory of their lists.
const MOST: usize = 32_768;

/// Tasks that are cut from above at once, as one move may have many.
const MOST_TASKS: usize = 65_536;

/// Moves of one tool axis made ready.
struct Batch<'a> {
    tasks: Vec<Task<'a>>,
    /// By move: how far its path was replaced [mm].
    errors: Vec<f64>,
    /// By move: a hollow tool is cut as if it were none.
    filled: Vec<bool>,
}

impl<'a> Batch<'a> {
    /// Of moves before `first_cut`, as many as there is room for.
    fn new(
        moves: &[CutMove],
        frame: &ToolFrame,
        tools: &'a [Tool],
        options: &CutOptions,
        step: f64,
    ) -> Batch<'a> {
        let mut batch = Batch { tasks: Vec::new(), errors: Vec::new(), filled: Vec::new() };
        for (i, m) in moves.iter().enumerate() {
            if batch.tasks.len() >= MOST_TASKS {
                break;
            }
            let tool = &tools[m.body as usize];
            let (list, error) = pieces(&m.curve, frame, options.path_tolerance);
            let filled = tool.hollow.is_some() && list.iter().any(|piece| standing(&piece.plan).is_none());
            batch.errors.push(error);
            batch.filled.push(filled);
            batch.tasks.extend(list.into_iter().map(|piece| Task {
                piece,
                index: i as u32,
                cut: options.first_cut.wrapping_add(i as u32).wrapping_add(1),
                removes: m.removes,
                watch: m.watch || tool.hollow.is_some() && standing(&piece.plan).is_none(),
                frame: *frame,
                tool,
                clearance: options.clearance,
                step,
                plan_box: piece.plan.bounds(),
            }));
        }
        batch
    }

    /// The tasks of a range of moves.
    fn tasks_of(&self, moves: std::ops::Range<usize>) -> &[Task<'a>] {
        let at = |index: usize| self.tasks.partition_point(|t| (t.index as usize) < index);
        &self.tasks[at(moves.start)..at(moves.end)]
    }
}

/// Cuts moves of tools that stand along an axis, and adds their effects.
pub(super) fn cut_upright(
    stock: &mut TriDexel,
    (axis, order): (CutAxis, Order),
    tools: &[Tool],
    moves: &[CutMove],
    options: &CutOptions,
    effects: &mut Vec<MoveEffect>,
    progress: &dyn Progress,
) -> Result<()> {
    let (frame, step) = (ToolFrame::new(axis), stock.lattice().step);
    let (mut next, mut size, mut singly) = (0, BATCH, 1);
    while next < moves.len() {
        let first_cut = options.first_cut.wrapping_add(effects.len() as u32);
        let options = CutOptions { first_cut, ..*options };
        let some = &moves[next..moves.len().min(next + size)];
        let batch = Batch::new(some, &frame, tools, &options, step);
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
            Order::InRuns => cut_from_above(stock, (axis, &frame), &batch.tasks, progress, &mut note),
            #[cfg(test)]
            Order::OneByOne => Some(0),
        };
        let from_above = stopped.map_or(count, |index| index as usize);
        effects.extend(sums[..from_above].iter().zip(&batch.errors).map(
            |((removed, deepest, first), error)| MoveEffect {
                removed: *removed as f64 * FIXED_STEP * step * step,
                deepest: *deepest as f64 * FIXED_STEP,
                first_contact: first.map(|(_, point)| point),
                path_error: *error,
                ..MoveEffect::default()
            },
        ));
        let mut end = from_above;
        if stopped.is_some() {
            // The more often it stops, the more moves are looked at line by line before it is tried again.
            end = count.min(from_above + singly);
            singly = if from_above < singly { (2 * singly).min(BATCH) } else { 1 };
            let mut sums: Vec<Sum> = (from_above..end).map(|_| Sum::new(false)).collect();
            let mut tasks = batch.tasks_of(from_above..end).to_vec();
            for task in &mut tasks {
                task.index -= from_above as u32;
            }
            cut_in_order(stock, &frame, &tasks, &mut sums, progress);
            let told = sums.iter().zip(&batch.errors[from_above..]).zip(&batch.filled[from_above..]);
            effects.extend(told.map(|((sum, error), filled)| sum.effect(step, *error, *filled)));
            size = (size / 2).max(2 * singly);
        } else {
            size = (2 * size).min(MOST);
            singly = 1;
        }
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "cutting was cancelled").into());
        }
        progress.advance(end as u64);
        next += end;
    }
    Ok(())
}
