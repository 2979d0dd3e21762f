//! A brick: divided into cells, its lines cut by the spans that reach deepest.

use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::DVec3;
use rayon::prelude::*;

use super::super::swept::{CoverEnd, MOST_STRETCHES, NO_STRETCH, StockLine};
use super::super::task::Batch;
use super::super::tiles::end_point;
use super::away::AwayBounds;
use super::bundle::Bundle;
use super::cells::{BRICK, Cell, Cells};
use super::lanes::LANES;
use super::near::SweptPart;
use super::planes::Planes;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{Axis, EndPoint, fixed, unfixed};

/// Ends this near to the border of a cell lie on it [fixed steps]: both cells there shall agree.
const SNAP: i32 = 2;

/// Edges of the smallest cells to a radius of the tool: a ball is off its tangent plane by no more than 1/100 of its radius there.
const LEAVES: f64 = 7.0;

/// Lines along an edge of the smallest cells, for the thinnest part of a run: a power of two less than that of a brick.
pub(super) fn leaf(thinnest: f64, step: f64) -> u32 {
    let mut leaf = BRICK / 2;
    while leaf > 1 && f64::from(leaf) * step * LEAVES > thinnest {
        leaf /= 2;
    }
    leaf
}

/// A grid whose tiles are shared by the bricks along its lines.
pub(super) struct Grids<'a> {
    /// Number of tiles across.
    across: [u32; 2],
    tiles: Vec<Mutex<&'a mut Tile>>,
}

impl<'a> Grids<'a> {
    /// The tiles of a stock's grids.
    pub(super) fn share(grids: &'a mut [Grid; 3]) -> [Grids<'a>; 3] {
        grids.each_mut().map(|grid| {
            let across = grid.tiles_across();
            Grids { across, tiles: grid.tiles.iter_mut().map(Mutex::new).collect() }
        })
    }
}

/// A move that has left an end: its index in the batch, and the end's place [mm].
pub(super) type Winner = (u32, [f64; 3]);

/// The tiles of a brick's lines, of its own until it is done: no brick waits for another that shares a line.
struct Work<'a> {
    cells: &'a Cells,
    swept: &'a [SweptPart<'a>],
    /// Directions of the lines that are cut, and the tiles of these.
    axes: &'a [Axis],
    tiles: [Tile; 3],
    /// By tile what was taken out of its lines: index of the line, and both ends.
    taken: [Vec<(u16, [EndPoint; 2])>; 3],
    planes: Planes,
    away: AwayBounds,
    open: Vec<usize>,
    /// Lines along an edge of the smallest cells.
    leaf: u32,
    /// Room for bundles and a list that are not in use.
    bundles: Vec<Bundle>,
    some: Vec<u32>,
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

/// Cuts the lines of a brick along some axes by the swept parts near it.
pub(super) fn cut(
    (cells, leaf): (&Cells, u32),
    (grids, axes): (&[Grids; 3], &[Axis]),
    swept: &[SweptPart],
    brick: u32,
    near: &[u32],
) {
    let cell = cells.of_brick(brick);
    let tiles = Axis::ALL.map(|axis| match axes.contains(&axis) {
        true => Tile::clone(&tile(grids, axis, &cell)),
        false => Tile::of(None),
    });
    let taken = [const { Vec::new() }; 3];
    let mut work = Work {
        cells,
        swept,
        axes,
        tiles,
        taken,
        planes: Planes::default(),
        away: AwayBounds::default(),
        open: vec![],
        leaf,
        bundles: vec![],
        some: vec![],
    };
    work.halve(&cell, BRICK, near);
    for (axis, taken) in Axis::ALL.into_iter().zip(work.taken).filter(|(_, taken)| !taken.is_empty()) {
        let mut tile = tile(grids, axis, &cell);
        for (line, [lo, hi]) in taken {
            tile.subtract(line as usize, lo, hi);
        }
    }
}

