//! What moves do to the lines of a tile, and the sum over tiles.

use super::{Contact, MoveEffect};
use crate::stock::{FIXED_STEP, Interval};

/// Effect of a move on a tile; lengths in fixed steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Effect {
    /// Index of the move.
    pub(super) index: u32,
    pub(super) removed: i64,
    pub(super) deepest: i64,
    /// Fraction of the move and point.
    pub(super) first: Option<(f64, [f64; 3])>,
    pub(super) shank: Option<(i64, [f64; 3])>,
    pub(super) holder: Option<(i64, [f64; 3])>,
    pub(super) core: Option<(i64, [f64; 3])>,
}

/// The effects of moves on one tile, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Effects {
    list: Vec<Effect>,
}

impl Effects {
    /// The entry of a move.
    pub(super) fn of(&mut self, index: u32) -> &mut Effect {
        if self.list.last().is_none_or(|e| e.index != index) {
            self.list.push(Effect { index, ..Effect::default() });
        }
        let last = self.list.len() - 1;
        &mut self.list[last]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Effect> {
        self.list.iter()
    }
}

/// Keeps the deeper touch, the older one of equals.
pub(super) fn deeper(kept: &mut Option<(i64, [f64; 3])>, depth: i64, point: impl FnOnce() -> [f64; 3]) {
    if kept.is_none_or(|(d, _)| depth > d) {
        *kept = Some((depth, point()));
    }
}

/// Sums effects over tiles: always called in the order of tiles.
pub(super) struct Sum {
    /// Removed length.
    removed: i128,
    rest: Effect,
}

impl Sum {
    pub(super) fn new() -> Sum {
        Sum { removed: 0, rest: Effect::default() }
    }

    pub(super) fn add(&mut self, e: &Effect) {
        self.removed += i128::from(e.removed);
        self.rest.deepest = self.rest.deepest.max(e.deepest);
        if let Some((t, point)) = e.first
            && self.rest.first.is_none_or(|(old, _)| t < old)
        {
            self.rest.first = Some((t, point));
        }
        for (kept, new) in [
            (&mut self.rest.shank, e.shank),
            (&mut self.rest.holder, e.holder),
            (&mut self.rest.core, e.core),
        ] {
            if let Some((depth, point)) = new {
                deeper(kept, depth, || point);
            }
        }
    }

    /// In mm, for lines at a distance of `step`; `filled` when a hollow tool was cut as if it were none.
    pub(super) fn effect(&self, step: f64, path_error: f64, filled: bool) -> MoveEffect {
        let contact = |c: Option<(i64, [f64; 3])>| {
            c.map(|(depth, point)| Contact { depth: depth as f64 * FIXED_STEP, point })
        };
        MoveEffect {
            removed: self.removed as f64 * FIXED_STEP * step * step,
            deepest: self.rest.deepest as f64 * FIXED_STEP,
            first_contact: self.rest.first.map(|(_, point)| point),
            shank: contact(self.rest.shank),
            holder: contact(self.rest.holder),
            core: contact(self.rest.core),
            as_filled: filled && self.rest.deepest > 0,
            path_error,
        }
    }
}

/// Length of the material of a line between two coordinates, and the ends of what is met.
pub(super) fn met(line: &[Interval], lo: i32, hi: i32) -> (i64, i32, i32) {
    let (mut length, mut first, mut last) = (0, i32::MAX, i32::MIN);
    for i in line {
        let (from, to) = (i.lo.at.max(lo), i.hi.at.min(hi));
        if from < to {
            length += i64::from(to) - i64::from(from);
            (first, last) = (first.min(from), last.max(to));
        }
    }
    (length, first, last)
}
