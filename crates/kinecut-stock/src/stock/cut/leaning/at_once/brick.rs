//! A brick: divided into cells, its lines cut by the spans that reach deepest.

use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::DVec3;

use super::super::swept::{MOST_STRETCHES, NO_STRETCH, StockLine};
use super::super::task::Batch;
use super::super::tiles::end_point;
use super::cells::{BRICK, Cell, Cells};
use super::near::{SweptPart, Tangent};
use super::planes::Planes;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, EndPoint, fixed, unfixed};

/// Lines along an edge of the smallest cells.
const LEAF: u32 = 4;

/// Lines of a smallest cell.
const LINES: usize = 3 * (LEAF * LEAF) as usize;

/// Ends this near to the border of a cell lie on it [fixed steps]: both cells there shall agree.
const SNAP: i32 = 2;

/// A grid whose tiles are shared by the bricks along its lines.
pub(super) struct Grids<'a> {
    pub(super) axis: Axis,
    /// Number of tiles across.
    pub(super) across: [u32; 2],
    pub(super) tiles: Vec<Mutex<&'a mut Tile>>,
}

/// A move that has left an end: its index in the batch, and the end's place [mm].
pub(super) type Winner = (u32, [f64; 3]);

/// The tiles of a brick.
struct Work<'a, 'b, 'c> {
    cells: &'a Cells,
    swept: &'a [SweptPart<'a>],
    tiles: [MutexGuard<'b, &'c mut Tile>; 3],
    planes: Planes,
}

/// A line in a cell.
#[derive(Clone, Copy)]
struct Line {
    /// Index of its grid, and in the tile.
    along: usize,
    line: usize,
    /// The point of the line at the coordinate 0.
    start: DVec3,
    /// Borders of the cell along it [fixed steps].
    window: [i32; 2],
    /// Least and greatest coordinate of its material in the cell [fixed steps], and in mm.
    hull: [i32; 2],
    material: [f64; 2],
    /// These places, seen from the centre of the cell.
    ends: [DVec3; 2],
}

/// Cuts a brick by the swept parts near it.
pub(super) fn cut(cells: &Cells, grids: &[Grids; 3], swept: &[SweptPart], brick: u32, near: &[u32]) {
    let cell = cells.of_brick(brick);
    Work::new(cells, grids, swept, &cell).halve(&cell, BRICK, near);
}

/// Takes all material out of a brick.
pub(super) fn empty(cells: &Cells, grids: &[Grids; 3], brick: u32) {
    let cell = cells.of_brick(brick);
    Work::new(cells, grids, &[], &cell).empty(&cell);
}

/// The moves of a batch that have left an end in a brick.
pub(super) fn winners(cells: &Cells, grids: &[Grids; 3], brick: u32, batch: &Batch) -> Vec<Winner> {
    let cell = cells.of_brick(brick);
    Work::new(cells, grids, &[], &cell).winners(&cell, batch)
}

