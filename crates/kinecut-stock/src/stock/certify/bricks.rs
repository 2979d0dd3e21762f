//! The stock in bricks of 16 x 16 x 16 lattice points, each of 4 x 4 x 4 blocks of which is known whether they may have material.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use glam::DVec3;
use rayon::prelude::*;

use super::Task;
use super::gauge::GaugePart;
use super::pair::{Checked, Moments, Node, Ray, chord, is_wide, meets, stays_out};
use crate::base::Progress;
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel, fixed, unfixed};

/// Lattice points along the edge of a brick, and of a block.
const BRICK: u32 = 16;
const BLOCK: u32 = 4;

/// Bricks of a stock.
pub(super) struct Bricks {
    lattice: Lattice,
    low: DVec3,
    high: DVec3,
    counts: [u32; 3],
    /// By brick: a bit for each block that may have material.
    filled: Vec<AtomicU64>,
}

/// A brick and a stretch of a move that may meet it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub(super) brick: u32,
    pub(super) task: u32,
    pub(super) node: Node,
}

/// A stretch of a line in which a tool was met.
pub(super) struct Stretch {
    pub(super) task: u32,
    pub(super) axis: Axis,
    pub(super) line: [u32; 2],
    pub(super) ends: [i32; 2],
    pub(super) normals: [DVec3; 2],
    pub(super) faces: [u8; 2],
}

/// Result of a brick.
#[derive(Default)]
pub(super) struct Found {
    pub(super) checked: Checked,
    pub(super) stretches: Vec<Stretch>,
}

/// A cube of lattice points.
#[derive(Clone, Copy)]
struct Cube {
    first: [u32; 3],
    size: u32,
    centre: DVec3,
    radius: f64,
}

impl Bricks {
    pub(super) fn new(stock: &TriDexel) -> Bricks {
        let lattice = *stock.lattice();
        let counts = lattice.counts.map(|n| n.div_ceil(BRICK));
        let bricks = (0..counts.iter().product::<u32>()).map(|_| AtomicU64::new(0)).collect();
        let bounds = stock.bounds();
        let all = Bricks { lattice, low: bounds.min, high: bounds.max, counts, filled: bricks };
        for axis in Axis::ALL {
            let (u, v) = axis.others();
            let rows = lattice.counts[v.index()];
            (0..rows).into_par_iter().for_each(|b| {
                for a in 0..lattice.counts[u.index()] {
                    all.fill(stock, axis, a, b);
                }
            });
        }
        all
    }

    /// Notes the blocks in which a line has material.
    fn fill(&self, stock: &TriDexel, axis: Axis, a: u32, b: u32) {
        let (u, v) = axis.others();
        let mut at = [0; 3];
        (at[u.index()], at[v.index()]) = (a, b);
        for interval in stock.line(axis, a, b) {
            // One fixed step more on either side: rounding.
            let [from, to] = [interval.lo.at - 1, interval.hi.at + 1].map(|s| self.index(axis, unfixed(s)));
            for i in from / BLOCK..=to / BLOCK {
                at[axis.index()] = i * BLOCK;
                let (brick, bit) = (self.number(at.map(|i| i / BRICK)), block(at));
                // Most blocks are known already: no other thread waits for a look.
                if self.filled[brick as usize].load(Relaxed) & bit == 0 {
                    self.filled[brick as usize].fetch_or(bit, Relaxed);
                }
            }
        }
    }

    /// The lattice point whose cell a coordinate lies in, the nearest one if it lies outside.
    fn index(&self, axis: Axis, at: f64) -> u32 {
        let i = (at - self.lattice.origin[axis.index()]) / self.lattice.step + 0.5;
        (i.max(0.0) as u32).min(self.lattice.counts[axis.index()] - 1)
    }

    fn number(&self, [i, j, k]: [u32; 3]) -> u32 {
        (k * self.counts[1] + j) * self.counts[0] + i
    }

