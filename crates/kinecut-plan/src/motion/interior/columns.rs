//! Parts of cells, number by number, and their sums unknown by unknown.

use super::block::Parts;
use super::lanes::{LANES, Lanes};

/// Lists of numbers of cells, with a zero before the first cell.
pub(super) struct Columns([Vec<f64>; 18]);

impl Columns {
    pub(super) const GRADIENT: usize = 0;
    pub(super) const PRICES: usize = 3;
    pub(super) const OVER: usize = 6;
    pub(super) const SECOND: usize = 9;
    const MATRIX: usize = 12;

    pub(super) fn new(cells: usize) -> Columns {
        Columns(std::array::from_fn(|_| vec![0.0; cells + 2]))
    }

    /// Notes the parts of a block.
    #[inline(always)]
    pub(super) fn put(&mut self, block: usize, parts: &Parts) {
        self.put_three(Columns::GRADIENT, block, &parts.gradient);
        self.put_three(Columns::PRICES, block, &parts.prices);
        self.put_three(Columns::OVER, block, &parts.over);
        for (list, part) in self.0[Columns::MATRIX..].iter_mut().zip(parts.matrix) {
            part.put(list, LANES * block + 1);
        }
    }

    /// Notes the parts of a block in one sum.
    #[inline(always)]
    pub(super) fn put_three(&mut self, of: usize, block: usize, parts: &[Lanes; 3]) {
        for (list, part) in self.0[of..of + 3].iter_mut().zip(parts) {
            part.put(list, LANES * block + 1);
        }
    }

    /// A sum, unknown by unknown: parts of the cell before it, of its own and of the next one.
    #[inline(always)]
    pub(super) fn three(&self, of: usize, sums: &mut [f64]) {
        let n = sums.len();
        let [next, own, before] = [0, 1, 2].map(|i| &self.0[of + i]);
        let parts = before[..n].iter().zip(&own[1..=n]).zip(&next[2..n + 2]);
        for (sum, ((before, own), next)) in sums.iter_mut().zip(parts) {
            *sum = before + own + next;
        }
    }

    /// The matrix.
    #[inline(always)]
    pub(super) fn matrix(&self, rows: &mut [[f64; 3]]) {
        let of = |i: usize| &self.0[Columns::MATRIX + i];
        for (k, row) in rows.iter_mut().enumerate() {
            *row = [of(5)[k] + of(3)[k + 1] + of(0)[k + 2], of(4)[k + 1] + of(1)[k + 2], of(2)[k + 2]];
        }
    }
}
