//! The material that a task meets on one line along its axis, in the tool frame.

use glam::DVec2;

use super::super::axial::hits;
use super::super::task::{Task, reached};
use super::Done;
use crate::stock::{Interval, fixed, unfixed};

/// A line of which a task takes what lies between two heights [fixed steps].
pub(super) struct Column {
    pub(super) over: DVec2,
    pub(super) floor: i32,
    pub(super) top: i32,
}

/// The heights of an interval in the tool frame.
pub(super) fn heights(interval: &Interval, task: &Task) -> (i32, i32) {
    let (lo, hi) = (interval.lo.at, interval.hi.at);
    if task.frame.sign > 0.0 { (lo, hi) } else { (-hi, -lo) }
}

impl Column {
    /// Length of the material of a line that is taken.
    pub(super) fn taken(&self, line: &[Interval], task: &Task) -> i64 {
        self.met(line, task, self.floor, self.top).0
    }

    /// Length of the material between two heights, and the highest of it.
    fn met(&self, line: &[Interval], task: &Task, lo: i32, hi: i32) -> (i64, i32) {
        let (mut length, mut last) = (0, i32::MIN);
        for interval in line {
            let (from, to) = heights(interval, task);
            let (from, to) = (from.max(lo), to.min(hi).min(self.top));
            if from < to {
                length += i64::from(to) - i64::from(from);
                last = last.max(to);
            }
        }
        (length, last)
    }

    /// Notes the length that is taken, when the cutting part, less the clearance, meets some of it.
    pub(super) fn note(&self, line: &[Interval], taken: i64, task: &Task, done: &mut Done) {
        let mut best = (0, 0);
        for part in &task.tool.contact.parts {
            hits(part, &task.piece, self.over, |hit| {
                let (length, last) = self.met(line, task, fixed(hit.lo), fixed(hit.hi));
                if length > best.0 {
                    best = (length, last);
                }
            });
        }
        let (length, last) = best;
        if length == 0 {
            return;
        }
        done.deepest = done.deepest.max(taken);
        let point = self.over.extend(unfixed(last));
        let t = reached(task, point);
        if done.first.is_none_or(|(old, _)| t < old) {
            done.first = Some((t, task.frame.stock(point).to_array()));
        }
    }
}
