//! Lines that are cut late: those across the tool axis, and who is to cut them.
//!
//! Moves that were cut from above owe these lines. They are paid by rectangles of patches: all that is owed on the ways within, by all
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
use super::ceilings::KeptCeilings;
use super::field::{Field, OWN};
use super::known::KnownCeilings;
use super::layers::Layers;
use super::owed::Owed;
use super::patch::Known;
use super::sides::{clear, cut_claims, direction};
use super::sweep::Sweep;
use super::tops::{self, Kept};
use crate::base::Progress;
use crate::geom::Aabb;
use crate::stock::sieve::Sieve;
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
    /// By patch: the number of moves that have been paid on its ways.
    paid: Vec<usize>,
    /// By direction of the lines, and patch: the ceilings above which the ways were cleared.
    cleared: [Vec<Known>; 2],
}

impl FromAbove {
    /// Nothing has been cut yet in a field of patches.
    pub(super) fn new(axis: CutAxis, patches: [usize; 2]) -> FromAbove {
        let all = patches[0] * patches[1];
        FromAbove {
            axis,
            ceilings: KnownCeilings::none(all),
            tops: vec![None; all],
            behind: false,
            across: patches[0],
            late: Late {
                debts: Vec::new(),
                count: 0,
                paid: vec![0; all],
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
        match self.is_across(axis) {
            true => !self.late.debts.is_empty(),
            false => self.behind,
        }
    }

    /// Whether lines along an axis of the stock run across the tool axis.
    pub(in crate::stock) fn is_across(&self, axis: Axis) -> bool {
        self.axis.along() != axis
    }

    /// What is known of the lines along the tool axis beside the grid.
    pub(in crate::stock) fn kept(&self) -> Kept<'_> {
        Kept { tops: &self.tops, across: self.across }
    }

    /// Coordinates between which the material of a line along the tool axis is left [fixed steps], as far as the grid does not know it.
    pub(in crate::stock) fn limits(&self, a: u32, b: u32) -> [i32; 2] {
        match (self.kept().top(a as usize, b as usize), self.axis.sign() > 0.0) {
            (None, _) => [i32::MIN, i32::MAX],
            (Some(top), true) => [i32::MIN, top],
            (Some(top), false) => [-top, i32::MAX],
        }
    }

    /// The same for the first lines of a row.
    pub(in crate::stock) fn limits_of_row(&self, b: u32, limits: &mut [[i32; 2]]) {
        let of_top = |top: Option<i32>| match (top, self.axis.sign() > 0.0) {
            (None, _) => [i32::MIN, i32::MAX],
            (Some(top), true) => [i32::MIN, top],
            (Some(top), false) => [-top, i32::MAX],
        };
        let (own, b) = (OWN as usize, b as usize);
        for (column, limits) in limits.chunks_mut(own).enumerate() {
            match &self.tops[b / own * self.across + column] {
                None => limits.fill(of_top(None)),
                Some(tops) => {
                    for (i, limits) in limits.iter_mut().enumerate() {
                        *limits = of_top(tops.top(b % own * own + i));
                    }
                }
            }
        }
    }

    /// All lines have been cut.
    pub(in crate::stock) fn owe_nothing(&mut self) {
        let late = &mut self.late;
        late.debts.clear();
        late.paid.fill(late.count);
        late.cleared.fill(self.ceilings.to_vec());
        self.owe_nothing_along();
    }

    /// Cuts all lines that are behind.
    pub(in crate::stock) fn settle(
        &mut self,
        grids: &mut [Grid; 3],
        stock: (&Lattice, Aabb),
        progress: &dyn Progress,
    ) {
        self.settle_along(&mut grids[self.axis.along().index()], stock.0, progress);
        if !self.late.debts.is_empty() && !progress.cancelled() {
            self.settle_across(grids, stock, progress);
            if !progress.cancelled() {
                self.owe_nothing();
            }
        }
    }

    /// Cuts the lines across the tool axis that are behind.
    pub(in crate::stock) fn settle_across(
        &mut self,
        grids: &mut [Grid; 3],
        stock: (&Lattice, Aabb),
        progress: &dyn Progress,
    ) {
        self.pay(grids, stock, |field| field.patches().map(|n| 0..n), progress);
    }

    /// The axis of the stock along which the tools stand.
    pub(in crate::stock) fn along(&self) -> Axis {
        self.axis.along()
    }

    /// All lines along the tool axis have been cut.
    pub(in crate::stock) fn owe_nothing_along(&mut self) {
        self.tops.fill(None);
        self.behind = false;
    }

    /// Cuts the lines along the tool axis that are behind.
    pub(in crate::stock) fn settle_along(
        &mut self,
        grid: &mut Grid,
        lattice: &Lattice,
        progress: &dyn Progress,
    ) {
        let all = [0..self.across, 0..self.tops.len().checked_div(self.across).unwrap_or(0)];
        let frame = ToolFrame::new(self.axis);
        tops::settle(grid, (lattice, &frame), (&mut self.tops, self.across), &all, &self.late, progress);
        self.behind &= progress.cancelled();
    }

    /// Cuts lines of a sieve by the moves that have still to do so: those along the axes named. `grids` have them as they are in the
    /// stock; `shape` is its grid along the tool axis.
    pub(in crate::stock) fn cut_sieved(
        &self,
        grids: &mut [Grid; 3],
        (sieve, shape, bounds): (&Sieve, &Grid, Aabb),
        along: bool,
        across: bool,
        progress: &dyn Progress,
    ) {
        let frame = ToolFrame::new(self.axis);
        if along {
            let grid = &mut grids[frame.axes[2].index()];
            tops::cut_behind(grid, (sieve, &frame), self.kept(), &|_| true, &self.late, progress);
        }
        if across {
            let field = Field::new(shape, sieve.whole(), &frame, bounds, None);
            let all = |patches: [usize; 2], paid: Vec<usize>| Open {
                patches,
                rectangle: patches.map(|n| 0..n),
                paid,
            };
            self.clear_across(grids, sieve, &all(field.patches(), self.late.paid.clone()), progress);
            // Paid again does no harm.
            let least = self.late.paid.iter().min().copied().unwrap_or(0);
            let highest = field.highest;
            let sparse = field.sparse(sieve.every());
            let [columns, rows] = sparse.patches();
            let open = all([columns, rows], vec![least; columns * rows]);
            let kept = KeptCeilings { ceilings: &self.ceilings, across: self.across, highest };
            let ceilings = kept.sparse(&sparse);
            self.claim_across(grids, (&sieve.lattice(), &sparse), (&open, &ceilings), progress);
        }
    }

    /// Cuts the lines of a rectangle of patches, as far as these reach.
    fn pay(
        &mut self,
        grids: &mut [Grid; 3],
        (lattice, bounds): (&Lattice, Aabb),
        rectangle: impl Fn(&Field) -> [Range<usize>; 2],
        progress: &dyn Progress,
    ) {
        let frame = ToolFrame::new(self.axis);
        let along = frame.axes[2];
        let shape = grids[along.index()].without_lines();
        let field = Field::new(&shape, lattice, &frame, bounds, None);
        let open =
            Open { patches: field.patches(), rectangle: rectangle(&field), paid: self.late.paid.clone() };
        let sieve = Sieve::all(lattice);
        self.clear_across(grids, &sieve, &open, progress);
        self.claim_across(grids, (lattice, &field), (&open, &self.ceilings), progress);
        if progress.cancelled() {
            // Cutting it once more does no harm.
            return;
        }
        for k in 0..2 {
            for patch in open.whole_lines(k).inside() {
                self.late.cleared[k][patch].clone_from(&self.ceilings[patch]);
            }
        }
        for patch in open.inside() {
            self.late.paid[patch] = self.late.count;
        }
    }

    /// Takes what lies above ceilings out of lines across the tool axis, those of a sieve, through some patches. It comes first, on whole
    /// lines: the rest of them is then short.
    fn clear_across(&self, grids: &mut [Grid; 3], sieve: &Sieve, open: &Open, progress: &dyn Progress) {
        let frame = ToolFrame::new(self.axis);
        let along = frame.axes[2];
        for grid in grids.iter_mut().filter(|grid| grid.axis != along) {
            let k = direction(grid.axis, &frame);
            let whole = open.whole_lines(k);
            clear(grid, (sieve, &frame), (&self.ceilings, &self.late.cleared[k]), &whole, progress);
        }
    }

    /// Cuts lines across the tool axis through patches of a field by the moves that these owe, as far as they come below ceilings.
    fn claim_across(
        &self,
        grids: &mut [Grid; 3],
        (lattice, field): (&Lattice, &Field),
        (open, ceilings): (&Open, &[Known]),
        progress: &dyn Progress,
    ) {
        let frame = ToolFrame::new(self.axis);
        let along = frame.axes[2];
        let layers = Layers::new(lattice, &frame);
        let first = open.inside().map(|patch| open.paid[patch]).min().unwrap_or(usize::MAX);
        let owed = |next: usize| {
            (next < self.late.count)
                .then(|| Owed::new(&self.late, next, &frame, (field, open, ceilings.len())))
        };
        let mut next = owed(first);
        while let Some(some) = next.take().filter(|_| !progress.cancelled()) {
            let cut = || {
                let claims = some.claims(field, ceilings, &layers, progress);
                let across = grids.par_iter_mut().filter(|grid| grid.axis != along);
                across.for_each(|grid| cut_claims(grid, (lattice, &frame), (&some.tasks, &claims), progress));
            };
            (_, next) = rayon::join(cut, || owed(some.end));
        }
    }
}

/// Patches that are paid.
pub(super) struct Open {
    /// Number of all patches along both directions.
    pub(super) patches: [usize; 2],
    /// Those that are paid.
    pub(super) rectangle: [Range<usize>; 2],
    /// By patch: the number of moves that have been paid before.
    paid: Vec<usize>,
}

impl Open {
    /// Index of a patch by its column and row.
    pub(super) fn patch(&self, [column, row]: [usize; 2]) -> usize {
        row * self.patches[0] + column
    }