    /// The cube of a size from a lattice point on. The outermost hold all up to the border of the stock.
    fn cube(&self, first: [u32; 3], size: u32) -> Cube {
        let (mut low, mut high) = (DVec3::ZERO, DVec3::ZERO);
        for axis in Axis::ALL {
            let [from, to] = self.window(axis, first[axis.index()], size);
            (low[axis.index()], high[axis.index()]) = (from, to);
        }
        // Lines lie a little beside the lattice, and ends are rounded.
        let radius = 0.5 * (high - low).length() + 4.0 * LINE_OFFSET;
        Cube { first, size, centre: 0.5 * (low + high), radius }
    }

    /// Borders along an axis of the cells of lattice points.
    fn window(&self, axis: Axis, first: u32, size: u32) -> [f64; 2] {
        let border = |i: u32| self.lattice.coordinate(axis, i) - 0.5 * self.lattice.step;
        let end = first + size;
        let low = if first == 0 { self.low[axis.index()] } else { border(first) };
        let last = end >= self.lattice.counts[axis.index()];
        let high = if last { self.high[axis.index()] } else { border(end) };
        [low.min(high), high]
    }

    /// True if a cube may have material.
    fn has_material(&self, cube: &Cube) -> bool {
        let bits = self.filled[self.number(cube.first.map(|i| i / BRICK)) as usize].load(Relaxed);
        let blocks = cube.size / BLOCK;
        let mut mask = 0;
        for (k, j) in (0..blocks).flat_map(|k| (0..blocks).map(move |j| (k, j))) {
            for i in 0..blocks {
                let [x, y, z] = cube.first;
                mask |= block([x + i * BLOCK, y + j * BLOCK, z + k * BLOCK]);
            }
        }
        bits & mask != 0
    }

