//! Waits of a program in their order: dwells, tool changes, ramps of the spindle.

use super::changes::each_change;
use crate::machine::MotionControl;
use crate::program::{CycleStep, Item, Program};
use crate::trace::Trace;

/// A wait between two moves.
pub(super) struct Wait {
    /// Index of the segment that follows.
    pub(super) before: usize,
    pub(super) item: u32,
    /// Its time [s].
    pub(super) time: f64,
}

/// All waits whose time is known, in order.
pub(super) fn waits(program: &Program, trace: &Trace, control: &MotionControl) -> Vec<Wait> {
    let first = |item: u32| trace.segments.partition_point(|s| s.item < item);
    let mut waits: Vec<Wait> = Vec::new();
    for (item, change) in each_change(program) {
        waits.extend(change.time(control).map(|time| Wait { before: first(item), item, time }));
    }
    // Of a cycle with several waits, those that went before.
    let mut in_cycle = (u32::MAX, 0);
    for (item, time) in trace.dwells.iter().copied() {
        let nth = if in_cycle.0 == item { in_cycle.1 } else { 0 };
        in_cycle = (item, nth + 1);
        let before = match program.items.get(item as usize) {
            Item::Cycle(_, steps) => place_in_cycle(steps, nth, first(item)..first(item + 1)),
            _ => first(item),
        };
        waits.push(Wait { before, item, time });
    }
    waits.sort_by_key(|wait| (wait.before, wait.item));
    waits
}

/// The segment before which the wait of this number in a cycle lies.
fn place_in_cycle(steps: &[CycleStep], nth: usize, segments: std::ops::Range<usize>) -> usize {
    let height = |step: &CycleStep| match *step {
        CycleStep::Dwell(_) => None,
        CycleStep::Rapid(z) | CycleStep::Feed(z) => Some(z),
        CycleStep::FeedAt { height, .. } | CycleStep::Thread { height, .. } => Some(height),
    };
    let heights: Vec<f64> = steps.iter().filter_map(height).collect();
    // A step to where the tool is makes no segment; whether the first one does, the number of segments says.
    let others = heights.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let mut at = heights.first().copied().filter(|_| segments.len() <= others);
    let (mut next, mut seen) = (segments.start, 0);
    for step in steps {
        match height(step) {
            Some(z) => {
                next += usize::from(at != Some(z));
                at = Some(z);
            }
            None if seen == nth => break,
            None => seen += 1,
        }
    }
    next.min(segments.end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wait_of_a_cycle_lies_behind_the_steps_that_move() {
        use CycleStep::{Dwell, Feed, Rapid};
        // Wait on top, down, wait at the bottom, up to where it is, up.
        let steps = [Rapid(2.0), Dwell(0.1), Feed(-3.0), Dwell(0.2), Rapid(-3.0), Rapid(2.0)];
        let place = |nth, count: usize| place_in_cycle(&steps, nth, 10..10 + count);
        assert_eq!([place(0, 3), place(1, 3)], [11, 12]);
        // The tool stands on the first height already.
        assert_eq!([place(0, 2), place(1, 2)], [10, 11]);
        assert_eq!(place_in_cycle(&[Dwell(1.0)], 0, 7..7), 7);
    }
}
