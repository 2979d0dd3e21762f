//! One bit for each lattice point: material or not, by majority of the three lines through it.
//!
//! Rows run along X. Lines along Y and Z set a bit where an interval begins and where it ends; the running
//! exclusive-or over the rows then is their inside: a word operation settles 64 points.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use rayon::prelude::*;

use super::crossing::Lines;
use crate::base::Progress;
use crate::stock::{Axis, DexelGrid};

/// The signs of all padded lattice points.
pub(super) struct Signs {
    /// Padded points along X, Y, Z.
    counts: [u32; 3],
    /// Words in a row; the last bit of a row is never set.
    width: usize,
    /// Rows: all Z of Y = 0, all Z of Y = 1, ... Each word is written by one task.
    words: Vec<AtomicU64>,
}

impl Signs {
    /// Majority of the three directions at each point; of no use when it was cancelled.
    pub(super) fn vote<G: DexelGrid + ?Sized>(lines: &Lines<'_, G>, progress: &dyn Progress) -> Signs {
        let counts = lines.counts;
        let width = width(counts[0].into()) as usize;
        let [_, ny, nz] = counts.map(|n| n as usize);
        // By all threads: the first write to memory is what it costs.
        let words: Vec<AtomicU64> =
            (0..width * ny * nz).into_par_iter().map(|_| AtomicU64::default()).collect();
        let signs = Signs { counts, width, words };
        // The lines along Z, one Y after the other.
        (0..counts[1]).into_par_iter().for_each_init(
            || vec![0u64; width * nz],
            |rows, y| {
                if progress.cancelled() {
                    return;
                }
                rows.fill(0);
                for x in 1..counts[0] - 1 {
                    for i in lines.line(Axis::Z, x, y) {
                        for at in [i.lo.at, i.hi.at] {
                            toggle(&mut rows[lines.first_at_or_above(Axis::Z, at) as usize * width..], x);
                        }
                    }
                }
                run(rows, width);
                // The last layer of the padding holds the ends beyond the lattice.
                for z in 1..nz - 1 {
                    for (word, row) in signs.row(y, z as u32).iter().zip(&rows[z * width..]) {
                        word.store(*row, Relaxed);
                    }
                }
            },
        );
        // The lines along X and Y, one Z after the other.
        (1..counts[2] - 1).into_par_iter().for_each_init(
            || (vec![0u64; width * ny], vec![0u64; width]),
            |(rows, row), z| {
                if progress.cancelled() {
                    return;
                }
                rows.fill(0);
                for x in 1..counts[0] - 1 {
                    // Lines along Y are numbered along Z, X.
                    for i in lines.line(Axis::Y, z, x) {
                        for at in [i.lo.at, i.hi.at] {
                            toggle(&mut rows[lines.first_at_or_above(Axis::Y, at) as usize * width..], x);
                        }
                    }
                }
                run(rows, width);
                for y in 1..counts[1] - 1 {
                    row.fill(0);
                    for i in lines.line(Axis::X, y, z) {
                        let from = lines.first_at_or_above(Axis::X, i.lo.at);
                        let to = lines.first_at_or_above(Axis::X, i.hi.at);
                        fill(row, from as usize, to as usize);
                    }
                    let along_y = &rows[y as usize * width..];
                    for ((word, a), b) in signs.row(y, z).iter().zip(row.iter()).zip(along_y) {
                        let c = word.load(Relaxed);
                        word.store(a & b | c & (a | b), Relaxed);
                    }
                }
            },
        );
        signs
    }

    /// Memory of the signs by the number of padded points [bytes].
    pub(super) fn bytes(counts: [u64; 3]) -> u64 {
        width(counts[0]) * counts[1] * counts[2] * size_of::<AtomicU64>() as u64
    }

    /// Padded points along X, Y, Z.
    pub(super) fn counts(&self) -> [u32; 3] {
        self.counts
    }

    fn row(&self, y: u32, z: u32) -> &[AtomicU64] {
        let start = (y as usize * self.counts[2] as usize + z as usize) * self.width;
        &self.words[start..start + self.width]
    }

