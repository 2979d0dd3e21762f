//! The stock in bricks of 16 x 16 x 16 lines, in piles of 4 x 4 x 4 bricks, and the cells that a brick is divided into.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use glam::DVec3;
use rayon::prelude::*;

use super::borders::Borders;
use super::near::SweptPart;
use super::places::Places;
use crate::base::Progress;
use crate::geom::Aabb;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel, unfixed};

/// Lines along an edge of a brick.
pub(super) const BRICK: u32 = TILE_EDGE;
/// Bricks along an edge of a pile; those of a pile are the bits of a word.
const PILE: u32 = 4;

/// A box of lattice points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Indices of the first points, and behind the last ones.
    pub(super) first: [u32; 3],
    pub(super) end: [u32; 3],
    /// Corners [mm].
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    pub(super) centre: DVec3,
    /// Half a diagonal [mm].
    pub(super) radius: f64,
}

/// The bricks of a stock, with those that may have material.
pub(in super::super) struct Cells {
    lattice: Lattice,
    bounds: Aabb,
    /// Number of bricks, and of piles.
    bricks: [u32; 3],
    piles: [u32; 3],
    /// Middles and half widths of the bricks, and of the piles, along each coordinate [mm].
    middles: [Vec<[f64; 2]>; 3],
    middles_of_piles: [Vec<[f64; 2]>; 3],
    /// By pile: a bit for each brick that may have material.
    filled: Vec<AtomicU64>,
    /// The borders at which ends of lines are wanted; without them everywhere.
    borders: Option<Arc<Borders>>,
}

/// For each brick the swept parts near it, in their order.
pub(super) struct Near {
    /// Index behind the last of the swept parts that were asked about.
    pub(super) end: usize,
    starts: Vec<usize>,
    list: Vec<u32>,
}

/// Room for what is asked of a swept part at once: piles, and the bricks of one.
#[derive(Default)]
pub(super) struct Room {
    piles: Places,
    bricks: Places,
}

/// Middle and half a diagonal of a box by its indices, from the middles and half widths along each coordinate.
fn round_box(indices: [u32; 3], middles: &[Vec<[f64; 2]>; 3]) -> [f64; 4] {
    let [x, y, z] = std::array::from_fn(|k| middles[k][indices[k] as usize]);
    [x[0], y[0], z[0], (x[1] * x[1] + y[1] * y[1] + z[1] * z[1]).sqrt()]
}

/// What some swept parts find: pairs of brick and part, and bricks that are swallowed.
#[derive(Default)]
struct Found {
    pairs: Vec<(u32, u32)>,
    swallowed: Vec<u32>,
}

impl Near {
    pub(super) fn of(&self, brick: u32) -> &[u32] {
        &self.list[self.starts[brick as usize]..self.starts[brick as usize + 1]]
    }
}

impl Cells {
    /// The bricks of a stock.
    pub(in super::super) fn new(stock: &TriDexel) -> Cells {
        let cells = Cells::without_material(stock.lattice(), stock.bounds());
        for grid in &stock.grids {
            (0..grid.tiles.len()).into_par_iter().for_each(|tile| cells.fill(grid, tile));
        }
        // What its lines across do not know yet.
        if let Some(owed) = &stock.owed {
            owed.swallowed().for_each(|brick| cells.clear(brick));
        }
        cells
    }

    /// The bricks of a lattice over a box, none with material.
    pub(super) fn without_material(lattice: &Lattice, bounds: Aabb) -> Cells {
        let lattice = *lattice;
        let bricks = lattice.counts.map(|n| n.div_ceil(BRICK));
        let piles = bricks.map(|n| n.div_ceil(PILE));
        let filled = (0..piles.iter().product::<u32>()).map(|_| AtomicU64::new(0)).collect();
        let none = [const { Vec::new() }; 3];
        let (middles, middles_of_piles) = (none.clone(), none);
        let mut cells =
            Cells { lattice, bounds, bricks, piles, middles, middles_of_piles, filled, borders: None };
        let middles = |edge: u32, counts: [u32; 3]| {
            std::array::from_fn(|k| {
                let middle = |i: u32| {
                    let [low, high] = [i, i + 1].map(|i| cells.border(k, i * edge));
                    [0.5 * (low + high), 0.5 * (high - low)]
                };
                (0..counts[k]).map(middle).collect()
            })
        };
        (cells.middles, cells.middles_of_piles) = (middles(BRICK, bricks), middles(BRICK * PILE, piles));
        cells
    }

    /// The same where ends of lines are wanted only between some points.
    pub(super) fn within(lattice: &Lattice, bounds: Aabb, borders: Option<&Arc<Borders>>) -> Cells {
        Cells { borders: borders.cloned(), ..Cells::without_material(lattice, bounds) }
    }

    /// Whether ends of lines along an axis are wanted in a cell.
    pub(super) fn wants(&self, cell: &Cell, axis: Axis) -> bool {
        self.borders.as_ref().is_none_or(|borders| borders.wants(cell, axis))
    }

    /// Notes that a brick may have material.
    pub(super) fn note(&self, brick: u32) {
        let (pile, bit) = self.place(self.indices(brick));
        self.filled[pile].fetch_or(1 << bit, Relaxed);
    }

