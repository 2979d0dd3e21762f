//! Planes above the tops and ceilings of blocks, and planes that parts stay above.

use pulp::NullaryFnOnce;

use super::super::sweep::{BLOCK, Sweep, most};
use super::{BLOCKS, Blocks, LINES, Patch, Planes, SIDE, corner, row_at};
use crate::stock::FIXED_STEP;

/// A plane above the tops and ceilings of a block: its height over the middle [mm], and its slopes along x and y.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cover {
    height: f64,
    slopes: [f64; 2],
}

impl Patch {
    /// By block a plane that a part stays above, see [`Sweep::planes`].
    pub(in crate::stock::cut::above) fn planes(&self, sweep: &Sweep) -> Planes {
        self.arch.dispatch(Tangents { patch: self, sweep })
    }

    /// Those of some blocks whose covers a part may come down to, with some slack, by planes that it stays above.
    pub(in crate::stock::cut::above) fn open_by_planes(
        &self,
        [heights, along_x, along_y]: &Planes,
        blocks: Blocks,
        slack: impl Fn(usize) -> f64,
    ) -> Blocks {
        let Some(covers) = &self.covers else { return blocks };
        // From the middle to the farthest line with a way to the block.
        let half = (0.5 * (BLOCK - 1) as f64 + 1.0) * self.step;
        let mut mask = 0;
        for b in 0..BLOCKS {
            let Cover { height, slopes: [x, y] } = covers[b];
            let apart = (x - along_x[b]).abs() + (y - along_y[b]).abs();
            mask |= u32::from(heights[b] < height + half * apart + slack(b)) << b;
        }
        Blocks(blocks.0 & mask)
    }

    /// Those of some blocks on a line or way of which a part may come down to what is there, with some slack, by planes that it stays
    /// above.
    pub(in crate::stock::cut::above) fn open_by_lines(
        &self,
        planes: &Planes,
        blocks: Blocks,
        slack: impl Fn(usize) -> f64,
    ) -> Blocks {
        let mut mask = 0;
        for b in (0..BLOCKS).filter(|b| blocks.0 >> b & 1 == 1) {
            let [height, x, y] = [planes[0][b], planes[1][b], planes[2][b]];
            let plane = Cover { height: height - slack(b), slopes: [x, y] };
            mask |= u32::from(self.arch.dispatch(Dips { patch: self, block: b, plane })) << b;
        }
        Blocks(mask)
    }

    /// Whether a plane comes down to a line of a block, or to the ceiling of a way to or from one.
    #[inline(always)]
    fn dips(&self, block: usize, Cover { height, slopes: [sx, sy] }: Cover) -> bool {
        let ((c0, r0), step) = (corner(block), self.step);
        let middle = 0.5 * (BLOCK - 1) as f64;
        let mut across = [0.0; BLOCK];
        for c in 0..BLOCK {
            across[c] = height + sx * (c as f64 - middle) * step;
        }
        let mut any = [false; BLOCK];
        for r in 0..BLOCK {
            let start = (r0 + r) * SIDE + c0;
            let row = |of: &[f64; LINES]| row_at(&of[..], start);
            let (top, along, up) = (row(&self.top), row(&self.ceilings[0]), row(&self.ceilings[1]));
            let off = sy * (r as f64 - middle) * step;
            for c in 0..BLOCK {
                any[c] |= across[c] + off < most(top[c] * FIXED_STEP, most(along[c], up[c]));
            }
            if c0 + BLOCK < SIDE {
                any[0] |= across[BLOCK - 1] + off < self.ceilings[0][start + BLOCK];
            }
        }
        if r0 + BLOCK < SIDE {
            let next = row_at(&self.ceilings[1][..], (r0 + BLOCK) * SIDE + c0);
            let off = sy * middle * step;
            for c in 0..BLOCK {
                any[c] |= across[c] + off < next[c];
            }
        }
        any.into_iter().fold(false, |any, one| any | one)
    }

    /// Depth to which a part may come down below the cover of some block, about [mm].
    pub(in crate::stock::cut::above) fn depth(&self, [heights, ..]: &Planes, blocks: Blocks) -> f64 {
        let Some(covers) = &self.covers else { return 0.0 };
        let below = |b: usize| covers[b].height - heights[b];
        (0..BLOCKS).filter(|b| blocks.0 >> b & 1 == 1).map(below).fold(f64::NEG_INFINITY, most)
    }

