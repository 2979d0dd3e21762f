//! Lines across the axis that leaning tools are near to: runs that are cut at once cut them when somebody reads them, brick by brick.
//!
//! Moves together take the same in any order, so that a brick may be cut by all of them at any time later. Before a move is looked at
//! line by line, the bricks that its tool passes are cut.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::super::super::effect::Looked;
use super::super::super::list::CutList;
use super::super::task::{Batch, SpanTask};
use super::borders::Borders;
use super::brick::{self, Grids};
use super::cells::{Cells, Room};
use super::near::SweptPart;
use super::{swept_parts, unite};
use crate::base::Progress;
use crate::geom::Aabb;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel};

/// Moves that share a box.
const BLOCK: usize = 64;

/// Spans that are made ready at once.
const MOST: usize = 40_000;

/// Moves that have cut the lines along one axis, and no others yet.
#[derive(Clone, Debug)]
struct Debt {
    list: Arc<CutList>,
    moves: Range<usize>,
    /// All that each [`BLOCK`] of them sweeps.
    boxes: Vec<Aabb>,
}

/// Moves that have still to cut the lines across an axis.
#[derive(Clone, Debug)]
pub(in crate::stock) struct OwedAcross {
    /// The axis along which all lines are cut.
    axis: Axis,
    debts: Vec<Debt>,
    /// By brick: the number of debts that are paid.
    paid: Vec<u32>,
    /// By brick: nothing is left in it.
    swallowed: Vec<bool>,
    /// The borders at which ends of the lines across are wanted; without them everywhere.
    borders: Option<Arc<Borders>>,
}

impl OwedAcross {
    /// No moves yet; `cells` are those of the stock.
    pub(super) fn new(axis: Axis, cells: &Cells) -> OwedAcross {
        let count = cells.count();
        let (paid, swallowed) = (vec![0; count], vec![false; count]);
        OwedAcross { axis, debts: Vec::new(), paid, swallowed, borders: None }
    }

    /// The same moves for the grids of a stock over another lattice, none of whose lines across are known to be cut. They are to be cut
    /// only between points of the lattice at which the lines along the axis begin or end; between others they get material as those say.
    pub(in crate::stock) fn anew(
        &self,
        grids: &mut [Grid; 3],
        lattice: &Lattice,
        bounds: Aabb,
    ) -> OwedAcross {
        let borders = Borders::new(&grids[self.axis.index()], lattice);
        grids
            .iter_mut()
            .filter(|grid| self.is_across(grid.axis))
            .for_each(|grid| borders.clear(grid, lattice));
        let fresh = OwedAcross::new(self.axis, &Cells::without_material(lattice, bounds));
        OwedAcross { debts: self.debts.clone(), borders: Some(Arc::new(borders)), ..fresh }
    }

    /// Whether lines along an axis are behind.
    pub(in crate::stock) fn is_across(&self, axis: Axis) -> bool {
        self.axis != axis
    }