/// Takes all material of some bricks out of the lines along some axes.
pub(super) fn empty_all(cells: &Cells, (grids, axes): (&[Grids; 3], &[Axis]), gone: &[bool]) {
    for axis in axes.iter().copied() {
        let tiles = 0..grids[axis.index()].tiles.len();
        tiles.into_par_iter().for_each(|tile| empty(cells, grids, (axis, tile), gone));
    }
}

/// The same for the lines of a tile.
fn empty(cells: &Cells, grids: &[Grids; 3], (axis, tile): (Axis, usize), gone: &[bool]) {
    let grid = &grids[axis.index()];
    let bricks: Vec<u32> =
        cells.along(axis, tile as u32 % grid.across[0], tile as u32 / grid.across[0]).collect();
    let mut tile = grid.tiles[tile].lock().unwrap_or_else(PoisonError::into_inner);
    // Those next to one another at once.
    for run in bricks.chunk_by(|a, b| gone[*a as usize] == gone[*b as usize]) {
        if !gone[run[0] as usize] {
            continue;
        }
        let [first, last] = [run[0], run[run.len() - 1]].map(|brick| cells.of_brick(brick));
        let [lo, hi] = [window(&first, axis.index())[0], window(&last, axis.index())[1]].map(border);
        each_line(cells, &first, axis, |line, _| {
            tile.subtract(line, lo, hi);
        });
    }
}

/// The tile of a brick's lines along an axis, for as long as it is held.
fn tile<'b, 'c>(grids: &'b [Grids<'c>; 3], axis: Axis, cell: &Cell) -> MutexGuard<'b, &'c mut Tile> {
    let (a, b) = axis.others();
    let grid = &grids[axis.index()];
    let tile = cell.first[b.index()] / TILE_EDGE * grid.across[0] + cell.first[a.index()] / TILE_EDGE;
    grid.tiles[tile as usize].lock().unwrap_or_else(PoisonError::into_inner)
}

