//! Upright moves that take all above their underside: most of milling.
//!
//! Along the tool axis only the lowest pass over each line matters. Tasks go over patches of lines in order (`patch.rs`), in
//! blocks of lines at once (`sweep.rs`); then each line is cut once, by the task that went lowest. Across the axis each way
//! between two neighbouring lines has a ceiling, above which nothing is left; a task is taken past a line only where it may
//! come down below one (`claims.rs`), and what lies above is taken out in stretches (`sides.rs`). The lines are the same as
//! those of all tasks cut one after another.
//!
//! A move that should meet nothing, and goes down below the top of the stock, is no part of a run: it is looked at by itself. Material
//! that a shank or a holder may meet, an edge that leaves a core, or a top of a tool under material end a run before that move: it is cut line by line, then the next run begins. Ceilings are kept for it: material never grows.
//!
//! All lines are cut late, by all moves since the last time together: where a move is looked at line by line those near it, and all
//! when something asks for them. Of the lines along the axis a height and a move are kept (`tops.rs`); for those across it, the lower
//! the ceilings have become, the less is left to do (`late.rs`): so many moves at once (`owed.rs`), which claim lines by patch
//! (`gathered.rs`). What is kept is packed: heights count from a plane and moves from a list by patch (`narrow.rs`, `movers.rs`), ceilings
//! from their neighbours (`packed.rs`) until they are read (`known.rs`).

mod at_once;
mod ceilings;
mod claims;
mod column;
mod field;
mod gathered;
mod known;
mod late;
mod layers;
mod movers;
mod narrow;
mod owed;
mod packed;
mod patch;
mod round;
mod sides;
mod sweep;
mod tops;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use self::field::Field;
use self::known::{KnownCeilings, NewCeilings};
use self::late::Late;
use self::movers::Mover;
use self::patch::Patch;
use self::tops::Tops;
use super::CutAxis;
use super::axis::ToolFrame;
use super::task::Task;
use crate::base::Progress;
use crate::stock::{DexelGrid, TriDexel};

pub(super) use self::at_once::stride;
pub(super) use self::late::settle_near;

/// Ceilings from cutting along one axis, and the moves that still owe lines across it.
#[derive(Clone, Debug)]
pub(in crate::stock) struct FromAbove {
    axis: CutAxis,
    /// By patch, heights above which nothing is left on the ways between lines; `None` where they are as high as the stock.
    ceilings: KnownCeilings,
    /// By patch, the heights of lines along the axis that are to be cut.
    tops: Vec<Option<Box<Tops>>>,
    /// There may be some.
    behind: bool,
    /// Number of patches along the first direction.
    across: usize,
    late: Late,
}

/// What a task did in a patch.
#[derive(Clone, Copy, Debug)]
pub(in crate::stock::cut) struct Done {
    /// Index of the task.
    pub(in crate::stock::cut) task: u32,
    /// Length removed on all lines [fixed steps].
    pub(in crate::stock::cut) removed: i64,
    /// As [`MoveEffect::deepest`](super::MoveEffect::deepest) [fixed steps].
    pub(in crate::stock::cut) deepest: i64,
    /// A contact: fraction of the move and point of the stock.
    pub(in crate::stock::cut) first: Option<(f64, [f64; 3])>,
}

/// The outcome of a run in a patch.
struct Outcome {
    /// All lines that are cut late: by tasks, and before.
    tops: Box<Tops>,
    done: Vec<Done>,
    ceilings: NewCeilings,
}