    /// The indices of the patches.
    fn inside(&self) -> impl Iterator<Item = usize> + '_ {
        let [columns, rows] = &self.rectangle;
        rows.clone().flat_map(move |row| columns.clone().map(move |column| self.patch([column, row])))
    }

    /// The patches of all lines along a direction across the axis that run through those.
    fn whole_lines(&self, k: usize) -> Open {
        let mut whole = Open { rectangle: self.rectangle.clone(), paid: Vec::new(), ..*self };
        whole.rectangle[k] = 0..self.patches[k];
        whole
    }

    /// Whether a move is owed on the ways of a patch.
    pub(super) fn wants(&self, patch: usize, index: usize) -> bool {
        let place = [patch % self.patches[0], patch / self.patches[0]];
        self.paid[patch] <= index && (0..2).all(|k| self.rectangle[k].contains(&place[k]))
    }

    /// Whether another rectangle has some of the patches.
    fn meets(&self, other: &[Range<usize>; 2]) -> bool {
        (0..2).all(|k| self.rectangle[k].start < other[k].end && other[k].start < self.rectangle[k].end)
    }
}

impl Late {
    /// Number of all moves that were ever owed.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The list of a move that is owed, and its index there.
    pub(super) fn owed(&self, number: usize) -> Option<(&CutList, usize)> {
        let next = self.debts.partition_point(|debt| debt.first <= number);
        let debt = self.debts.get(next.checked_sub(1)?)?;
        let at = debt.moves.start + (number - debt.first);
        debt.moves.contains(&at).then_some((&*debt.list, at))
    }

