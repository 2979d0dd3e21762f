//! The surface over time: squares between points of the lattice that go in different ticks.

use std::collections::HashMap;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::pieces::{Piece, TileLinePieces, TilePieces};
use super::{Playback, THIN};
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, Lattice, TriDexel, fixed, unfixed};

/// The tick of what remains.
pub const REMAINS: u16 = u16::MAX;

/// Ticks below which a state of the surface between two changes is not shown by itself.
const BRIEF: u16 = 3;
/// Bits of a corner for the tick up to which it is there.
const TICK_BITS: u32 = 16;

/// A square of surface, there from the end of the tick `from` to that of the tick `to`; from 0: of the raw stock; to [`REMAINS`]: of
/// the finished part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlayedFace {
    /// Corners, seen from outside against the clock.
    pub corners: [u32; 4],
    /// The tick in which what covers it goes.
    pub from: u16,
    /// The tick in which it goes itself.
    pub to: u16,
}

/// The surface of a stock over time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlayedSurface {
    /// Distance of the points of its lattice [mm].
    pub step: f64,
    /// Number of ticks: see [`Clock`](super::Clock).
    pub ticks: u16,
    /// Corners of faces [mm], in the order in which the faces first need them.
    pub vertices: Vec<[f32; 3]>,
    /// Faces by the ticks in which they come.
    pub faces: Vec<PlayedFace>,
}

pub(super) fn surface(playback: Playback, stock: &TriDexel, most: usize) -> PlayedSurface {
    let mut ticks = Ticks::new(playback, stock);
    loop {
        let faces = ticks.faces();
        if faces.len() <= most || ticks.count() == 1 {
            return ticks.surface(&faces);
        }
        ticks.lengthen();
    }
}

/// A face with its corners as cells of the lattice and the last ticks in which they are there.
type CellFace = ([u64; 4], [u16; 2]);

/// When each point of the lattice goes, with a border of points that never were.
struct Ticks {
    lattice: Lattice,
    /// Number of points with the border along each axis, and how far neighbours lie apart in `nodes`.
    counts: [usize; 3],
    strides: [usize; 3],
    nodes: Vec<u16>,
    grids: [(Grid, Vec<TileLinePieces>); 3],
    /// Number of ticks of the clock.
    all: u16,
    /// Ticks of the clock that are one here, and in `nodes`.
    shared: u16,
}

impl Ticks {
    fn new(playback: Playback, stock: &TriDexel) -> Ticks {
        let lattice = playback.lattice;
        let counts = lattice.counts.map(|n| n as usize + 2);
        let strides = [counts[1] * counts[2], counts[2], 1];
        let mut nodes = vec![0; counts.iter().product()];
        let [x, y, z] = lattice.counts.map(|n| n as usize);
        for i in 0..x {
            for j in 0..y {
                let (from, to) = ((i * y + j) * z, (i + 1) * strides[0] + (j + 1) * strides[1] + 1);
                nodes[to..to + z].copy_from_slice(&playback.nodes[from..from + z]);
                for interval in stock.grid(Axis::Z).line(i as u32, j as u32) {
                    let inside = |k: &usize| {
                        let at = fixed(lattice.coordinate(Axis::Z, *k as u32));
                        interval.lo.at <= at && at < interval.hi.at
                    };
                    let about = (unfixed(interval.lo.at) - lattice.origin.z) / lattice.step;
                    let first = (about.max(0.0) as usize).saturating_sub(1);
                    for k in (first..z).skip_while(|k| !inside(k)).take_while(inside) {
                        nodes[to + k] = REMAINS;
                    }
                }
            }
        }
        let thin = fixed(THIN * lattice.step);
        let all = playback.clock.ticks();
        let mut pieces = playback.pieces.into_iter();
        let grids = Axis::ALL.map(|axis| {
            let grid = stock.grid(axis);
            let own: Vec<TilePieces> = pieces.next().unwrap_or_default();
            let one = |(t, own): (usize, TilePieces)| {
                let (_, size) = grid.tile_lines(t);
                let lines = (0..size[1]).flat_map(|b| (0..size[0]).map(move |a| b * TILE_EDGE + a));
                let rest = lines.flat_map(|line| {
                    let of = grid.tiles[t].line(line as usize).iter();
                    of.map(move |i| Piece { ends: [i.lo.at, i.hi.at], line: line as u16, tick: REMAINS })
                });
                own.with_rest(rest, thin)
            };
            (grid.without_lines(), own.into_par_iter().enumerate().map(one).collect())
        });
        Ticks { lattice, counts, strides, nodes, grids, all, shared: 1 }
    }