    /// Begins to keep the covers of the blocks; `whole`: above the ceilings on all of their ways, not at one end of each.
    pub(in crate::stock::cut::above) fn keep_covers(&mut self, whole: bool) {
        self.whole = whole;
        self.covers = Some(self.arch.dispatch(Covers(self)));
    }

    /// A plane along the tops of a block, above them and above the ceilings of the ways to and from its lines.
    #[inline(always)]
    pub(super) fn cover_of(&self, block: usize) -> Cover {
        let (c0, r0) = corner(block);
        let step = self.step;
        // Slopes from one border of the block to the other, of the lines where they are known.
        let (of, unit) = match self.top[r0 * SIDE + c0] > f64::NEG_INFINITY {
            true => (&self.top, FIXED_STEP),
            false => (&self.ceilings[0], 1.0),
        };
        let (mut over_x, mut over_y) = ([0.0; BLOCK], [0.0; BLOCK]);
        let (low, high) = (row_at(&of[..], r0 * SIDE + c0), row_at(&of[..], (r0 + BLOCK - 1) * SIDE + c0));
        for i in 0..BLOCK {
            over_y[i] = high[i] - low[i];
            let row = (r0 + i) * SIDE + c0;
            over_x[i] = of[row + BLOCK - 1] - of[row];
        }
        let scale = unit / (BLOCK as f64 * (BLOCK - 1) as f64 * step);
        let slopes = [over_x, over_y].map(|over| over.into_iter().sum::<f64>() * scale);
        let slopes = if slopes[0].is_finite() && slopes[1].is_finite() { slopes } else { [0.0; 2] };
        let [sx, sy] = slopes;
        // Of a way the end at which the plane is higher: a part that takes it comes down to its ceiling at both. Or the other one.
        let of_way = |slope: f64| if self.whole { -most(0.0, slope) } else { most(0.0, -slope) };
        let (back_x, back_y) = (of_way(sx * step), of_way(sy * step));
        let middle = 0.5 * (BLOCK - 1) as f64;
        let mut across = [0.0; BLOCK];
        for c in 0..BLOCK {
            across[c] = sx * (c as f64 - middle) * step;
        }
        let mut most_of = [f64::NEG_INFINITY; BLOCK];
        for r in 0..BLOCK {
            let start = (r0 + r) * SIDE + c0;
            let row = |of: &[f64; LINES]| row_at(&of[..], start);
            let (top, along, up) = (row(&self.top), row(&self.ceilings[0]), row(&self.ceilings[1]));
            let off = sy * (r as f64 - middle) * step;
            for c in 0..BLOCK {
                let highest = most(top[c] * FIXED_STEP, most(along[c] - back_x, up[c] - back_y));
                most_of[c] = most(most_of[c], highest - (across[c] + off));
            }
            if c0 + BLOCK < SIDE {
                let beyond =
                    self.ceilings[0][start + BLOCK] - back_x - (sx * (BLOCK as f64 - middle) * step + off);
                most_of[0] = most(most_of[0], beyond);
            }
        }
        if r0 + BLOCK < SIDE {
            let next = row_at(&self.ceilings[1][..], (r0 + BLOCK) * SIDE + c0);
            let off = sy * (BLOCK as f64 - middle) * step;
            for c in 0..BLOCK {
                most_of[c] = most(most_of[c], next[c] - back_y - (across[c] + off));
            }
        }
        Cover { height: most_of.into_iter().fold(f64::NEG_INFINITY, most), slopes }
    }
}

/// Planes below a part by block.
struct Tangents<'a, 'b> {
    patch: &'a Patch,
    sweep: &'a Sweep<'b>,
}

impl NullaryFnOnce for Tangents<'_, '_> {
    type Output = Planes;

    #[inline(always)]
    fn call(self) -> [[f64; BLOCKS]; 3] {
        let Tangents { patch, sweep } = self;
        sweep.planes(&patch.middles[0], &patch.middles[1])
    }
}

/// Whether a plane comes down to what is in a block.
struct Dips<'a> {
    patch: &'a Patch,
    block: usize,
    plane: Cover,
}

impl NullaryFnOnce for Dips<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        self.patch.dips(self.block, self.plane)
    }
}

/// The covers of all blocks.
struct Covers<'a>(&'a Patch);

impl NullaryFnOnce for Covers<'_> {
    type Output = [Cover; BLOCKS];

    #[inline(always)]
    fn call(self) -> [Cover; BLOCKS] {
        let mut covers = [Cover::default(); BLOCKS];
        for (b, cover) in covers.iter_mut().enumerate() {
            *cover = self.0.cover_of(b);
        }
        covers
    }
}
