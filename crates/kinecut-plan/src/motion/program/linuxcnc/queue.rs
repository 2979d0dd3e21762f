//! The queue of elements, and the speeds at their ends.
//!
//! Source: LinuxCNC 2.10, `src/emc/tp/tp.c`, at `tpRunOptimization` and `tpComputeOptimalVelocity`.

use super::corner::{Between, join};
use super::element::{Element, Passage};
use super::{Bounds, CYCLE};

/// Elements that are looked back over whenever one is added.
const DEPTH: usize = 50;
/// Cycles that an element takes at least where the look-ahead has been.
const LEAST_CYCLES: f64 = 1.02;

/// Elements in order.
pub(super) struct Queue<'a> {
    pub(super) elements: Vec<Element<'a>>,
    bounds: Bounds,
}

impl<'a> Queue<'a> {
    pub(super) fn new(bounds: Bounds) -> Queue<'a> {
        Queue { elements: Vec::new(), bounds }
    }

    /// Appends an element: the one before gets its end.
    pub(super) fn add(&mut self, mut next: Element<'a>) {
        if let Some(mut last) = self.elements.pop() {
            let between = join(&mut last, &mut next, &self.bounds);
            last.fix();
            match between {
                Between::Nothing => self.elements.push(last),
                Between::Arc(arc) => self.elements.extend([last, *arc]),
                Between::Instead(arc) => self.elements.push(*arc),
            }
        }
        self.elements.push(next);
        self.look_back();
    }

    /// Raises the speeds at the ends of the last elements.
    fn look_back(&mut self) {
        let mut has_stopped = false;
        let last = self.elements.len();
        for k in (1..last).rev().take(DEPTH + 1) {
            let (before, behind) = self.elements.split_at_mut(k);
            let (before, this) = (&mut before[k - 1], &mut behind[0]);
            if before.end != Passage::Tangent {
                if has_stopped {
                    return;
                }
                has_stopped = true;
                continue;
            }
            if this.is_fixed {
                let start = (this.last_speed.powi(2) + 2.0 * this.tangential() * this.length).sqrt();
                before.last_speed =
                    start.min(this.fastest).min(before.fastest).min(before.kink.unwrap_or(f64::INFINITY));
                this.fastest = this.fastest.min(this.length / (LEAST_CYCLES * CYCLE));
            } else {
                // Half of it may still be taken.
                let start = (this.tangential() * this.length).sqrt().min(this.target());
                before.last_speed = start.min(before.fastest).min(before.kink.unwrap_or(f64::INFINITY));
                this.last_speed = 0.0;
            }
        }
    }
}