    /// The bricks that have no material, whatever the lines across say.
    pub(super) fn swallowed(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.swallowed).filter(|(_, is)| **is).map(|(brick, _)| brick)
    }

    /// Notes bricks that have no material any more.
    pub(super) fn note_swallowed(&mut self, bricks: impl Iterator<Item = u32>) {
        bricks.for_each(|brick| self.swallowed[brick as usize] = true);
    }

    /// Notes a range of moves of a list that were cut; `tasks` are their spans, which count moves from `first` on.
    pub(super) fn owe(
        &mut self,
        list: &Arc<CutList>,
        moves: Range<usize>,
        (tasks, first): (&[SpanTask], usize),
    ) {
        let mut boxes = vec![Aabb::EMPTY; moves.len().div_ceil(BLOCK)];
        for task in tasks {
            let block = &mut boxes[(task.index as usize - first) / BLOCK];
            *block = block.union(task.bounds);
        }
        self.debts.push(Debt { list: Arc::clone(list), moves, boxes });
    }

    /// Cuts the lines across in all bricks.
    pub(in crate::stock) fn pay_all(
        &mut self,
        grids: &mut [Grid; 3],
        stock: (&Lattice, Aabb),
        progress: &dyn Progress,
    ) {
        let all: Vec<u32> = (0..).take(self.paid.len()).collect();
        self.pay(grids, stock, &all, progress);
    }

    /// Cuts the lines across in some bricks; when it is cancelled they are cut no less than before.
    fn pay(
        &mut self,
        grids: &mut [Grid; 3],
        (lattice, bounds): (&Lattice, Aabb),
        bricks: &[u32],
        progress: &dyn Progress,
    ) {
        let axes = [self.axis.others().0, self.axis.others().1];
        let grids = Grids::share(grids);
        let is_behind = |brick: &u32| (self.paid[*brick as usize] as usize) < self.debts.len();
        let behind: Vec<u32> = bricks.iter().copied().filter(is_behind).collect();
        let mut next =
            behind.iter().map(|brick| self.paid[*brick as usize] as usize).min().unwrap_or(usize::MAX);
        while next < self.debts.len() && !progress.cancelled() {
            let cells = Cells::within(lattice, bounds, self.borders.as_ref());
            let is_wanted = |brick: u32| axes.iter().any(|axis| cells.wants(&cells.of_brick(brick), *axis));
            let open =
                || behind.iter().filter(|brick| !self.swallowed[**brick as usize] && is_wanted(**brick));
            let around = open().fold(Aabb::EMPTY, |all, brick| {
                let cell = cells.of_brick(*brick);
                all.union(Aabb { min: cell.low, max: cell.high })
            });
            let (mut batches, mut spans): (Vec<Batch>, usize) = (Vec::new(), 0);
            while next < self.debts.len() && spans < MOST {
                let debt = &self.debts[next];
                for moves in debt.near(around) {
                    let batch = Batch::new((lattice, bounds), &debt.list, moves);
                    spans += batch.tasks.len();
                    batches.push(batch);
                }
                next += 1;
            }
            // To cut a brick twice does no harm.
            open()
                .filter(|brick| (self.paid[**brick as usize] as usize) < next)
                .for_each(|brick| cells.note(*brick));
            let swept: Vec<SweptPart> = batches.iter().flat_map(|batch| swept_parts(&batch.tasks)).collect();
            let bricks = cells.bricks_with_material();
            unite((&cells, &bricks), (&grids, &axes), &swept, progress);
            let gone = bricks.iter().filter(|brick| !cells.has_material(**brick));
            gone.for_each(|brick| self.swallowed[*brick as usize] = true);
        }
        let cells = Cells::without_material(lattice, bounds);
        let mut gone = vec![false; self.paid.len()];
        behind.iter().for_each(|brick| gone[*brick as usize] = self.swallowed[*brick as usize]);
        brick::empty_all(&cells, (&grids, &axes), &gone);
        if !progress.cancelled() {
            behind.iter().for_each(|brick| self.paid[*brick as usize] = self.debts.len() as u32);
        }
    }
}

impl Debt {
    /// Ranges of its moves, in their order: those that may reach into a box.
    fn near(&self, around: Aabb) -> Vec<Range<usize>> {
        let mut found: Vec<Range<usize>> = Vec::new();
        let blocks = self.boxes.iter().zip(self.moves.clone().step_by(BLOCK));
        for (_, start) in blocks.filter(|(swept, _)| swept.meets(around)) {
            let end = self.moves.end.min(start + BLOCK);
            match found.last_mut() {
                Some(last) if last.end == start => last.end = end,
                _ => found.push(start..end),
            }
        }
        found
    }
}

/// Cuts the lines across in the bricks that spans pass, or whose material they may come near to.
pub(in super::super) fn settle_near(stock: &mut TriDexel, tasks: &[SpanTask], progress: &dyn Progress) {
    let (lattice, bounds) = (*stock.lattice(), stock.bounds());
    let Some(mut owed) = stock.owed.take() else { return };
    let cells = Cells::without_material(&lattice, bounds);
    let behind = (0u32..).zip(&owed.paid).filter(|(_, paid)| (**paid as usize) < owed.debts.len());
    behind.for_each(|(brick, _)| cells.note(brick));
    let passed = |task: &SpanTask| {
        let (mut bricks, mut room) = (Vec::new(), Room::default());
        for looked in [Looked::Cutting, Looked::Shank, Looked::Holder] {
            let grown = task.tool.grown.as_ref().map(|(grown, _)| &grown[looked as usize]);
            for part in &grown.unwrap_or(task.tool.looked_at(looked)).parts {
                cells.each_near(&mut room, &SweptPart::new(task, part, 0), |brick, _| bricks.push(brick));
            }
        }
        bricks
    };
    let mut bricks: Vec<u32> = tasks.par_iter().flat_map_iter(passed).collect();
    bricks.sort_unstable();
    bricks.dedup();
    owed.pay(&mut stock.grids, (&lattice, bounds), &bricks, progress);
    stock.owed = Some(owed);
}
