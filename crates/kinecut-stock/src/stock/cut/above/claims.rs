//! The lines across the tool axis that a task has to be taken past.
//!
//! A task may leave an end on a line, or take what no other does, only between the height that it comes down to on a way and the
//! ceiling of that way. What lies above ceilings is taken out at once (`sides.rs`).

use pulp::NullaryFnOnce;

use super::super::task::Task;
use super::layers::Layers;
use super::patch::{BLOCKS, Blocks, HEIGHTS, Patch, ROUNDING, SIDE, height_at, put_row, row_at};
use super::sweep::{BLOCK, Sweep, least, most};

/// Layers of a row in which a task is to be cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Claim {
    pub(super) task: u32,
    /// Index of the row among all of the stock.
    pub(super) row: u32,
    pub(super) layers: (u32, u32),
}

/// Adds a claim; neighbours of one task and row become one.
fn push(claims: &mut Vec<Claim>, new: Claim) {
    if let Some(last) = claims.last_mut()
        && (last.task, last.row) == (new.task, new.row)
        && new.layers.0 <= last.layers.1
        && last.layers.0 <= new.layers.1
    {
        last.layers = (last.layers.0.min(new.layers.0), last.layers.1.max(new.layers.1));
        return;
    }
    claims.push(new);
}

impl Patch {
    /// Adds the claims of a task in the patch, on lines along the two directions across its axis.
    pub(super) fn claim(&mut self, layers: &Layers, index: u32, task: &Task, claims: &mut [Vec<Claim>; 2]) {
        for part in &task.tool.cutting.parts {
            let sweep = Sweep::new(task, part);
            let mut blocks = self.active(&sweep, 4.0 * ROUNDING);
            if !blocks.is_empty() {
                blocks = self.open_by_planes(&self.planes(&sweep), blocks, |_| 4.0 * ROUNDING);
            }
            if blocks.is_empty() {
                continue;
            }
            let claimed = self.arch.dispatch(Bound { patch: self, sweep: &sweep, blocks, layers });
            for ((c0, r0), [along, across]) in blocks.corners().zip(claimed) {
                // One way after the other along a row.
                for (r, columns) in along.into_iter().enumerate() {
                    for c in bits(columns) {
                        self.claim_way(layers, (r0 + r, c0 + c, 0), index, &mut claims[0]);
                    }
                }
                let columns = across.into_iter().fold(0, |all, columns| all | columns);
                for c in bits(columns) {
                    for r in (0..BLOCK).filter(|r| across[*r] >> c & 1 == 1) {
                        self.claim_way(layers, (r0 + r, c0 + c, 1), index, &mut claims[1]);
                    }
                }
            }
            self.lower(blocks);
        }
    }

    /// Bounds on the ways along a direction to the lines of a block, from the heights of a part; by row a bit for each that is below
    /// its ceiling.
    #[inline(always)]
    fn bound_ways(
        &mut self,
        (c0, r0): (usize, usize),
        k: usize,
        (sweep, rim): (&Sweep, f64),
        layers: &Layers,
    ) -> [u8; BLOCK] {
        let back = if k == 0 { 1 } else { HEIGHTS };
        let mut rows = [0; BLOCK];
        for r in r0..r0 + BLOCK {
            let (at, start) = (height_at(r, c0), r * SIDE + c0);
            let heights = &self.heights[..];
            let (before, from) = (row_at(heights, at - 2 * back), row_at(heights, at - back));
            let (to, behind) = (row_at(heights, at), row_at(heights, at + back));
            let ceilings = row_at(&self.ceilings[k][..], start);
            let (mut lows, mut known) = ([0.0; BLOCK], [0.0; BLOCK]);
            for c in 0..BLOCK {
                let low = most(convex(before[c], from[c]), convex(behind[c], to[c]));
                known[c] = low;
                lows[c] = if low == f64::NEG_INFINITY { rim } else { low };
            }
            let mut row = claimed(&lows, &ceilings, layers);
            let unknown = row & endless(&known);
            if unknown != 0 {
                let (x, y, half) = self.middles_of_ways((c0, r), k);
                row &= !unknown;
                if unknown & sweep.reached(&x, &y, half + ROUNDING) != 0 {
                    let bounds = sweep.bounds(&x, &y, half);
                    for c in 0..BLOCK {
                        lows[c] = if known[c] == f64::NEG_INFINITY { bounds[c] } else { known[c] };
                    }
                    row = claimed(&lows, &ceilings, layers);
                }
            }
            rows[r - r0] = row;
            put_row(&mut self.lows[k][..], start, lows);
        }
        rows
    }

