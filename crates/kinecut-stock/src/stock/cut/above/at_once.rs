//! Many tasks over a patch, of which only the outcome counts: in any order, those first that go lowest.
//!
//! The outcome is that of taking them one after another: the least height of each line and ceiling, and of tasks that go equally low
//! the first. A block that has been cut to about its final height leaves nearly all other tasks out.
//!
//! The amounts that moves remove depend on the order: they are measured on some of the lines (`Field::sparse`), no more than a quarter
//! of the radius of the thinnest tool apart.

use rayon::prelude::*;

use super::super::body::ConvexPart;
use super::super::effect::Looked;
use super::super::task::Task;
use super::Done;
use super::field::Field;
use super::patch::{BLOCKS, Patch, Planes, ROUNDING, bodies, lowered};
use super::sweep::Sweep;
use crate::base::Progress;

/// Distances of the lines on which amounts are measured, to a radius of the tool.
const LINES: f64 = 4.0;

/// Largest stride of these lines: as long as an edge of a tile.
const MOST_STRIDE: f64 = 16.0;

/// Stride of the lines on which amounts are measured; 1 where all are needed.
pub(in crate::stock::cut) fn stride(tasks: &[Task], step: f64) -> i64 {
    let cutting = tasks.iter().filter(|task| !task.watch);
    let radius = cutting.map(|task| task.tool.cutting.radius).fold(f64::INFINITY, f64::min);
    (radius / (LINES * step)).clamp(1.0, MOST_STRIDE) as i64
}

/// Measures what tasks remove, one after another, on the lines of a sparse field.
pub(super) fn measure(field: &Field, tasks: &[Task], progress: &dyn Progress) -> Vec<Vec<Done>> {
    let bins = field.bins(tasks);
    let one = |(p, bin): (usize, &Vec<u32>)| {
        let mut patch = Patch::new(field, p, None).with_lines(field);
        let mut all = Vec::new();
        for index in bin {
            let task = &tasks[*index as usize];
            if task.watch || progress.cancelled() {
                continue;
            }
            let mut done = Done { task: *index, removed: 0, deepest: 0, first: None };
            patch.cut(field, task, &mut done);
            if done.removed > 0 || done.first.is_some() {
                done.removed *= field.stride * field.stride;
                all.push(done);
            }
        }
        all
    };
    bins.par_iter().enumerate().with_max_len(1).filter(|(_, bin)| !bin.is_empty()).map(one).collect()
}

/// Whether only the outcome of a task counts in a patch with material up to a height: it takes all above its underside, or is known to
/// meet nothing, and what does not cut stays above.
pub(super) fn is_plain(task: &Task, highest: f64) -> bool {
    let tip = task.tip_range().0;
    let cuts = || {
        let reaches = |part: &ConvexPart| tip + part.top >= highest;
        task.removes && task.tool.hollow.is_none() && task.tool.cutting.parts.iter().all(reaches)
    };
    let is_above = |bottom: f64| tip + bottom - lowered(task) >= highest + ROUNDING;
    let mut asked = bodies(task).filter(|(_, looked)| *looked != Looked::Cutting);
    (task.free || !task.watch && cuts()) && asked.all(|(body, _)| is_above(body.bottom))
}

/// A task's part with its bounds on the blocks of a patch.
struct Bounded<'a, 't> {
    index: u32,
    task: &'a Task<'t>,
    part: &'t ConvexPart,
    bounds: [f64; BLOCKS],
}

impl<'t> Bounded<'_, 't> {
    fn sweep(&self) -> Sweep<'t> {
        Sweep::new(self.task, self.part)
    }
}

/// Lets tasks of a run go over a patch: each takes all above its underside.
pub(super) fn cut(patch: &mut Patch, group: &[u32], tasks: &[Task]) {
    let mut all: Vec<Bounded> = Vec::with_capacity(group.len());
    for index in group {
        let task = &tasks[*index as usize];
        // One that is watched meets nothing.
        let parts = if task.watch { &[][..] } else { &task.tool.cutting.parts };
        for part in parts {
            let bounds = patch.bounds(&Sweep::new(task, part));
            if !patch.open_to(&bounds, f64::from(*index)).is_empty() {
                all.push(Bounded { index: *index, task, part, bounds });
            }
        }
    }
    // First the one that may go lowest in each block.
    let mut lowest = [None::<(usize, f64)>; BLOCKS];
    for (i, one) in all.iter().enumerate() {
        for (lowest, bound) in lowest.iter_mut().zip(one.bounds) {
            if lowest.is_none_or(|(_, least)| bound < least) {
                *lowest = Some((i, bound));
            }
        }
    }
    let mut first: Vec<usize> = lowest.iter().flatten().map(|(i, _)| *i).collect();
    first.sort_unstable();
    first.dedup();
    let go = |patch: &mut Patch, one: &Bounded, planes: Option<&Planes>| {
        let index = f64::from(one.index);
        let mut open = patch.open_to(&one.bounds, index);
        if let Some(planes) = planes.filter(|_| !open.is_empty()) {
            let slack = |block| patch.slack(block, index);
            open = patch.open_by_planes(planes, open, slack);
            open = patch.open_by_lines(planes, open, slack);
        }
        if !open.is_empty() {
            patch.sink(&one.sweep(), open, index, false);
            patch.lower(open);
        }
    };
    first.iter().for_each(|i| go(patch, &all[*i], None));
    // Then those that may go deepest below what is there, as far as they still may.
    patch.keep_covers(false);
    let mut rest: Vec<(f64, u32)> = Vec::new();
    let mut below: Vec<(&Bounded, Planes)> = Vec::new();
    let mut done = first.iter().peekable();
    for (i, one) in all.iter().enumerate() {
        let index = f64::from(one.index);
        let open = patch.open_to(&one.bounds, index);
        if done.next_if_eq(&&i).is_some() || open.is_empty() {
            continue;
        }
        let planes = patch.planes(&one.sweep());
        let open = patch.open_by_planes(&planes, open, |block| patch.slack(block, index));
        if !open.is_empty() {
            rest.push((patch.depth(&planes, open), below.len() as u32));
            below.push((one, planes));
        }
    }
    // Of equal ones the first.
    rest.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for (_, next) in rest {
        let (one, planes) = &below[next as usize];
        go(patch, one, Some(planes));
    }
}
