//! Amounts and contacts of tasks in a patch, and which of them left ends.

use glam::DVec2;

use super::super::super::task::Task;
use super::super::Done;
use super::super::column::{Column, heights};
use super::super::field::Field;
use super::super::sweep::{BLOCK, Sweep};
use super::sink::Sunk;
use super::{NO_TASK, Patch, SIDE};
use crate::stock::{FIXED_STEP, Interval};

impl Patch {
    /// Notes what a part has met in a block.
    pub(super) fn note(
        &self,
        field: &Field,
        (c0, r0): (usize, usize),
        task: &Task,
        sunk: &Sunk,
        done: &mut Done,
    ) {
        let Sunk { greatest, sum, .. } = *sunk;
        if self.simple {
            done.removed += sum as i64;
        }
        // The part made smaller by the clearance passes higher by the clearance at least.
        let clearance = task.clearance / FIXED_STEP - 1.0;
        let told = |overlap: f64, done: &Done| overlap > clearance && overlap > done.deepest as f64;
        if greatest == 0.0 || (self.simple && !told(greatest, done)) {
            return;
        }
        // The deepest first: after it no other one has to be told.
        let at = |i: usize| (r0 + i / BLOCK, c0 + i % BLOCK);
        let deepest = |i: &usize| self.overlap_at(at(*i)) == greatest;
        let first = (0..BLOCK * BLOCK).find(deepest).unwrap_or(0);
        for i in std::iter::once(first).chain((0..BLOCK * BLOCK).filter(|i| *i != first)) {
            let (r, c) = at(i);
            let overlap = self.overlap_at((r, c));
            if overlap == 0.0 || (self.simple && !told(overlap, done)) {
                continue;
            }
            let Some(line) = field.line(self.first[0] + c as i64, self.first[1] + r as i64) else {
                continue;
            };
            let floor = self.top[r * SIDE + c];
            let over = Sweep::exchanged(task, DVec2::new(self.x[c], self.y[r]));
            let column = Column { over, floor: floor as i32, top: (floor + overlap) as i32 };
            let mut taken = overlap as i64;
            if !self.simple {
                taken = column.taken(field.material(line), task);
                done.removed += taken;
            }
            if told(overlap, done) {
                column.note(field.material(line), taken, task, done);
            }
            if self.simple && !told(greatest, done) {
                break;
            }
        }
    }

    fn overlap_at(&self, (r, c): (usize, usize)) -> f64 {
        self.overlap[r * SIDE + c]
    }

    /// Whether the height down to which a task went over a line lies in the material that was there.
    fn leaves_end(&self, field: &Field, l: usize, task: &Task) -> bool {
        let line = field.line(self.first[0] + (l % SIDE) as i64, self.first[1] + (l / SIDE) as i64);
        let is_in = |interval: &Interval| {
            let (from, to) = heights(interval, task);
            f64::from(from) <= self.top[l] && self.top[l] < f64::from(to)
        };
        line.is_some_and(|line| field.material(line).iter().any(is_in))
    }

    /// The tasks that have left an end on a line of the patch: they have taken something, of which no more is known than one rounding.
    pub(in crate::stock::cut::above) fn left(&self, field: &Field, tasks: &[Task]) -> Vec<Done> {
        let mut all: Vec<(u32, usize)> = Vec::new();
        for (l, task) in self.task.iter().enumerate().filter(|(_, task)| **task != NO_TASK) {
            if !self.simple && !self.leaves_end(field, l, &tasks[*task as usize]) {
                continue;
            }
            if all.last().is_none_or(|(last, _)| *last != *task as u32) {
                all.push((*task as u32, l));
            }
        }
        all.sort_unstable();
        all.dedup_by_key(|(task, _)| *task);
        let point = |task: &Task, l: usize| {
            let over = Sweep::exchanged(task, DVec2::new(self.x[l % SIDE], self.y[l / SIDE]));
            task.frame.stock(over.extend(self.top[l] * FIXED_STEP)).to_array()
        };
        let done = |(task, l)| {
            let first = Some((1.0, point(&tasks[task as usize], l)));
            Done { task, removed: 1, deepest: 1, first }
        };
        all.into_iter().map(done).collect()
    }
}
