//! The lines across the tool axis that a task has to be taken past.
//!
//! A task may leave an end on a line, or take what no other does, only between the height that it comes down to on a way and the
//! ceiling of that way. What lies above ceilings is taken out at once (`sides.rs`).

use super::super::task::Task;
use super::layers::Layers;
use super::patch::{Patch, ROUNDING, SIDE};
use super::sweep::{BLOCK, Sweep};

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
            let active: Vec<usize> = self.active(&sweep, 4.0 * ROUNDING).collect();
            if active.is_empty() {
                continue;
            }
            if sweep.is_convex() {
                self.raise(&sweep, active.iter().copied());
            }
            for block in &active {
                for (k, claims) in claims.iter_mut().enumerate() {
                    for i in 0..BLOCK {
                        self.claim_row(layers, (*block, k, i), (index, &sweep), claims);
                    }
                }
            }
            if sweep.is_convex() {
                self.lower(active.iter().copied());
            }
        }
    }

    /// The claims on one row of ways in a block.
    fn claim_row(
        &self,
        layers: &Layers,
        (block, k, i): (usize, usize, usize),
        (index, sweep): (u32, &Sweep),
        claims: &mut Vec<Claim>,
    ) {
        let (c0, r0) = (block % (SIDE / BLOCK) * BLOCK, block / (SIDE / BLOCK) * BLOCK);
        let (start, stride) = if k == 0 { ((r0 + i) * SIDE + c0, 1) } else { (r0 * SIDE + c0 + i, SIDE) };
        let first = if k == 0 { c0 } else { r0 };
        let mut low = [f64::NEG_INFINITY; BLOCK];
        if sweep.is_convex() {
            // Heights from two lines before the row to one line behind it; none beyond the patch.
            let mut h = [f64::INFINITY; BLOCK + 3];
            for (j, h) in h.iter_mut().enumerate() {
                let at = first + j;
                if (2..SIDE + 2).contains(&at) {
                    *h = self.heights[start + j * stride - 2 * stride];
                }
            }
            for (j, low) in low.iter_mut().enumerate() {
                *low = convex(h[j], h[j + 1]).max(convex(h[j + 3], h[j + 2]));
            }
        }
        let offset = if k == 0 { self.first[1] } else { self.first[0] };
        let across = if k == 0 { r0 + i } else { c0 + i };
        for (j, low) in low.into_iter().enumerate() {
            let l = start + j * stride;
            let ceiling = self.ceilings[k][l];
            if low - ROUNDING >= ceiling + 2.0 * ROUNDING || ceiling == f64::NEG_INFINITY {
                continue;
            }
            let low = if low == f64::NEG_INFINITY {
                let half = 0.5 * self.step;
                let (dx, dy) = if k == 0 { (half, 0.0) } else { (0.0, half) };
                let middle = ([self.x[l % SIDE] - dx], [self.y[l / SIDE] - dy]);
                sweep.bounds(&middle.0, &middle.1, half)[0]
            } else {
                low
            };
            if low.is_finite() {
                let layers = layers.between(low, ceiling);
                if layers.0 < layers.1 {
                    push(claims, Claim { task: index, row: (offset + across as i64) as u32, layers });
                }
            }
        }
    }
}

/// Bound from below of a convex function on the way behind two of its values at equal distances.
fn convex(before: f64, here: f64) -> f64 {
    if here < f64::INFINITY { here.min(2.0 * here - before) } else { f64::NEG_INFINITY }
}