/// The moves of a batch that have left an end on the lines of a brick along some axes.
pub(super) fn winners(
    cells: &Cells,
    (grids, axes): (&[Grids; 3], &[Axis]),
    brick: u32,
    batch: &Batch,
) -> Vec<Winner> {
    let cell = cells.of_brick(brick);
    let mut winners: Vec<Winner> = Vec::new();
    for axis in axes.iter().copied() {
        let along = axis.index();
        let [low, high] = window(&cell, along);
        let tile = tile(grids, axis, &cell);
        each_line(cells, &cell, axis, |line, start| {
            let ends = tile.line(line).iter().flat_map(|i| [i.lo, i.hi]);
            for end in ends.filter(|end| end.at >= low && end.at < high) {
                let index = end.cut.wrapping_sub(batch.first);
                if (index as usize) < batch.moves.len() && winners.last().is_none_or(|last| last.0 != index) {
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

impl Work<'_> {
    /// Divides a cell until it is swallowed, or small enough to be cut.
    fn divide(&mut self, cell: &Cell, size: u32, near: &mut Bundle) {
        if !self.axes.iter().any(|axis| self.cells.wants(cell, *axis)) {
            return;
        }
        near.ask(self.swept, cell.centre, cell.radius);
        let mut some = std::mem::take(&mut self.some);
        some.clear();
        for (i, reach) in near.list.iter().zip(&near.reaches) {
            if *reach < -cell.radius {
                continue;
            }
            // A pose that swallows it reaches beyond it on all sides.
            if *reach > cell.radius && self.swept[*i as usize].swallows(cell) {
                self.some = some;
                return self.empty(cell);
            }
            some.push(*i);
        }
        if size > self.leaf && !some.is_empty() {
            self.halve(cell, size, &some);
        } else if !some.is_empty() {
            self.cut(cell, &some);
        }
        self.some = some;
    }

    /// Divides a cell of a size into eight.
    fn halve(&mut self, cell: &Cell, size: u32, near: &[u32]) {
        let half = size / 2;
        let mut bundle = self.bundles.pop().unwrap_or_default();
        bundle.fill(self.swept, near);
        for k in (cell.first[2]..cell.end[2]).step_by(half as usize) {
            for j in (cell.first[1]..cell.end[1]).step_by(half as usize) {
                for i in (cell.first[0]..cell.end[0]).step_by(half as usize) {
                    self.divide(&self.cells.cell([i, j, k], half), half, &mut bundle);
                }
            }
        }
        self.bundles.push(bundle);
    }

    /// Cuts a cell by the swept parts that may reach it: each line first by the one that cut its neighbour last, then by the one that
    /// reaches deepest beyond its end, as long as one does.
    fn cut(&mut self, cell: &Cell, list: &[u32]) {
        let mut planes = std::mem::take(&mut self.planes);
        planes.set(self.swept, list, cell);
        // The part that held a line last.
        let mut held = 0;
        for mut line in self.lines(cell) {
            if self.hold(&planes, cell, list[held], held, &line) {
                continue;
            }
            planes.begin();
            let (mut first, mut sifted) = (true, false);
            while let Some(n) = planes.deepest(&line.ends) {
                if first && n != held && self.hold(&planes, cell, list[n], n, &line) {
                    held = n;
                    break;
                }
                if !first && !sifted {
                    self.sift(&mut planes, cell, list, &line.ends);
                    sifted = true;
                    continue;
                }
                let n = if first { planes.deepest_closely(n, &line.ends) } else { n };
                first = false;
                planes.close(n);
                if self.cut_line(&line, &self.swept[list[n] as usize]) {
                    sifted = false;
                    if !self.look(&mut line, cell.centre) {
                        break;
                    }
                }
            }
        }
        self.planes = planes;
    }

    /// Takes all material of a line in a cell if a part holds it.
    fn hold(&mut self, planes: &Planes, cell: &Cell, part: u32, n: usize, line: &Line) -> bool {
        let holds = planes.may_hold(n, &line.ends)
            && self.swept[part as usize].holds(line.ends.map(|end| end + cell.centre));
        if holds {
            self.take(line.along, line.line, line.hull.map(border));
        }
        holds
    }

    /// Closes the parts that stay away from the material between two ends, given from the centre of a cell.
    fn sift(&mut self, planes: &mut Planes, cell: &Cell, list: &[u32], ends: &[DVec3; 2]) {
        let mut open = std::mem::take(&mut self.open);
        open.clear();
        open.extend(planes.open());
        for some in open.chunks(LANES) {
            let part = |n: &usize| {
                let places = planes.nearer_first(*n, ends).map(|place| place + cell.centre);
                (&self.swept[list[*n] as usize], places)
            };
            let bounds = self.away.bounds(some.iter().map(part));
            for (n, bound) in some.iter().zip(bounds) {
                if bound > 0.0 {
                    planes.close(*n);
                }
            }
        }
        self.open = open;
    }

    /// Takes a stretch out of a line; returns the length removed [fixed steps].
    fn take(&mut self, along: usize, line: usize, ends: [EndPoint; 2]) -> i64 {
        self.taken[along].push((line as u16, ends));
        self.tiles[along].subtract(line, ends[0], ends[1])
    }

    /// Cuts a line in a cell by a swept part; true when it was changed.
    fn cut_line(&mut self, line: &Line, swept: &SweptPart) -> bool {
        let tile = &self.tiles[line.along];
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
                // What lies beyond all material of the line does not stay.
                let [first, last] = line.hull;
                let end = |at: i32, end: &CoverEnd| match at < first || at > last {
                    true => border(at),
                    false => end_point(task, swept.index, at, end),
                };
                let ends = [end(from, &lo), end(to, &hi)];
                changed |= self.take(line.along, line.line, ends) > 0;
            }
        });
        changed
    }

    /// The lines of a cell that have material in it.
    fn lines(&self, cell: &Cell) -> Vec<Line> {
        let mut lines = Vec::with_capacity(self.axes.len() * (self.leaf * self.leaf) as usize);
        for axis in self.axes.iter().copied().filter(|axis| self.cells.wants(cell, *axis)) {
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
        for axis in self.axes.iter().copied() {
            let ends = window(cell, axis.index()).map(border);
            each_line(self.cells, cell, axis, |line, _| {
                self.take(axis.index(), line, ends);
            });
        }
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