    /// Tasks of the moves from one on that cut, and may reach open patches, as many as there is room for, with the numbers of their
    /// moves; and the first move after them.
    pub(super) fn tasks(
        &self,
        from: usize,
        frame: &ToolFrame,
        field: &Field,
        open: &Open,
    ) -> (Vec<Task<'_>>, usize) {
        let mut tasks = Vec::new();
        let start = self.debts.partition_point(|debt| debt.first + debt.moves.len() <= from);
        let (u, v) = frame.axes[2].others();
        let margin = 3.0 * field.step;
        let meets = |around: Aabb| {
            let ends = [around.min - margin, around.max + margin];
            let [min, max] = ends.map(|p| DVec2::new(p[u.index()], p[v.index()]));
            open.meets(&field.rectangle((min, max)))
        };
        for debt in &self.debts[start..] {
            for at in
                debt.list.near(debt.moves.start + from.saturating_sub(debt.first)..debt.moves.end, meets)
            {
                let index = debt.first + (at - debt.moves.start);
                if tasks.len() >= MOST {
                    return (tasks, index);
                }
                if !debt.list.moves[at].watch {
                    tasks_of(&debt.list, at, frame, index as u32, &mut tasks);
                }
            }
        }
        (tasks, self.count)
    }
}

/// Cuts the lines across the tool axis that are behind, as far as tasks may reach them.
pub(in crate::stock::cut) fn settle_near(stock: &mut TriDexel, tasks: &[Task], progress: &dyn Progress) {
    let (lattice, bounds) = (*stock.lattice(), stock.bounds());
    let Some(above) = &mut stock.above else { return };
    if above.late.debts.is_empty() {
        return;
    }
    let rectangle = |field: &Field| {
        let mut all: Option<[Range<usize>; 2]> = None;
        for task in tasks {
            let reach = task.tool.radius + 3.0 * lattice.step;
            let ends = [task.plan_box.0 - reach, task.plan_box.1 + reach];
            let near = field.rectangle(ends.map(|p| Sweep::exchanged(task, p)).into());
            let join = |k: usize, all: &[Range<usize>; 2]| {
                all[k].start.min(near[k].start)..all[k].end.max(near[k].end)
            };
            all = Some(all.map_or(near.clone(), |all| [join(0, &all), join(1, &all)]));
        }
        all.unwrap_or([0..0, 0..0])
    };
    let (frame, along) = (ToolFrame::new(above.axis), above.axis.along().index());
    let near = {
        let shape = stock.grids[along].without_lines();
        rectangle(&Field::new(&shape, &lattice, &frame, bounds, None))
    };
    let tops = (&mut above.tops[..], above.across);
    tops::settle(&mut stock.grids[along], (&lattice, &frame), tops, &near, &above.late, progress);
    above.pay(&mut stock.grids, (&lattice, bounds), |_| near.clone(), progress);
}