    /// Notes the bricks in which the lines of a tile have material.
    fn fill(&self, grid: &Grid, tile: usize) {
        let (first, size) = grid.tile_lines(tile);
        let (along, (a, b)) = (grid.axis.index(), grid.axis.others());
        let mut filled = vec![false; self.bricks[along] as usize];
        let lines = if grid.tiles[tile].is_alike() { [1, 1] } else { size };
        for l in (0..lines[1]).flat_map(|j| (0..lines[0]).map(move |i| (j * TILE_EDGE + i) as usize)) {
            for interval in grid.tiles[tile].line(l) {
                // One step more on either side: rounding.
                let brick = |at: f64| (self.index(along, at) / BRICK) as usize;
                let (from, to) = (unfixed(interval.lo.at - 1), unfixed(interval.hi.at + 1));
                filled[brick(from)..=brick(to)].fill(true);
            }
        }
        let mut brick = [0; 3];
        (brick[a.index()], brick[b.index()]) = (first[0] / BRICK, first[1] / BRICK);
        for (i, _) in filled.iter().enumerate().filter(|(_, filled)| **filled) {
            brick[along] = i as u32;
            let (pile, bit) = self.place(brick);
            self.filled[pile].fetch_or(1 << bit, Relaxed);
        }
    }

    /// Index of the lattice point to whose cell a coordinate belongs; of the nearest one when it is outside.
    fn index(&self, k: usize, at: f64) -> u32 {
        let i = (at - self.lattice.origin[k]) / self.lattice.step + 0.5;
        (i.max(0.0) as u32).min(self.lattice.counts[k] - 1)
    }

    /// Pile and bit of a brick.
    fn place(&self, brick: [u32; 3]) -> (usize, u32) {
        let [x, y, z] = brick.map(|i| i / PILE);
        let [i, j, k] = brick.map(|i| i % PILE);
        (((z * self.piles[1] + y) * self.piles[0] + x) as usize, (k * PILE + j) * PILE + i)
    }

    /// Indices of a brick.
    fn indices(&self, brick: u32) -> [u32; 3] {
        let [x, y, _] = self.bricks;
        [brick % x, brick / x % y, brick / (x * y)]
    }

    /// Number of bricks.
    pub(super) fn count(&self) -> usize {
        self.bricks.iter().product::<u32>() as usize
    }