/// Cuts tasks, in order, up to the first move that has to be looked at line by line; returns its index, and tells by `each` what
/// tasks did, those of one move one after another in no order. Nothing but whole moves is cut. With a stride the tasks are cut at once, and
/// their amounts measured on lines that far apart.
pub(super) fn cut_from_above(
    stock: &mut TriDexel,
    (axis, frame): (CutAxis, &ToolFrame),
    (tasks, stride): (&[Task], Option<i64>),
    progress: &dyn Progress,
    mut each: impl FnMut(&Done),
) -> Option<u32> {
    let lattice = *stock.lattice();
    let along = frame.axes[2].index();
    let taken = stock.above.take().filter(|above| above.axis == axis);
    let shape = Field::new(&stock.grids[along], &lattice, frame, stock.bounds(), None);
    let mut above = taken.unwrap_or_else(|| FromAbove::new(axis, shape.patches()));
    let field = Field::new(&stock.grids[along], &lattice, frame, stock.bounds(), Some(above.kept()));
    let bins = field.bins(tasks);
    // The moves of the tasks are owed next.
    let (first, pieces) = (above.late.count() as u32, tops::pieces(tasks));
    let of = |task: u32| (first + tasks[task as usize].index, pieces[task as usize]);
    let run = |patches: &mut dyn Iterator<Item = usize>, limit: &AtomicU32| -> Vec<(usize, Outcome)> {
        let patches: Vec<usize> = patches.collect();
        let one = |patch: usize| {
            let work = (&bins[patch][..], tasks, stride.is_some());
            Some((patch, pass((&field, &above), patch, work, &of, limit, progress)?))
        };
        patches.into_par_iter().with_max_len(1).filter_map(one).collect()
    };
    let limit = AtomicU32::new(u32::MAX);
    let mut outcomes: Vec<Option<Outcome>> = Vec::new();
    outcomes.resize_with(bins.len(), || None);
    for (patch, outcome) in run(&mut (0..bins.len()).filter(|p| !bins[*p].is_empty()), &limit) {
        outcomes[patch] = Some(outcome);
    }
    let stopped = limit.load(Relaxed);
    if stopped == 0 || progress.cancelled() {
        stock.above = Some(above);
        return Some(0);
    }
    if stopped < u32::MAX {
        // Where nothing comes after the move at which it stopped, the outcome is what it would be.
        let end = tasks.partition_point(|t| t.index < stopped) as u32;
        let again = |p: &usize| bins[*p].last().is_some_and(|last| *last >= end);
        for (_, outcome) in outcomes.iter_mut().enumerate().filter(|(p, _)| again(p)) {
            *outcome = None;
        }
        let some = |p: &usize| again(p) && bins[*p][0] < end;
        for (patch, outcome) in run(&mut (0..bins.len()).filter(some), &AtomicU32::new(stopped)) {
            outcomes[patch] = Some(outcome);
        }
    }
    if let Some(stride) = stride {
        let end = tasks.partition_point(|t| t.index < stopped);
        let all = at_once::measure(&field.sparse(stride), &tasks[..end], progress);
        all.iter().flatten().for_each(&mut each);
    }
    for done in outcomes.iter().flatten().flat_map(|o| &o.done) {
        each(done);
    }
    for (patch, outcome) in outcomes.into_iter().enumerate() {
        if let Some(outcome) = outcome {
            above.ceilings.set(patch, outcome.ceilings);
            above.tops[patch] = Some(outcome.tops);
            above.behind = true;
        }
    }
    stock.above = Some(above);
    (stopped < u32::MAX).then_some(stopped)
}

/// Whether tasks that should meet nothing are known to do so by the heights of the lines and the ceilings between them.
pub(super) fn are_clear(stock: &TriDexel, (axis, frame): (CutAxis, &ToolFrame), tasks: &[Task]) -> bool {
    let along = frame.axes[2].index();
    let above = stock.above.as_ref().filter(|above| above.axis == axis);
    let kept = above.map(FromAbove::kept);
    let field = Field::new(&stock.grids[along], stock.lattice(), frame, stock.bounds(), kept);
    let mut near: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    field.each_near(tasks, |patch, task| near.entry(patch).or_default().push(task));
    let is_clear = |(patch, bin): (&usize, &Vec<u32>)| {
        let known = above.and_then(|above| above.ceilings.of(*patch));
        let patch = Patch::new(&field, *patch, known.as_deref()).with_lines(&field);
        !bin.iter().any(|task| patch.is_unclear(&tasks[*task as usize]))
    };
    near.iter().all(is_clear)
}

/// Takes the tasks of a bin over a patch, up to a limit of moves that is lowered to a move which has to be looked at line by
/// line: then there is no outcome, nor when it was cancelled. `of` is the number of a task's move, and its piece.
fn pass(
    (field, above): (&Field, &FromAbove),
    number: usize,
    (bin, tasks, at_once): (&[u32], &[Task], bool),
    of: &dyn Fn(u32) -> Mover,
    limit: &AtomicU32,
    progress: &dyn Progress,
) -> Option<Outcome> {
    /// Tasks between two looks whether the caller still waits: a fraction of a millisecond.
    const LOOK: usize = 64;
    let known = above.ceilings.of(number);
    let mut patch = Patch::new(field, number, known.as_deref()).with_lines(field);
    let mut all = Vec::new();
    let (mut next, mut looked) = (0, 0);
    while next < bin.len() {
        if next >= looked {
            if progress.cancelled() {
                return None;
            }
            looked = next + LOOK;
        }
        if at_once {
            let (highest, end) = (patch.highest(), limit.load(Relaxed));
            let is_plain = |index: &&u32| {
                let task = &tasks[**index as usize];
                task.index < end && at_once::is_plain(task, highest)
            };
            let group = bin[next..].iter().take_while(is_plain).count();
            if group > 0 {
                at_once::cut(&mut patch, &bin[next..next + group], tasks);
                next += group;
                continue;
            }
        }
        let index = bin[next];
        let task = &tasks[index as usize];
        if task.index >= limit.load(Relaxed) {
            break;
        }
        let Some(done) = patch.take(field, index, task) else {
            limit.fetch_min(task.index, Relaxed);
            return None;
        };
        if !at_once && (done.removed > 0 || done.first.is_some()) {
            all.push(done);
        }
        next += 1;
    }
    if at_once {
        all = patch.left(field, tasks);
    }
    let ceilings = above.ceilings.form(patch.kept_ceilings());
    let tops = Box::new(patch.cut_tops(above.tops[number].as_deref(), of));
    Some(Outcome { tops, done: all, ceilings })
}
