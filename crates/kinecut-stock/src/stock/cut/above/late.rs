//! Lines across the tool axis that are cut late.
//!
//! Moves that were cut from above owe these lines. They are paid by bands of patches: all that is owed on the lines of a band, by all
//! moves since the last time, at the ceilings of today.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec2;
use rayon::prelude::*;

use super::super::CutAxis;
use super::super::axis::ToolFrame;
use super::super::list::CutList;
use super::super::task::Task;
use super::super::upright::tasks_of;
use super::FromAbove;
use super::claims::Claim;
use super::field::Field;
use super::layers::Layers;
use super::patch::{Known, Patch};
use super::sides::{clear, cut_claims, direction};
use super::sweep::Sweep;
use crate::base::Progress;
use crate::geom::Aabb;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel};

/// Moves that are paid at once: bounds the memory of their claims.
const MOST: usize = 16_384;

/// Moves that were cut from above, one after another.
#[derive(Clone, Debug)]
struct Debt {
    list: Arc<CutList>,
    moves: Range<usize>,
    /// Number of moves owed before them.
    first: usize,
}

/// The lines across the tool axis, and how far they are behind.
#[derive(Clone, Debug)]
pub(super) struct Late {
    debts: Vec<Debt>,
    /// Number of all moves that were ever owed.
    count: usize,
    /// By direction of the lines, and band: the number of moves that have been paid.
    paid: [Vec<usize>; 2],
    /// By direction and patch: the ceilings at that time, above which the lines were cleared.
    cleared: [Vec<Known>; 2],
}

impl FromAbove {
    /// Nothing has been cut yet in a field of patches.
    pub(super) fn new(axis: CutAxis, patches: [usize; 2]) -> FromAbove {
        let all = patches[0] * patches[1];
        FromAbove {
            axis,
            ceilings: vec![None; all],
            late: Late {
                debts: Vec::new(),
                count: 0,
                // Lines along the first direction lie in rows of patches, those along the second in columns.
                paid: [vec![0; patches[1]], vec![0; patches[0]]],
                cleared: [vec![None; all], vec![None; all]],
            },
        }
    }

    /// Whether it is about tools along an axis.
    pub(in crate::stock) fn is_along(&self, axis: CutAxis) -> bool {
        self.axis == axis
    }

    /// Notes moves that were cut from above.
    pub(in crate::stock::cut) fn owe(&mut self, list: &Arc<CutList>, moves: Range<usize>) {
        let late = &mut self.late;
        if moves.is_empty() {
            return;
        }
        let first = late.count;
        late.count += moves.len();
        match late.debts.last_mut() {
            Some(last) if Arc::ptr_eq(&last.list, list) && last.moves.end == moves.start => {
                last.moves.end = moves.end;
            }
            _ => late.debts.push(Debt { list: Arc::clone(list), moves, first }),
        }
    }

    /// Whether moves have still to cut lines along an axis of the stock.
    pub(in crate::stock) fn owes(&self, axis: Axis) -> bool {
        !self.late.debts.is_empty() && self.axis.along() != axis
    }

    /// All lines have been cut.
    pub(in crate::stock) fn owe_nothing(&mut self) {
        let late = &mut self.late;
        late.debts.clear();
        for k in 0..2 {
            late.paid[k].fill(late.count);
            late.cleared[k].clone_from(&self.ceilings);
        }
    }

    /// Cuts all lines that are behind.
    pub(in crate::stock) fn settle(
        &mut self,
        grids: &mut [Grid; 3],
        stock: (&Lattice, Aabb),
        progress: &dyn Progress,
    ) {
        if !self.late.debts.is_empty() {
            let all = self.late.paid.each_ref().map(|paid| 0..paid.len());
            self.pay(grids, stock, all, progress);
            if !progress.cancelled() {
                self.owe_nothing();
            }
        }
    }

    /// Cuts the lines of some bands: of lines along the first direction across the axis, and of those along the second.
    fn pay(
        &mut self,
        grids: &mut [Grid; 3],
        (lattice, bounds): (&Lattice, Aabb),
        bands: [Range<usize>; 2],
        progress: &dyn Progress,
    ) {
        let frame = ToolFrame::new(self.axis);
        let along = frame.axes[2];
        let shape = grids[along.index()].without_lines();
        let field = Field::new(&shape, lattice, &frame, bounds);
        let patches = field.patches();
        let open = Open { patches, bands, paid: &self.late.paid };
        let mut next = open.first();
        while next < self.late.count && !progress.cancelled() {
            let (tasks, end) = self.late.tasks(next, &frame, &(&field, &open));
            next = end;
            let mut claims = self.claims(&field, &open, &tasks, &Layers::new(lattice, &frame), progress);
            for grid in grids.iter_mut().filter(|grid| grid.axis != along) {
                let claims = std::mem::take(&mut claims[direction(grid.axis, &frame)]);
                cut_claims(grid, (lattice, &frame), (&tasks, claims), progress);
            }
        }
        for grid in grids.iter_mut().filter(|grid| grid.axis != along) {
            let k = direction(grid.axis, &frame);
            let ceilings = (&self.ceilings[..], &self.late.cleared[k][..]);
            clear(grid, (lattice, &frame), ceilings, (patches, &open.bands[k]), progress);
        }
        if progress.cancelled() {
            // What was cut may be cut again.
            return;
        }
        let Open { bands, .. } = open;
        for (k, bands) in bands.into_iter().enumerate() {
            for band in bands {
                self.late.paid[k][band] = self.late.count;
                for q in 0..patches[k] {
                    let patch = if k == 0 { band * patches[0] + q } else { q * patches[0] + band };
                    self.late.cleared[k][patch].clone_from(&self.ceilings[patch]);
                }
            }
        }
    }