    /// The bricks along an axis, at indices of bricks along the two others in cyclic order.
    pub(super) fn along(&self, axis: Axis, a: u32, b: u32) -> impl Iterator<Item = u32> + '_ {
        let (others, mut brick) = (axis.others(), [0; 3]);
        (brick[others.0.index()], brick[others.1.index()]) = (a, b);
        (0..self.bricks[axis.index()]).map(move |i| {
            brick[axis.index()] = i;
            self.number(brick)
        })
    }

    fn number(&self, [i, j, k]: [u32; 3]) -> u32 {
        (k * self.bricks[1] + j) * self.bricks[0] + i
    }

    /// The border before a lattice point [mm].
    fn border(&self, k: usize, i: u32) -> f64 {
        if i == 0 {
            self.bounds.min[k]
        } else if i >= self.lattice.counts[k] {
            self.bounds.max[k]
        } else {
            self.lattice.origin[k] + (f64::from(i) - 0.5) * self.lattice.step
        }
    }

    /// The cell that begins at lattice points, with at most `size` along each edge.
    pub(super) fn cell(&self, first: [u32; 3], size: u32) -> Cell {
        let end: [u32; 3] = std::array::from_fn(|k| (first[k] + size).min(self.lattice.counts[k]));
        let corner = |of: [u32; 3]| DVec3::from_array(std::array::from_fn(|k| self.border(k, of[k])));
        let (low, high) = (corner(first), corner(end));
        Cell { first, end, low, high, centre: (low + high) * 0.5, radius: 0.5 * low.distance(high) }
    }

    /// The cell of a brick.
    pub(super) fn of_brick(&self, brick: u32) -> Cell {
        self.cell(self.indices(brick).map(|i| i * BRICK), BRICK)
    }

    pub(super) fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// True if a brick may have material.
    pub(super) fn has_material(&self, brick: u32) -> bool {
        let (pile, bit) = self.place(self.indices(brick));
        self.filled[pile].load(Relaxed) >> bit & 1 == 1
    }

    /// Notes that a brick has no material.
    pub(super) fn clear(&self, brick: u32) {
        let (pile, bit) = self.place(self.indices(brick));
        self.filled[pile].fetch_and(!(1 << bit), Relaxed);
    }

    /// The bricks that may have material, pile by pile; the piles scattered, so that threads seldom meet on a tile of lines.
    pub(super) fn bricks_with_material(&self) -> Vec<u32> {
        /// Odd, and with bits all over: near 2^32 over the golden ratio.
        const SCATTER: u32 = 0x9e37_79b9;
        let mut bricks: Vec<u32> =
            (0..self.bricks.iter().product()).filter(|brick| self.has_material(*brick)).collect();
        bricks.sort_by_cached_key(|brick| (self.place(self.indices(*brick)).0 as u32).wrapping_mul(SCATTER));
        bricks
    }

    /// Calls for each brick that may have material and that a swept part may reach, with a bound on its reach beyond the middle [mm].
    pub(super) fn each_near(&self, room: &mut Room, swept: &SweptPart, mut found: impl FnMut(u32, f64)) {
        if !swept.bounds.meets(self.bounds) {
            return;
        }
        let Room { piles, bricks } = room;
        piles.clear();
        let mut of_piles = |piles: &mut Places| {
            piles.ask(swept);
            piles.each_reached(&mut |pile, _| {
                bricks.clear();
                self.each_brick(pile, |brick, numbers| bricks.add(brick, numbers));
                bricks.ask(swept);
                bricks.each_reached(&mut found);
            });
            piles.clear();
        };
        let edge = BRICK * PILE;
        let from: [u32; 3] = std::array::from_fn(|k| self.index(k, swept.bounds.min[k]) / edge);
        let to: [u32; 3] = std::array::from_fn(|k| self.index(k, swept.bounds.max[k]) / edge);
        for z in from[2]..=to[2] {
            for y in from[1]..=to[1] {
                for x in from[0]..=to[0] {
                    let pile = (z * self.piles[1] + y) * self.piles[0] + x;
                    if self.filled[pile as usize].load(Relaxed) == 0 {
                        continue;
                    }
                    if piles.is_full() {
                        of_piles(piles);
                    }
                    piles.add(pile, round_box([x, y, z], &self.middles_of_piles));
                }
            }
        }
        of_piles(piles);
    }

    /// Calls for each brick of a pile that may have material, with its middle and half the diagonal of the largest of them.
    fn each_brick(&self, pile: u32, mut each: impl FnMut(u32, [f64; 4])) {
        let [across, deep, _] = self.piles;
        let first = [pile % across, pile / across % deep, pile / (across * deep)].map(|i| i * PILE);
        let middles: [&[[f64; 2]]; 3] = std::array::from_fn(|k| {
            let all = &self.middles[k];
            &all[first[k] as usize..all.len().min((first[k] + PILE) as usize)]
        });
        let widest = middles.map(|some| some.iter().fold(0.0, |most: f64, [_, half]| most.max(*half)));
        let radius = DVec3::from_array(widest).length();
        let number = self.number(first);
        let mut filled = self.filled[pile as usize].load(Relaxed);
        while filled != 0 {
            let bit = filled.trailing_zeros();
            filled &= filled - 1;
            let [i, j, k] = [bit % PILE, bit / PILE % PILE, bit / (PILE * PILE)];
            let [x, y, z] = [middles[0][i as usize], middles[1][j as usize], middles[2][k as usize]];
            each(number + self.number([i, j, k]), [x[0], y[0], z[0], radius]);
        }
    }

    /// The swept parts near each brick, from one of them on as many as there is room for; bricks that one of them swallows are cleared,
    /// and have none.
    pub(super) fn near(&self, swept: &[SweptPart], from: usize, progress: &dyn Progress) -> Near {
        /// Swept parts that a thread takes at once, and that are taken before bricks are cleared and it is asked whether there is room
        /// for more.
        const CHUNK: usize = 64;
        const WAVE: usize = 8 * CHUNK;
        /// Pairs of brick and part, eight bytes each.
        const MOST: usize = 8_000_000;
        let mut pairs: Vec<Vec<(u32, u32)>> = Vec::new();
        let (mut end, mut count) = (from, 0);
        while end < swept.len() && count < MOST {
            let some = &swept[end..swept.len().min(end + WAVE)];
            let chunk = |(n, some): (usize, &[SweptPart])| {
                let (mut found, mut room) = (Found::default(), Room::default());
                if !progress.cancelled() {
                    for (i, one) in some.iter().enumerate() {
                        self.each_near(&mut room, one, |brick, reach| {
                            let swallowed = reach > 0.0 && {
                                let cell = self.of_brick(brick);
                                reach > cell.radius && one.swallows(&cell)
                            };
                            if swallowed {
                                found.swallowed.push(brick);
                            } else {
                                found.pairs.push((brick, (end + n * CHUNK + i) as u32));
                            }
                        });
                    }
                }
                found
            };
            let found: Vec<Found> = some.par_chunks(CHUNK).enumerate().with_max_len(1).map(chunk).collect();
            for Found { pairs: some, swallowed } in found {
                count += some.len();
                pairs.push(some);
                // After all of them were asked: what is found does not depend on who comes first.
                swallowed.into_iter().for_each(|brick| self.clear(brick));
            }
            end += some.len();
        }
        for some in &mut pairs {
            some.retain(|(brick, _)| self.has_material(*brick));
        }
        let mut starts = vec![0; self.bricks.iter().product::<u32>() as usize + 1];
        for (brick, _) in pairs.iter().flatten() {
            starts[*brick as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut list = vec![0; starts[starts.len() - 1]];
        for (brick, one) in pairs.iter().flatten() {
            list[next[*brick as usize]] = *one;
            next[*brick as usize] += 1;
        }
        Near { end, starts, list }
    }
}