    /// The bricks that a move may meet, each with a stretch of the move.
    pub(super) fn near(&self, number: u32, task: &Task) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let mut moments = Moments::of(task);
        let size = f64::from(BRICK) * self.lattice.step;
        let mut open: Vec<Node> = vec![1];
        while let Some(node) = open.pop() {
            let moment = moments.at(node);
            let reach = task.tool.reach + moment.travel;
            let at = moment.pose.translation;
            let [low, high] = [at - reach, at + reach];
            if high.cmplt(self.low).any() || low.cmpgt(self.high).any() {
                continue;
            }
            // Long stretches reach about a wide box.
            if moment.travel > 0.5 * size.max(task.tool.parts[0].width()) || is_wide(task.tool, &moment, 0.0)
            {
                open.extend([2 * node, 2 * node + 1]);
                continue;
            }
            let ranges = Axis::ALL.map(|axis| {
                let k = axis.index();
                self.index(axis, low[k]) / BRICK..=self.index(axis, high[k]) / BRICK
            });
            for k in ranges[2].clone() {
                for j in ranges[1].clone() {
                    for i in ranges[0].clone() {
                        let brick = self.number([i, j, k]);
                        if self.filled[brick as usize].load(Relaxed) == 0 {
                            continue;
                        }
                        let cube = self.cube([i, j, k].map(|i| i * BRICK), BRICK);
                        if !stays_out(task.tool, &moment, cube.centre, cube.radius) {
                            pairs.push(Pair { brick, task: number, node });
                        }
                    }
                }
            }
        }
        pairs
    }

    /// Goes through the moves near a brick.
    pub(super) fn check(
        &self,
        stock: &TriDexel,
        tasks: &[Task],
        pairs: &[Pair],
        progress: &dyn Progress,
    ) -> Found {
        let mut found = Found::default();
        if progress.cancelled() {
            return found;
        }
        let (brick, [x, y, _]) = (pairs[0].brick, self.counts);
        let first = [brick % x, brick / x % y, brick / (x * y)].map(|i| i * BRICK);
        let cube = self.cube(first, BRICK);
        for group in pairs.chunk_by(|a, b| a.task == b.task) {
            let mut moments = Moments::of(&tasks[group[0].task as usize]);
            for pair in group {
                self.divide(stock, &cube, pair, &mut moments, &mut found);
            }
        }
        found
    }

    /// Divides a cube and a stretch of a move until they are parted or the cube is a block.
    fn divide(&self, stock: &TriDexel, cube: &Cube, pair: &Pair, moments: &mut Moments, found: &mut Found) {
        if !self.has_material(cube) {
            return;
        }
        let moment = moments.at(pair.node);
        found.checked.boxes += 1;
        if stays_out(moments.task.tool, &moment, cube.centre, cube.radius) {
            return;
        }
        if moment.travel > 2.0 * cube.radius {
            for node in [2 * pair.node, 2 * pair.node + 1] {
                self.divide(stock, cube, &Pair { node, ..*pair }, moments, found);
            }
            return;
        }
        if cube.size == BLOCK {
            return self.lines(stock, cube, pair, moments, found);
        }
        let half = cube.size / 2;
        let starts = |k: usize| {
            [cube.first[k], cube.first[k] + half].into_iter().filter(move |i| *i < self.lattice.counts[k])
        };
        for k in starts(2) {
            for j in starts(1) {
                for i in starts(0) {
                    self.divide(stock, &self.cube([i, j, k], half), pair, moments, found);
                }
            }
        }
    }

    /// Goes through the lines of a block.
    fn lines(&self, stock: &TriDexel, cube: &Cube, pair: &Pair, moments: &mut Moments, found: &mut Found) {
        for axis in Axis::ALL {
            let (u, v) = axis.others();
            let [low, high] = self.window(axis, cube.first[axis.index()], cube.size);
            let ends = |k: usize| cube.first[k]..(cube.first[k] + cube.size).min(self.lattice.counts[k]);
            for b in ends(v.index()) {
                for a in ends(u.index()) {
                    let mut start = DVec3::ZERO;
                    start[u.index()] = self.lattice.coordinate(u, a) + LINE_OFFSET;
                    start[v.index()] = self.lattice.coordinate(v, b) + LINE_OFFSET;
                    let ray = Ray { start, along: axis.index() };
                    for interval in stock.line(axis, a, b) {
                        let stretch = [unfixed(interval.lo.at).max(low), unfixed(interval.hi.at).min(high)];
                        for (i, part) in moments.task.tool.parts.iter().enumerate() {
                            let line = OnLine { axis, line: [a, b], ray, face: i as u8 };
                            line.clear(stretch, part, pair, moments, found);
                        }
                    }
                }
            }
        }
    }
}

/// A line, and the number of the part that is looked for on it.
struct OnLine {
    axis: Axis,
    line: [u32; 2],
    ray: Ray,
    face: u8,
}

impl OnLine {
    /// Takes the part out of a stretch of the line wherever it is met.
    fn clear(
        &self,
        stretch: [f64; 2],
        part: &GaugePart,
        pair: &Pair,
        moments: &mut Moments,
        found: &mut Found,
    ) {
        let mut open = vec![stretch];
        while let Some([from, to]) = open.pop() {
            if from >= to {
                continue;
            }
            let met = meets(&self.ray, [from, to], part, moments, pair.node, &mut found.checked);
            let Some(met) = met else { continue };
            let (ends, normals) = chord(&self.ray, part, moments.task, &met);
            found.checked.taken += 1;
            found.checked.deepest = found.checked.deepest.max(met.depth);
            found.stretches.push(Stretch {
                task: pair.task,
                axis: self.axis,
                line: self.line,
                ends: ends.map(fixed),
                normals,
                faces: [self.face; 2],
            });
            open.extend([[from, ends[0]], [ends[1], to]]);
        }
    }
}

/// The bit of the block of a lattice point in its brick.
fn block(at: [u32; 3]) -> u64 {
    let [i, j, k] = at.map(|i| i % BRICK / BLOCK);
    1 << ((k * BLOCK + j) * BLOCK + i)
}