    /// What tasks claim on lines of open bands, by direction.
    fn claims(
        &self,
        field: &Field,
        open: &Open,
        tasks: &[Task],
        layers: &Layers,
        progress: &dyn Progress,
    ) -> [Vec<Claim>; 2] {
        let mut bins: Vec<Vec<u32>> = vec![Vec::new(); self.ceilings.len()];
        field.each_near(tasks, |patch, i| {
            if open.wants(patch, tasks[i as usize].index as usize) != [false; 2] {
                bins[patch].push(i);
            }
        });
        let work = bins.par_iter().enumerate().filter(|(_, bin)| !bin.is_empty());
        let all: Vec<[Vec<Claim>; 2]> = work
            .map(|(p, bin)| {
                let mut claims = [Vec::new(), Vec::new()];
                let mut patch = Patch::new(field, p, self.ceilings[p].as_deref());
                for i in bin {
                    if progress.cancelled() {
                        break;
                    }
                    let task = &tasks[*i as usize];
                    patch.claim(layers, (*i, task), open.wants(p, task.index as usize), &mut claims);
                }
                claims
            })
            .collect();
        [0, 1].map(|k| all.iter().flat_map(|claims| &claims[k]).copied().collect())
    }
}

/// Bands of patches that are paid.
struct Open<'a> {
    patches: [usize; 2],
    /// Of lines along the first direction across the axis, and along the second.
    bands: [Range<usize>; 2],
    paid: &'a [Vec<usize>; 2],
}

impl Open<'_> {
    /// The first move that is owed.
    fn first(&self) -> usize {
        let least = |k: usize| self.paid[k][self.bands[k].clone()].iter().copied().min();
        least(0).into_iter().chain(least(1)).min().unwrap_or(usize::MAX)
    }

    /// Whether a move is owed on the lines of a patch, by direction.
    fn wants(&self, patch: usize, index: usize) -> [bool; 2] {
        let band = [patch / self.patches[0], patch % self.patches[0]];
        [0, 1].map(|k| self.bands[k].contains(&band[k]) && self.paid[k][band[k]] <= index)
    }

    /// Whether a box across the axis, in grid coordinates, reaches into one of the bands.
    fn meets(&self, field: &Field, within: (DVec2, DVec2)) -> bool {
        // Rows are counted along the second direction.
        let [columns, rows] = field.bands(within);
        let overlap = |a: &Range<usize>, b: &Range<usize>| a.start < b.end && b.start < a.end;
        overlap(&rows, &self.bands[0]) || overlap(&columns, &self.bands[1])
    }
}

impl Late {
    /// Tasks of the moves from one on that cut, and may reach open bands, as many as there is room for, with the numbers of their
    /// moves; and the first move after them.
    fn tasks(
        &self,
        from: usize,
        frame: &ToolFrame,
        (field, open): &(&Field, &Open),
    ) -> (Vec<Task<'_>>, usize) {
        let mut tasks = Vec::new();
        let start = self.debts.partition_point(|debt| debt.first + debt.moves.len() <= from);
        for debt in &self.debts[start..] {
            for at in debt.moves.start + from.saturating_sub(debt.first)..debt.moves.end {
                let index = debt.first + (at - debt.moves.start);
                if tasks.len() >= MOST {
                    return (tasks, index);
                }
                let one = &debt.list.moves[at];
                if one.watch {
                    continue;
                }
                let reach = debt.list.tools[one.body as usize].radius + 3.0 * field.step;
                let path = one.curve.bounds();
                let (u, v) = frame.axes[2].others();
                let ends = [path.min - reach, path.max + reach];
                let [min, max] = ends.map(|p| DVec2::new(p[u.index()], p[v.index()]));
                if open.meets(field, (min, max)) {
                    tasks_of(&debt.list, at, frame, index as u32, &mut tasks);
                }
            }
        }
        (tasks, self.count)
    }
}

/// Cuts the lines across the tool axis that are behind, as far as tasks may reach them.
pub(in crate::stock::cut) fn settle_near(
    stock: &mut TriDexel,
    frame: &ToolFrame,
    tasks: &[Task],
    progress: &dyn Progress,
) {
    let (lattice, bounds) = (*stock.lattice(), stock.bounds());
    let Some(above) = &mut stock.above else { return };
    let shape = stock.grids[frame.axes[2].index()].without_lines();
    let field = Field::new(&shape, &lattice, frame, bounds);
    let mut all: Option<[Range<usize>; 2]> = None;
    for task in tasks {
        // Bodies are looked at a little wider than they are.
        let reach = task.tool.radius + 3.0 * lattice.step;
        let ends = [task.plan_box.0 - reach, task.plan_box.1 + reach];
        let [columns, rows] = field.bands(ends.map(|p| Sweep::exchanged(task, p)).into());
        let join = |a: &Range<usize>, b: Range<usize>| a.start.min(b.start)..a.end.max(b.end);
        all = Some(match &all {
            None => [rows, columns],
            Some([a, b]) => [join(a, rows), join(b, columns)],
        });
    }
    if let Some(bands) = all
        && !above.late.debts.is_empty()
    {
        above.pay(&mut stock.grids, (&lattice, bounds), bands, progress);
    }
}