    /// The signs of the 17^3 points of a block from a point on, whose X is a multiple of 16: bit x of row 17 z + y.
    /// Points beyond the lattice are not material.
    pub(super) fn read_block(&self, [x, y, z]: [u32; 3], rows: &mut [u32; 17 * 17]) {
        let (word, shift) = (x as usize / 64, x % 64);
        let [_, ny, nz] = self.counts.map(|n| n as usize);
        rows.fill(0);
        for j in 0..17.min(ny - y as usize) {
            let first = (y as usize + j) * nz + z as usize;
            for k in 0..17.min(nz - z as usize) {
                let row = &self.words[(first + k) * self.width..][..self.width];
                let low = row[word].load(Relaxed) >> shift;
                let high = match row.get(word + 1) {
                    Some(next) if shift == 48 => next.load(Relaxed) << 16,
                    _ => 0,
                };
                rows[17 * k + j] = (low | high) as u32 & 0x1_ffff;
            }
        }
    }

    /// The signs of the eight corners of a cell, bit x + 2 y + 4 z.
    pub(super) fn corners(&self, cell: [u32; 3]) -> u8 {
        let mut bits = 0;
        for (n, (y, z)) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().enumerate() {
            let row = self.row(cell[1] + y, cell[2] + z);
            let bit = |x: u32| (row[x as usize / 64].load(Relaxed) >> (x % 64)) as u8 & 1;
            bits |= (bit(cell[0]) | bit(cell[0] + 1) << 1) << (2 * n);
        }
        bits
    }

    /// For each block of 16 cells along X, 16 x 16 cells from `y`, `z` on: the state of its points if all are alike,
    /// else `None`. `found` holds room for the row's blocks.
    pub(super) fn alike(&self, y: u32, z: u32, found: &mut [Option<bool>]) {
        let mut all = vec![u64::MAX; self.width + 1];
        let mut any = vec![0u64; self.width + 1];
        for y in y..=y + 16 {
            for z in z..=z + 16 {
                if y >= self.counts[1] || z >= self.counts[2] {
                    all.fill(0);
                    continue;
                }
                for ((word, all), any) in self.row(y, z).iter().zip(&mut all).zip(&mut any) {
                    let word = word.load(Relaxed);
                    *all &= word;
                    *any |= word;
                }
            }
        }
        all[self.width] = 0;
        for (b, found) in found.iter_mut().enumerate() {
            let (word, shift) = (b / 4, b % 4 * 16);
            let bits =
                |w: &[u64]| (w[word] >> shift | if shift == 48 { w[word + 1] << 16 } else { 0 }) & 0x1_ffff;
            *found = match (bits(&all), bits(&any)) {
                (0x1_ffff, _) => Some(true),
                (_, 0) => Some(false),
                _ => None,
            };
        }
    }
}

/// Words in a row of so many points: one bit beyond, so that 17 bits can be read from any multiple of 16 below the count.
fn width(count: u64) -> u64 {
    count / 64 + 1
}

/// Changes bit `x` of a row.
fn toggle(row: &mut [u64], x: u32) {
    row[x as usize / 64] ^= 1 << (x % 64);
}

/// Replaces each row by the exclusive-or of the rows up to it.
fn run(rows: &mut [u64], width: usize) {
    for start in (width..rows.len()).step_by(width) {
        let (before, now) = rows.split_at_mut(start);
        for (n, b) in now[..width].iter_mut().zip(&before[start - width..]) {
            *n ^= *b;
        }
    }
}

/// Sets the bits `from..to` of a row.
fn fill(row: &mut [u64], from: usize, to: usize) {
    if from >= to {
        return;
    }
    let (first, last) = (from / 64, (to - 1) / 64);
    let head = u64::MAX << (from % 64);
    let tail = u64::MAX >> (63 - (to - 1) % 64);
    if first == last {
        row[first] |= head & tail;
    } else {
        row[first] |= head;
        row[first + 1..last].fill(u64::MAX);
        row[last] |= tail;
    }
}
