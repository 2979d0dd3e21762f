//! The signs of the points of one block, a word for each row along X.

use super::signs::Signs;
use crate::stock::Axis;

/// Cells along an edge of a block.
pub(super) const BLOCK: u32 = 16;
/// Points along an edge of a block.
pub(super) const POINTS: usize = BLOCK as usize + 1;

/// The signs of the 17^3 points of a block: bit x of row z * 17 + y.
pub(super) struct Rows([u32; POINTS * POINTS]);

impl Rows {
    /// All void.
    pub(super) fn new() -> Rows {
        Rows([0; POINTS * POINTS])
    }

    /// Reads the signs of a block.
    pub(super) fn read(&mut self, signs: &Signs, place: [u32; 3]) {
        signs.read_block(place.map(|p| p * BLOCK), &mut self.0);
    }

    /// The row of a y and z.
    #[inline]
    pub(super) fn row(&self, y: u32, z: u32) -> u32 {
        self.0[z as usize * POINTS + y as usize]
    }

    /// The rows of a layer from y on.
    #[inline]
    pub(super) fn layer(&self, y: u32, z: u32, count: usize) -> &[u32] {
        &self.0[z as usize * POINTS + y as usize..][..count]
    }

    /// Bits x of the lower points of the edges along an axis in a row that are crossed, and the row itself: a set
    /// bit there means that the edge leaves the material.
    #[inline]
    pub(super) fn crossed(&self, axis: Axis, y: u32, z: u32) -> (u32, u32) {
        let row = self.row(y, z);
        let next = match axis {
            Axis::X => return ((row ^ row >> 1) & 0xffff, row),
            Axis::Y => self.row(y + 1, z),
            Axis::Z => self.row(y, z + 1),
        };
        (row ^ next, row)
    }
}

/// The numbers of the set bits, from the lowest.
pub(super) fn bits(mut word: u32) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        (word != 0).then(|| {
            let bit = word.trailing_zeros();
            word &= word - 1;
            bit
        })
    })
}
