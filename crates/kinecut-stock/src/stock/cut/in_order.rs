//! Upright tools line by line in the order of the moves: tasks to tiles and strips, these to threads.

use std::f64::consts::SQRT_2;
use std::ops::Range;

use glam::DVec2;
use rayon::prelude::*;

use super::axis::ToolFrame;
use super::effect::{Effects, Sum};
use super::strip::Strip;
use super::task::{Task, TileLines};
use super::tile_axial::cut_along;
use crate::base::Progress;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel};

/// Cuts tasks in order; adds up by move what each does.
pub(super) fn cut_in_order(
    stock: &mut TriDexel,
    frame: &ToolFrame,
    tasks: &[Task],
    sums: &mut [Sum],
    progress: &dyn Progress,
) {
    let lattice = *stock.lattice();
    for grid in &mut stock.grids {
        if grid.axis == frame.axes[2] {
            cut_tiles(grid, &lattice, tasks, sums, progress);
        } else {
            cut_strips(grid, &lattice, frame, tasks, sums, progress);
        }
    }
}

/// Cuts the grid along the tool axis, tile by tile, and adds up what each move does.
fn cut_tiles(grid: &mut Grid, lattice: &Lattice, tasks: &[Task], sums: &mut [Sum], progress: &dyn Progress) {
    let bins = bins(grid, lattice, tasks);
    let empty = Grid { axis: grid.axis, counts: grid.counts, tiles: Vec::new() };
    let work = grid.tiles.par_iter_mut().zip(&bins).enumerate().filter(|(_, (_, bin))| !bin.is_empty());
    let done: Vec<Effects> = work
        .map(|(t, (tile, bin))| {
            let mut effects = Effects::default();
            if progress.cancelled() {
                return effects;
            }
            let lines = &TileLines::new(&empty, lattice, t);
            let (width, height) = (lines.size[0] as u32, lines.size[1] as u32);
            let mut hull = tile.hull(width, height);
            for task in bin.iter().map(|i| &tasks[*i as usize]) {
                let Some(material) = hull else { break };
                if cut_along(tile, lines, task, material, &mut effects) {
                    hull = tile.hull(width, height);
                }
            }
            effects
        })
        .collect();
    for effect in done.iter().flat_map(Effects::iter) {
        sums[effect.index as usize].add(effect, 0);
    }
}

/// For each tile of the grid along the tool axis the tasks that may reach it, in order.
fn bins(grid: &Grid, lattice: &Lattice, tasks: &[Task]) -> Vec<Vec<u32>> {
    let mut bins = vec![Vec::new(); grid.tiles.len()];
    let across = grid.tiles_across();
    let (a, b) = grid.axis.others();
    let half = 0.5 * lattice.step * f64::from(TILE_EDGE - 1);
    let middles = [(a, across[0]), (b, across[1])].map(|(axis, n)| -> Vec<f64> {
        (0..n).map(|t| lattice.coordinate(axis, t * TILE_EDGE) + half).collect()
    });
    for (i, task) in tasks.iter().enumerate() {
        let swapped = task.frame.sign < 0.0;
        // Half a diagonal, one step more on either side than needed.
        let reach = task.tool.radius + (half + lattice.step) * SQRT_2;
        let (min, max) = (task.plan_box.0 - reach, task.plan_box.1 + reach);
        let (x, y) =
            if swapped { ((min.y, max.y), (min.x, max.x)) } else { ((min.x, max.x), (min.y, max.y)) };
        let range = |k: usize, (from, to): (f64, f64)| {
            let m: &[f64] = &middles[k];
            m.partition_point(|c| *c < from)..m.partition_point(|c| *c <= to)
        };
        for row in range(1, y) {
            for column in range(0, x) {
                let (p, q) = (middles[0][column], middles[1][row]);
                let centre = if swapped { DVec2::new(q, p) } else { DVec2::new(p, q) };
                if task.piece.plan.distance_squared(centre) <= reach * reach {
                    bins[row * across[0] as usize + column].push(i as u32);
                }
            }
        }
    }
    bins
}

/// Cuts a grid across the tool axis, strip by strip, and adds up what each move meets.
fn cut_strips(
    grid: &mut Grid,
    lattice: &Lattice,
    frame: &ToolFrame,
    tasks: &[Task],
    sums: &mut [Sum],
    progress: &dyn Progress,
) {
    let axis = grid.axis;
    let (rows, heights) = strip_lines(grid, lattice, frame);
    let some = reached(axis, &rows, tasks);
    let done: Vec<Effects> = strips(grid, frame, (&rows, &heights), some)
        .into_par_iter()
        .map(|mut strip| {
            let mut effects = Effects::default();
            for task in tasks {
                if progress.cancelled() {
                    break;
                }
                strip.pass(axis, task, &mut effects);
            }
            effects
        })
        .collect();
    let direction = if axis == frame.axes[0] { 1 } else { 2 };
    for effect in done.iter().flat_map(Effects::iter) {
        sums[effect.index as usize].add(effect, direction);
    }
}

/// Coordinates of the rows of a grid across the tool axis, and of its layers, in the stock.
pub(super) fn strip_lines(grid: &Grid, lattice: &Lattice, frame: &ToolFrame) -> (Vec<f64>, Vec<f64>) {
    let (a, b) = grid.axis.others();
    let side = if a == frame.axes[2] { b } else { a };
    let coordinates = |axis: Axis| -> Vec<f64> {
        (0..lattice.counts[axis.index()]).map(|i| lattice.coordinate(axis, i) + LINE_OFFSET).collect()
    };
    (coordinates(side), coordinates(frame.axes[2]))
}

/// Some strips of a grid across the tool axis, in the order of its rows.
pub(super) fn strips<'a>(
    grid: &'a mut Grid,
    frame: &ToolFrame,
    (rows, heights): (&[f64], &'a [f64]),
    some: Range<usize>,
) -> Vec<Strip<'a>> {
    let up = usize::from(grid.axis.others().0 != frame.axes[2]);
    let across = grid.tiles_across()[0] as usize;
    let mut columns: Vec<Vec<&mut Tile>> = Vec::new();
    columns.resize_with(some.len(), Vec::new);
    for (t, tile) in grid.tiles.iter_mut().enumerate() {
        let place = [t % across, t / across];
        if let Some(column) = place[1 - up].checked_sub(some.start).and_then(|c| columns.get_mut(c)) {
            column.push(tile);
        }
    }
    let rows = rows.chunks(TILE_EDGE as usize).skip(some.start);
    columns.into_iter().zip(rows).map(|(tiles, rows)| Strip::new(tiles, up, rows, heights)).collect()
}

/// The strips that tasks may reach.
fn reached(axis: Axis, rows: &[f64], tasks: &[Task]) -> Range<usize> {
    let edge = TILE_EDGE as usize;
    let (mut first, mut last) = (rows.len(), 0);
    for task in tasks {
        let y = Strip::view(axis, task).y;
        first = first.min(rows.partition_point(|row| *row < y.0 - task.tool.radius));
        last = last.max(rows.partition_point(|row| *row <= y.1 + task.tool.radius));
    }
    if first < last { first / edge..last.div_ceil(edge) } else { 0..0 }
}
