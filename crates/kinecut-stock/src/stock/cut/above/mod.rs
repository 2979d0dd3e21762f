//! Upright moves that take all above their underside: most of milling.
//!
//! Along the tool axis only the lowest pass over each line matters. Tasks go over patches of lines in order (`patch.rs`), in
//! blocks of lines at once (`sweep.rs`); then each line is cut once, by the task that went lowest. Across the axis each way
//! between two neighbouring lines has a ceiling, above which nothing is left; a task is taken past a line only where it may
//! come down below one (`claims.rs`), and what lies above is taken out in stretches (`sides.rs`). The lines are the same as
//! those of all tasks cut one after another.
//!
//! Material that a rapid, a shank or a holder may meet, an edge that leaves a core, or a top of a tool under material end the
//! run before that move: it is cut line by line, then the next run begins. Ceilings are kept for it: material never grows.

mod claims;
mod column;
mod field;
mod layers;
mod patch;
mod sides;
mod sweep;

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::DVec2;
use rayon::prelude::*;

use self::claims::Claim;
use self::field::{Field, Line};
use self::layers::Layers;
use self::patch::{Patch, PatchCeilings};
use super::CutAxis;
use super::axis::ToolFrame;
use super::task::{Task, TileLines};
use super::tile_axial::cut_above;
use crate::base::Progress;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{DexelGrid, Lattice, TriDexel};

/// Heights above which nothing is left on the ways between the lines along one tool axis.
#[derive(Clone, Debug)]
pub(in crate::stock) struct Ceilings {
    axis: CutAxis,
    /// By patch; `None` where they are as high as the stock.
    patches: Vec<Option<Box<PatchCeilings>>>,
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
    /// Lines that were cut, each with the task that went lowest.
    cut: Vec<(Line, u32)>,
    done: Vec<Done>,
    ceilings: Box<PatchCeilings>,
    claims: [Vec<Claim>; 2],
}

/// Cuts tasks, in order, up to the first move that has to be looked at line by line; returns its index, and tells by `each` what
/// tasks did, those of one move one after another in no order. Nothing but whole moves is cut.
pub(super) fn cut_from_above(
    stock: &mut TriDexel,
    (axis, frame): (CutAxis, &ToolFrame),
    tasks: &[Task],
    progress: &dyn Progress,
    mut each: impl FnMut(&Done),
) -> Option<u32> {
    let lattice = *stock.lattice();
    let bounds = stock.bounds();
    let along = frame.axes[2].index();
    let highest = if frame.sign > 0.0 { bounds.max[along] } else { -bounds.min[along] };
    let mut ceilings = match stock.ceilings.take() {
        Some(kept) if kept.axis == axis => kept,
        _ => Ceilings { axis, patches: Vec::new() },
    };
    let field = Field::new(&stock.grids[along], &lattice, frame, highest);
    let patches = field.patches();
    ceilings.patches.resize_with(patches[0] * patches[1], || None);
    let bins = field.bins(tasks);
    let layers = Layers::new(&lattice, frame);
    let run = |patches: &mut dyn Iterator<Item = usize>, limit: &AtomicU32| -> Vec<(usize, Outcome)> {
        let patches: Vec<usize> = patches.collect();
        let one = |patch: usize| {
            let (bin, known) = (&bins[patch], ceilings.patches[patch].as_deref());
            Some((patch, pass(&field, (patch, known), (bin, tasks), &layers, limit, progress)?))
        };
        patches.into_par_iter().filter_map(one).collect()
    };
    let limit = AtomicU32::new(u32::MAX);
    let mut outcomes: Vec<Option<Outcome>> = Vec::new();
    outcomes.resize_with(bins.len(), || None);
    for (patch, outcome) in run(&mut (0..bins.len()).filter(|p| !bins[*p].is_empty()), &limit) {
        outcomes[patch] = Some(outcome);
    }
    let stopped = limit.load(Relaxed);
    if stopped == 0 || progress.cancelled() {
        stock.ceilings = Some(ceilings);
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
    for done in outcomes.iter().flatten().flat_map(|o| &o.done) {
        each(done);
    }
    cut_lines(stock, &lattice, along, tasks, &mut outcomes);
    for grid in &mut stock.grids {
        if grid.axis != frame.axes[2] {
            sides::cut_sides(grid, (&lattice, frame), tasks, (&mut outcomes, &ceilings), patches, progress);
        }
    }
    for (kept, outcome) in ceilings.patches.iter_mut().zip(outcomes) {
        if let Some(outcome) = outcome {
            *kept = Some(outcome.ceilings);
        }
    }
    stock.ceilings = Some(ceilings);
    (stopped < u32::MAX).then_some(stopped)
}

/// Takes the tasks of a bin over a patch, up to a limit of moves that is lowered to a move which has to be looked at line by
/// line: then there is no outcome, nor when it was cancelled.
fn pass(
    field: &Field,
    (patch, known): (usize, Option<&PatchCeilings>),
    (bin, tasks): (&[u32], &[Task]),
    layers: &Layers,
    limit: &AtomicU32,
    progress: &dyn Progress,
) -> Option<Outcome> {
    /// Tasks between two looks whether the caller still waits: a fraction of a millisecond.
    const LOOK: usize = 64;
    let mut patch = Patch::new(field, patch, known);
    let mut all = Vec::new();
    let mut end = bin.len();
    for (n, index) in bin.iter().enumerate() {
        if n % LOOK == 0 && progress.cancelled() {
            return None;
        }
        let task = &tasks[*index as usize];
        if task.index >= limit.load(Relaxed) {
            end = n;
            break;
        }
        let Some(done) = patch.take(field, *index, task) else {
            limit.fetch_min(task.index, Relaxed);
            return None;
        };
        if done.removed > 0 || done.first.is_some() {
            all.push(done);
        }
    }
    let ceilings = patch.keep_ceilings();
    let mut claims = [Vec::new(), Vec::new()];
    for (n, index) in bin[..end].iter().enumerate() {
        if n % LOOK == 0 && progress.cancelled() {
            return None;
        }
        let task = &tasks[*index as usize];
        if !task.watch {
            patch.claim(layers, *index, task, &mut claims);
        }
    }
    let cut = patch.cut_lines(field);
    Some(Outcome { cut, done: all, ceilings, claims })
}

/// Cuts the lines along the tool axis, each by one task.
fn cut_lines(
    stock: &mut TriDexel,
    lattice: &Lattice,
    along: usize,
    tasks: &[Task],
    outcomes: &mut [Option<Outcome>],
) {
    let grid = &mut stock.grids[along];
    let mut of_tile: Vec<Vec<(usize, u32)>> = vec![Vec::new(); grid.tiles.len()];
    for outcome in outcomes.iter_mut().flatten() {
        for ((tile, line), task) in std::mem::take(&mut outcome.cut) {
            of_tile[tile].push((line, task));
        }
    }
    let empty = Grid { axis: grid.axis, counts: grid.counts, tiles: Vec::new() };
    let work = grid.tiles.par_iter_mut().zip(&of_tile).enumerate().filter(|(_, (_, list))| !list.is_empty());
    work.for_each(|(t, (tile, list))| {
        let places = TileLines::new(&empty, lattice, t);
        for (line, task) in list {
            let task = &tasks[*task as usize];
            let edge = TILE_EDGE as usize;
            let (p, q) = (places.at[0][line % edge], places.at[1][line / edge]);
            let over = if task.frame.sign < 0.0 { DVec2::new(q, p) } else { DVec2::new(p, q) };
            cut_above(tile, *line, over, task);
        }
    });
}
