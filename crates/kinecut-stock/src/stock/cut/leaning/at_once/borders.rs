//! Between which points of a lattice material begins or ends, as the lines along one axis tell.
//!
//! A picture needs the ends of the lines across that axis between such points only: what is thinner than the lattice does not show in it.

use rayon::prelude::*;

use super::cells::Cell;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, EndPoint, Lattice, fixed};

/// Bits of a word.
const BITS: usize = u64::BITS as usize;

/// Bits for the points of a lattice, in words along one axis.
#[derive(Debug)]
pub(super) struct Borders {
    /// The axis along which the lines are known.
    axis: Axis,
    /// Number of points along the two others, in cyclic order, and of words along a line.
    across: [usize; 2],
    width: usize,
    /// The points with material.
    filled: Vec<u64>,
    /// The points at which a neighbour along the first of the others, or the second, is unlike.
    unlike: [Vec<u64>; 2],
}

impl Borders {
    /// Of the lines of a grid.
    pub(super) fn new(grid: &Grid, lattice: &Lattice) -> Borders {
        let axis = grid.axis;
        let across = grid.counts.map(|n| n as usize);
        let places: Vec<i32> =
            (0..lattice.counts[axis.index()]).map(|k| fixed(lattice.coordinate(axis, k))).collect();
        let width = places.len().div_ceil(BITS);
        let [columns, rows] = across;
        let mut filled = vec![0; width * columns * rows];
        filled.par_chunks_mut(width * columns).enumerate().for_each(|(b, row)| {
            for (a, words) in row.chunks_mut(width).enumerate() {
                for interval in grid.line(a as u32, b as u32) {
                    let [from, to] =
                        [interval.lo.at, interval.hi.at].map(|at| places.partition_point(|p| *p < at));
                    each_word(from..to, |word, bits| words[word] |= bits);
                }
            }
        });
        let line = |a: usize, b: usize| &filled[(b * columns + a) * width..][..width];
        let unlike = [0, 1].map(|k| {
            let mut unlike = vec![0; filled.len()];
            unlike.par_chunks_mut(width * columns).enumerate().for_each(|(b, row)| {
                for (a, words) in row.chunks_mut(width).enumerate() {
                    let place = [a, b];
                    let near = |at: usize| if k == 0 { line(at, b) } else { line(a, at) };
                    let neighbours = [place[k].saturating_sub(1), (place[k] + 1).min(across[k] - 1)];
                    for other in neighbours.map(near) {
                        let both = line(a, b).iter().zip(other);
                        words.iter_mut().zip(both).for_each(|(word, (own, other))| *word |= own ^ other);
                    }
                }
            });
            unlike
        });
        Borders { axis, across, width, filled, unlike }
    }

    /// Takes out of a grid across what lies from the first to the last point of each run of points without material.
    pub(super) fn clear(&self, grid: &mut Grid, lattice: &Lattice) {
        let k = self.direction(grid.axis);
        let shape = grid.without_lines();
        let places: Vec<i32> =
            (0..lattice.counts[grid.axis.index()]).map(|i| fixed(lattice.coordinate(grid.axis, i))).collect();
        let border = |at: i32| EndPoint { at, ..EndPoint::default() };
        grid.tiles.par_iter_mut().enumerate().for_each(|(t, tile)| {
            let (first, size) = shape.tile_lines(t);
            for (i, j) in (0..size[1]).flat_map(|j| (0..size[0]).map(move |i| (i, j))) {
                let index = (j * TILE_EDGE + i) as usize;
                if tile.line(index).is_empty() {
                    continue;
                }
                // Of the others of a line along the first of the two, the first is the second of the two, the second the known axis.
                let [own, other] = [first[0] + i, first[1] + j].map(|n| n as usize);
                let (at, along) = if k == 0 { (own, other) } else { (other, own) };
                let is_filled = |n: usize| self.is_filled(if k == 0 { [n, at] } else { [at, n] }, along);
                let mut from = 0;
                while from < places.len() {
                    if is_filled(from) {
                        from += 1;
                        continue;
                    }
                    let end = (from..places.len()).find(|n| is_filled(*n)).unwrap_or(places.len());
                    let low = if from == 0 { i32::MIN } else { places[from] };
                    let high = if end == places.len() { i32::MAX } else { places[end - 1] };
                    if low < high {
                        tile.subtract(index, border(low), border(high));
                    }
                    from = end;
                }
            }
        });
    }

    /// Whether ends of a line across, along an axis, are wanted in a cell.
    pub(super) fn wants(&self, cell: &Cell, axis: Axis) -> bool {
        let unlike = &self.unlike[self.direction(axis)];
        let [a, b] = [self.axis.others().0, self.axis.others().1].map(Axis::index);
        let along = self.axis.index();
        let points = cell.first[along] as usize..cell.end[along] as usize;
        (cell.first[b]..cell.end[b]).any(|j| {
            (cell.first[a]..cell.end[a]).any(|i| {
                let line = (j as usize * self.across[0] + i as usize) * self.width;
                let mut found = false;
                each_word(points.clone(), |word, bits| found |= unlike[line + word] & bits != 0);
                found
            })
        })
    }

    fn is_filled(&self, [a, b]: [usize; 2], along: usize) -> bool {
        self.filled[(b * self.across[0] + a) * self.width + along / BITS] >> (along % BITS) & 1 == 1
    }

    /// 0 for the first of the two other axes, 1 for the second.
    fn direction(&self, axis: Axis) -> usize {
        usize::from(axis != self.axis.others().0)
    }
}

/// Calls for each word that has some of a range of bits, with these.
fn each_word(range: std::ops::Range<usize>, mut each: impl FnMut(usize, u64)) {
    let mut from = range.start;
    while from < range.end {
        let (word, bit) = (from / BITS, from % BITS);
        let count = (range.end - from).min(BITS - bit);
        each(word, u64::MAX >> (BITS - count) << bit);
        from += count;
    }
}