    /// Number of ticks.
    fn count(&self) -> u16 {
        self.all.div_ceil(self.shared)
    }

    /// A tick of the clock as it is counted here.
    fn tick(&self, tick: u16) -> u16 {
        if tick == REMAINS { REMAINS } else { tick.div_ceil(self.shared) }
    }

    /// Makes two ticks one.
    fn lengthen(&mut self) {
        self.shared *= 2;
        for tick in self.nodes.iter_mut().filter(|tick| **tick != REMAINS) {
            *tick = tick.div_ceil(2);
        }
    }

    /// All faces, in the order in which they come.
    fn faces(&self) -> Vec<CellFace> {
        let slab = |i: usize| {
            let mut faces = Vec::new();
            for node in i * self.strides[0]..(i + 1) * self.strides[0] {
                for axis in Axis::ALL {
                    let next = node + self.strides[axis.index()];
                    if self.nodes.get(next).is_some_and(|tick| *tick != self.nodes[node]) {
                        self.faces_between(axis, node, &mut faces);
                    }
                }
            }
            faces
        };
        let slabs: Vec<Vec<CellFace>> = (0..self.counts[0]).into_par_iter().map(slab).collect();
        // Sorted by counting.
        let mut starts = vec![0; usize::from(self.count()) + 2];
        for (_, [from, _]) in slabs.iter().flatten() {
            starts[usize::from(*from) + 1] += 1;
        }
        for from in 1..starts.len() {
            starts[from] += starts[from - 1];
        }
        let mut faces = vec![([0; 4], [0; 2]); starts[starts.len() - 1]];
        for face in slabs.into_iter().flatten() {
            let start = &mut starts[usize::from(face.1[0])];
            faces[*start] = face;
            *start += 1;
        }
        faces
    }

    /// The faces between a point and the next along an axis: one for each state of its surroundings that is not brief.
    fn faces_between(&self, axis: Axis, node: usize, faces: &mut Vec<CellFace>) {
        let [low, high] = [self.nodes[node], self.nodes[node + self.strides[axis.index()]]];
        let (from, to) = (low.min(high), low.max(high));
        let (b, c) = axis.others();
        let [b, c] = [b, c].map(|axis| self.strides[axis.index()]);
        let mut cells = [node - b - c, node - c, node, node - b];
        let mut changes = vec![from, to];
        for cell in cells {
            changes.extend(self.corners(cell).filter(|tick| from < *tick && *tick < to));
        }
        changes.sort_unstable();
        changes.dedup();
        if high > low {
            cells.reverse();
        }
        for (lives, now) in lives(&changes) {
            faces.push((cells.map(|cell| self.corner(cell, now)), lives));
        }
    }