    /// Middles of the ways along a direction to the lines of a row of a block, and half their length.
    #[inline(always)]
    fn middles_of_ways(&self, (c0, r): (usize, usize), k: usize) -> ([f64; BLOCK], [f64; BLOCK], f64) {
        let half = 0.5 * self.step;
        let (dx, dy) = if k == 0 { (half, 0.0) } else { (0.0, half) };
        let mut x = row_at(&self.x, c0);
        for x in &mut x {
            *x -= dx;
        }
        (x, [self.y[r] - dy; BLOCK], half)
    }

    /// The same by discs about the ways.
    #[inline(always)]
    fn bound_discs(
        &mut self,
        (c0, r0): (usize, usize),
        k: usize,
        sweep: &Sweep,
        layers: &Layers,
    ) -> [u8; BLOCK] {
        let mut rows = [0; BLOCK];
        for r in r0..r0 + BLOCK {
            let start = r * SIDE + c0;
            let ceilings = row_at(&self.ceilings[k][..], start);
            let (x, y, half) = self.middles_of_ways((c0, r), k);
            let lows = sweep.bounds(&x, &y, half);
            rows[r - r0] = claimed(&lows, &ceilings, layers);
            put_row(&mut self.lows[k][..], start, lows);
        }
        rows
    }

    /// The claim on the way to a line from the one before it, given a bound from below.
    #[inline(always)]
    fn claim_way(
        &self,
        layers: &Layers,
        (r, c, k): (usize, usize, usize),
        index: u32,
        claims: &mut Vec<Claim>,
    ) {
        let (low, ceiling) = (self.lows[k][r * SIDE + c], self.ceilings[k][r * SIDE + c]);
        if low - ROUNDING >= ceiling + 2.0 * ROUNDING || ceiling == f64::NEG_INFINITY {
            return;
        }
        if low < f64::INFINITY {
            let layers = layers.between(low, ceiling);
            if layers.0 < layers.1 {
                let row = if k == 0 { self.first[1] + r as i64 } else { self.first[0] + c as i64 };
                push(claims, Claim { task: index, row: row as u32, layers });
            }
        }
    }
}

/// The bits that are set, from the lowest.
fn bits(mut mask: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let next = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(next)
    })
}

/// Bounds on the ways of blocks, in the widest instructions of the machine; for each block and direction, by row, a bit for each that
/// is below its ceiling.
struct Bound<'a, 'b> {
    patch: &'a mut Patch,
    sweep: &'a Sweep<'b>,
    blocks: Blocks,
    layers: &'a Layers,
}

impl NullaryFnOnce for Bound<'_, '_> {
    type Output = [[[u8; BLOCK]; 2]; BLOCKS];

    #[inline(always)]
    fn call(self) -> Self::Output {
        let Bound { patch, sweep, blocks, layers } = self;
        let mut claimed = [[[0; BLOCK]; 2]; BLOCKS];
        if sweep.is_convex() {
            patch.raise(sweep, blocks);
            // Where a bound is not known the part does not pass one of the lines about the way, two steps from its far end at most.
            let sweep = (sweep, sweep.rim(2.0 * patch.step));
            for (corner, claimed) in blocks.corners().zip(&mut claimed) {
                *claimed =
                    [patch.bound_ways(corner, 0, sweep, layers), patch.bound_ways(corner, 1, sweep, layers)];
            }
        } else {
            for (corner, claimed) in blocks.corners().zip(&mut claimed) {
                *claimed = [
                    patch.bound_discs(corner, 0, sweep, layers),
                    patch.bound_discs(corner, 1, sweep, layers),
                ];
            }
        }
        claimed
    }
}

/// A bit for each way with a bound below its ceiling, and a layer between them.
#[inline(always)]
fn claimed(lows: &[f64; BLOCK], ceilings: &[f64; BLOCK], layers: &Layers) -> u8 {
    let mut claimed = 0;
    for c in 0..BLOCK {
        let (low, ceiling) = (lows[c] - ROUNDING, ceilings[c] + 2.0 * ROUNDING);
        claimed |= u8::from((low < ceiling) & layers.may_be_between(low, ceiling)) << c;
    }
    claimed
}

/// A bit for each bound that is low without end.
#[inline(always)]
fn endless(lows: &[f64; BLOCK]) -> u8 {
    let mut endless = 0;
    for c in 0..BLOCK {
        endless |= u8::from(lows[c] == f64::NEG_INFINITY) << c;
    }
    endless
}

/// Bound from below of a convex function on the way behind two of its values at equal distances; low without end where one of them
/// is infinite.
#[inline(always)]
fn convex(before: f64, here: f64) -> f64 {
    let beyond = least(here, 2.0 * here - before);
    if here < f64::INFINITY { beyond } else { f64::NEG_INFINITY }
}
