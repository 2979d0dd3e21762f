//! Cutting with a note of the material that each move takes from each line.

use glam::DVec3;
use rayon::prelude::*;

use super::leaning::cut_leaning_one_by_one;
use super::list::CutList;
use super::run::still_wanted;
use super::task::TileLines;
use super::upright::cut_one_by_one;
use crate::base::{Progress, Result};
use crate::geom::Aabb;
use crate::stock::tile::{TILE_EDGE, TakenStretch};
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, CutId, TriDexel, unfixed};

/// Stretches of material that were taken, by grid and by tile, in order.
pub(super) type Noted = [Vec<Vec<TakenStretch>>; 3];

/// Cuts the moves of a list one after the other.
pub(super) fn cut_noted(stock: &mut TriDexel, list: &CutList, progress: &dyn Progress) -> Result<Noted> {
    let taken = noted(stock, |stock| {
        for stretch in list.stretches(0..list.moves.len()) {
            match list.moves[stretch.start].stance.axis() {
                Some(axis) => cut_one_by_one(stock, axis, list, stretch, progress),
                None => cut_leaning_one_by_one(stock, list, stretch, progress),
            }
        }
        Ok(())
    })?;
    still_wanted(progress)?;
    Ok(taken)
}

/// Stretches of material that a change takes from a stock.
pub(super) fn noted(stock: &mut TriDexel, change: impl FnOnce(&mut TriDexel) -> Result<()>) -> Result<Noted> {
    for tile in stock.grids.iter_mut().flat_map(|grid| &mut grid.tiles) {
        tile.note_taken();
    }
    change(stock)?;
    Ok([0, 1, 2].map(|k| stock.grids[k].tiles.par_iter_mut().map(|tile| tile.take_noted()).collect()))
}

/// Index of the move of a cut.
pub(super) fn move_of(cut: CutId) -> usize {
    cut as usize - 1
}

/// A box about stretches of lines of a tile.
pub(super) fn bounds_of(grid: &Grid, lines: &TileLines, taken: &[TakenStretch]) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    let (a, b) = grid.axis.others();
    for (k, axis) in [a, b].into_iter().enumerate() {
        let at = &lines.at[k][..lines.size[k]];
        (bounds.min[axis.index()], bounds.max[axis.index()]) = (at[0], at[at.len() - 1]);
    }
    let along = grid.axis.index();
    bounds.min[along] = taken.iter().map(|s| unfixed(s.ends[0])).fold(f64::INFINITY, f64::min);
    bounds.max[along] = taken.iter().map(|s| unfixed(s.ends[1])).fold(f64::NEG_INFINITY, f64::max);
    bounds
}

impl TakenStretch {
    /// Row and column of its line in the tile.
    pub(super) fn place(&self) -> [usize; 2] {
        [self.line as usize / TILE_EDGE as usize, self.line as usize % TILE_EDGE as usize]
    }

    /// Its ends as points.
    pub(super) fn points(&self, axis: Axis, lines: &TileLines) -> [DVec3; 2] {
        let [row, column] = self.place();
        let (a, b) = axis.others();
        self.ends.map(|end| {
            let mut point = DVec3::ZERO;
            point[a.index()] = lines.at[0][column];
            point[b.index()] = lines.at[1][row];
            point[axis.index()] = unfixed(end);
            point
        })
    }
}