    /// The ticks of the corners of a cell, which is named by its least one.
    fn corners(&self, cell: usize) -> impl Iterator<Item = u16> + '_ {
        let [x, y, z] = self.strides;
        [0, x, y, z, x + y, y + z, x + z, x + y + z].into_iter().map(move |by| self.nodes[cell + by])
    }

    /// The corner of faces that a cell has in a tick: the cell, and the last tick before its next change.
    fn corner(&self, cell: usize, now: u16) -> u64 {
        let next = self.corners(cell).filter(|tick| *tick > now).min().unwrap_or(REMAINS);
        (cell as u64) << TICK_BITS | u64::from(next - 1)
    }

    fn surface(&self, faces: &[CellFace]) -> PlayedSurface {
        // Corners by their first use.
        let mut numbers: HashMap<u64, u32> = HashMap::with_capacity(faces.len() + faces.len() / 4);
        let mut keys = Vec::with_capacity(numbers.capacity());
        let mut number = |key: u64| {
            *numbers.entry(key).or_insert_with(|| {
                keys.push(key);
                keys.len() as u32 - 1
            })
        };
        let one = |(corners, [from, to]): &CellFace| PlayedFace {
            corners: corners.map(&mut number),
            from: *from,
            to: *to,
        };
        PlayedSurface {
            step: self.lattice.step,
            ticks: self.count(),
            faces: faces.iter().map(one).collect(),
            vertices: keys.par_iter().map(|key| self.vertex(*key)).collect(),
        }
    }

    /// The place of a corner: in the middle of the places where the edges of its cell cross the surface.
    fn vertex(&self, key: u64) -> [f32; 3] {
        let (cell, now) = ((key >> TICK_BITS) as usize, key as u16);
        let mut sum = [0.0; 3];
        let mut count = 0.0;
        for axis in Axis::ALL {
            let (b, c) = axis.others();
            let [along, b, c] = [axis, b, c].map(|axis| self.strides[axis.index()]);
            for node in [cell, cell + b, cell + c, cell + b + c] {
                let [low, high] = [node, node + along].map(|node| self.nodes[node] > now);
                if low != high {
                    let mut point = self.place(node);
                    point[axis.index()] = self.crossing(axis, node, now, low);
                    (0..3).for_each(|k| sum[k] += point[k]);
                    count += 1.0;
                }
            }
        }
        if count == 0.0 {
            // Not the case of a corner of a face: its cell has an edge that crosses the surface.
            return self.place(cell).map(|v| v as f32);
        }
        sum.map(|v| (v / count) as f32)
    }

    /// Indices of a point along the axes, counted with the border.
    fn indices(&self, node: usize) -> [usize; 3] {
        let [x, y, _] = self.strides;
        [node / x, node % x / y, node % y]
    }

    /// A point of the lattice [mm].
    fn place(&self, node: usize) -> [f64; 3] {
        let at = self.indices(node);
        [0, 1, 2].map(|k| self.lattice.origin[k] + (at[k] as f64 - 1.0) * self.lattice.step)
    }

    /// Place of the surface in a tick between a point and the next along an axis [mm]; `low`: the first of the two is material.
    fn crossing(&self, axis: Axis, node: usize, now: u16, low: bool) -> f64 {
        let (a, b) = axis.others();
        let at = self.indices(node);
        let [i, j] = [a, b].map(|axis| at[axis.index()] as u32 - 1);
        let (grid, tiles) = &self.grids[axis.index()];
        let across = grid.tiles_across()[0];
        let tile = &tiles[(j / TILE_EDGE * across + i / TILE_EDGE) as usize];
        let pieces = tile.line((j % TILE_EDGE * TILE_EDGE + i % TILE_EDGE) as usize);
        let from = self.place(node)[axis.index()];
        let to = from + self.lattice.step;
        let middle = 0.5 * (from + to);
        let inside = fixed(if low { from } else { to });
        let Some(mut k) = pieces.partition_point(|piece| piece.ends[0] <= inside).checked_sub(1) else {
            return middle;
        };
        let remains = |piece: &Piece| self.tick(piece.tick) > now;
        if pieces[k].ends[1] <= inside || !remains(&pieces[k]) {
            return middle;
        }
        if low {
            while pieces.get(k + 1).is_some_and(|next| remains(next) && next.ends[0] <= pieces[k].ends[1]) {
                k += 1;
            }
            return unfixed(pieces[k].ends[1]).min(to);
        }
        while k > 0 && remains(&pieces[k - 1]) && pieces[k - 1].ends[1] >= pieces[k].ends[0] {
            k -= 1;
        }
        unfixed(pieces[k].ends[0]).max(from)
    }
}

/// The times between changes, brief ones with those before or after them; each with a tick of the longest time in it.
fn lives(changes: &[u16]) -> impl Iterator<Item = ([u16; 2], u16)> {
    let mut all: Vec<([u16; 2], u16)> = Vec::new();
    // Length of the longest time of the last life.
    let mut longest = 0;
    for pair in changes.windows(2) {
        let length = pair[1] - pair[0];
        match all.last_mut() {
            Some((life, now)) if length < BRIEF || longest < BRIEF => {
                life[1] = pair[1];
                if length > longest {
                    (*now, longest) = (pair[1] - 1, length);
                }
            }
            _ => {
                all.push(([pair[0], pair[1]], pair[1] - 1));
                longest = length;
            }
        }
    }
    all.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brief_times_go_with_longer_ones() {
        let lives = |changes: &[u16]| lives(changes).collect::<Vec<_>>();
        assert_eq!(lives(&[4, 5]), [([4, 5], 4)]);
        assert_eq!(
            lives(&[0, 1, 2, 90, 91, 100, REMAINS]),
            [([0, 91], 89), ([91, 100], 99), ([100, REMAINS], REMAINS - 1)]
        );
    }
}