impl<'a, 'b, 'c> Work<'a, 'b, 'c> {
    /// Holds the tiles of a brick's lines: always in the order of their grids, so that no two threads wait for each other.
    fn new(
        cells: &'a Cells,
        grids: &'b [Grids<'c>; 3],
        swept: &'a [SweptPart<'a>],
        cell: &Cell,
    ) -> Work<'a, 'b, 'c> {
        let tiles = grids.each_ref().map(|grid| {
            let (a, b) = grid.axis.others();
            let tile = cell.first[b.index()] / TILE_EDGE * grid.across[0] + cell.first[a.index()] / TILE_EDGE;
            grid.tiles[tile as usize].lock().unwrap_or_else(PoisonError::into_inner)
        });
        Work { cells, swept, tiles, planes: Planes::default() }
    }

    /// Divides a cell until it is swallowed, or small enough to be cut.
    fn divide(&mut self, cell: &Cell, size: u32, near: &[u32]) {
        let mut list: Vec<(u32, Tangent)> = Vec::with_capacity(near.len());
        for i in near {
            let one = &self.swept[*i as usize];
            if let Some(tangent) = one.reaches(cell) {
                // A pose that swallows it reaches beyond it on all sides.
                if tangent.reach > cell.radius && one.swallows(cell) {
                    return self.empty(cell);
                }
                list.push((*i, tangent));
            }
        }
        if list.is_empty() {
            return;
        }
        if size <= LEAF {
            for (i, tangent) in &mut list {
                *tangent = self.swept[*i as usize].tangent_closely(cell);
            }
            list.retain(|(_, tangent)| tangent.reach >= -cell.radius);
            return self.cut(cell, &list);
        }
        let some: Vec<u32> = list.iter().map(|(i, _)| *i).collect();
        self.halve(cell, size, &some);
    }

    /// Divides a cell of a size into eight.
    fn halve(&mut self, cell: &Cell, size: u32, near: &[u32]) {
        let half = size / 2;
        for k in (cell.first[2]..cell.end[2]).step_by(half as usize) {
            for j in (cell.first[1]..cell.end[1]).step_by(half as usize) {
                for i in (cell.first[0]..cell.end[0]).step_by(half as usize) {
                    self.divide(&self.cells.cell([i, j, k], half), half, near);
                }
            }
        }
    }

    /// Cuts a cell by the swept parts that may reach it: each line by the one that reaches deepest beyond its end, as long as one
    /// does.
    fn cut(&mut self, cell: &Cell, list: &[(u32, Tangent)]) {
        let mut planes = std::mem::take(&mut self.planes);
        planes.set(list);
        for mut line in self.lines(cell) {
            planes.begin();
            while let Some(n) = planes.deepest(&line.ends) {
                let one = &self.swept[list[n].0 as usize];
                let ends = line.ends.map(|end| end + cell.centre);
                if one.holds(ends) {
                    self.tiles[line.along].subtract(line.line, border(line.hull[0]), border(line.hull[1]));
                    break;
                }
                if self.cut_line(&line, one) && !self.look(&mut line, cell.centre) {
                    break;
                }
            }
        }
        self.planes = planes;
    }

    /// Cuts a line in a cell by a swept part; true when it was changed.
    fn cut_line(&mut self, line: &Line, swept: &SweptPart) -> bool {
        let tile = &mut *self.tiles[line.along];
        let [low, high] = line.window;
        let mut stretches = [NO_STRETCH; MOST_STRETCHES];
        let parts = tile.line(line.line).iter().filter(|i| i.lo.at < high && low < i.hi.at);
        for (n, part) in parts.enumerate() {
            let kept = &mut stretches[n.min(MOST_STRETCHES - 1)];
            *kept = [kept[0].min(unfixed(part.lo.at.max(low))), unfixed(part.hi.at.min(high))];
        }
        let seen = StockLine { start: line.start, along: line.along, material: line.material, stretches };
        let task = swept.task;
        let mut changed = false;
        task.poses.covers(swept.part, task.bend, &seen, |[lo, hi]| {
            let (from, to) = (fixed(lo.s), fixed(hi.s));
            let from = if from <= low + SNAP { low } else { from };
            let to = if to >= high - SNAP { high } else { to };
            if from < high - SNAP && to > low + SNAP && from < to {
                let ends = [(from, &lo), (to, &hi)].map(|(at, end)| end_point(task, swept.index, at, end));
                changed |= tile.subtract(line.line, ends[0], ends[1]) > 0;
            }
        });
        changed
    }

    /// The lines of a cell that have material in it.
    fn lines(&self, cell: &Cell) -> Vec<Line> {
        let mut lines = Vec::with_capacity(LINES);
        for axis in Axis::ALL {
            let along = axis.index();
            let window = window(cell, along);
            each_line(self.cells, cell, axis, |line, start| {
                let empty = [DVec3::ZERO; 2];
                let mut line =
                    Line { along, line, start, window, hull: [0; 2], material: [0.0; 2], ends: empty };
                if self.look(&mut line, cell.centre) {
                    lines.push(line);
                }
            });
        }
        lines
    }

    /// Sets the material of a line from its tile; false when it has none in the cell.
    fn look(&self, line: &mut Line, centre: DVec3) -> bool {
        let [low, high] = line.window;
        let within =
            self.tiles[line.along].line(line.line).iter().filter(|i| i.lo.at < high && low < i.hi.at);
        let hull = within.fold([i32::MAX, i32::MIN], |[a, b], i| [a.min(i.lo.at), b.max(i.hi.at)]);
        if hull[0] >= hull[1] {
            return false;
        }
        line.hull = [hull[0].max(low), hull[1].min(high)];
        line.material = line.hull.map(unfixed);
        line.ends = line.material.map(|s| {
            let mut end = line.start - centre;
            end[line.along] += s;
            end
        });
        true
    }

    /// Takes all material out of a cell.
    fn empty(&mut self, cell: &Cell) {
        for axis in Axis::ALL {
            let tile = &mut *self.tiles[axis.index()];
            let ends = window(cell, axis.index()).map(border);
            each_line(self.cells, cell, axis, |line, _| {
                tile.subtract(line, ends[0], ends[1]);
            });
        }
    }

    /// The moves of a batch that have left an end in a cell.
    fn winners(&self, cell: &Cell, batch: &Batch) -> Vec<Winner> {
        let mut winners: Vec<Winner> = Vec::new();
        for axis in Axis::ALL {
            let along = axis.index();
            let [low, high] = window(cell, along);
            each_line(self.cells, cell, axis, |line, start| {
                let ends = self.tiles[along].line(line).iter().flat_map(|i| [i.lo, i.hi]);
                for end in ends.filter(|end| end.at >= low && end.at < high) {
                    let index = end.cut.wrapping_sub(batch.first);
                    if (index as usize) < batch.moves.len()
                        && winners.last().is_none_or(|last| last.0 != index)
                    {
                        let mut point = start;
                        point[along] = unfixed(end.at);
                        winners.push((index, point.to_array()));
                    }
                }
            });
        }
        winners.sort_by_key(|(index, _)| *index);
        winners.dedup_by_key(|(index, _)| *index);
        winners
    }
}

/// An end at the border of what is taken out; beyond it something else is, so that it does not stay.
fn border(at: i32) -> EndPoint {
    EndPoint { at, ..EndPoint::default() }
}

/// Borders of a cell along a coordinate [fixed steps].
fn window(cell: &Cell, along: usize) -> [i32; 2] {
    [fixed(cell.low[along]), fixed(cell.high[along])]
}

/// Calls for each line of a cell along an axis, with its index in the tile and its point at the coordinate 0.
fn each_line(cells: &Cells, cell: &Cell, axis: Axis, mut each: impl FnMut(usize, DVec3)) {
    let (a, b) = axis.others();
    let lattice = cells.lattice();
    let mut start = DVec3::ZERO;
    for j in cell.first[b.index()]..cell.end[b.index()] {
        start[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
        for i in cell.first[a.index()]..cell.end[a.index()] {
            start[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
            each((j % TILE_EDGE * TILE_EDGE + i % TILE_EDGE) as usize, start);
        }
    }
}
