//! Holes that follow one another: one cycle, under one state, at one height.
//!
//! With `G81` and its like the first block says all, the next ones only X and Y, which are the rapid move to the hole as
//! well; `G80` ends the series. With calls the first hole has its own; if at least [`WORTH`] more follow, `MCALL` calls
//! the cycle after each of the moves to them, until `MCALL` alone.

use crate::base::Result;
use crate::nc::native::Native;
use crate::program::{Cycle, Item, Path, Speed, State, Target, ToolAxis};

use super::Writer;

/// A series that is not ended yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series {
    pub(super) cycle: Cycle,
    pub(super) state: State,
    /// The block that ends it.
    pub(super) end: &'static str,
}

/// Further holes from which `MCALL` makes the text shorter: it takes two blocks itself.
pub(super) const WORTH: usize = 3;

impl Writer<'_> {
    /// Whether the series in force is of this cycle and state.
    pub(super) fn takes_up(&self, cycle: &Cycle, state: &State) -> bool {
        self.modal.series.is_some_and(|s| s.cycle == *cycle && s.state == *state)
    }

    /// The place in the plane to which the item at an index moves before a further hole of a series, if it does that and
    /// no more; `level`: height at which the series moves, in steps.
    fn next_hole(&self, index: usize, series: &Series, level: Option<i64>) -> Result<Option<[f64; 2]>> {
        let items = &self.program.items;
        if index + 1 >= items.len() {
            return Ok(None);
        }
        let (Item::Move(motion), Item::Cycle(next, steps)) = (items.get(index), items.get(index + 1)) else {
            return Ok(None);
        };
        let Target::Tip { point, axis: ToolAxis::Fixed | ToolAxis::Rotary([None, None, None]) } = motion.end
        else {
            return Ok(None);
        };
        let (here, there) = (self.program.state(index), self.program.state(index + 1));
        let next = Cycle::in_one_go(steps).unwrap_or(*next);
        let rapid = matches!(here.speed, Speed::Rapid { .. }) && motion.path == Path::Line;
        let same = next == series.cycle
            && *there == series.state
            && State { speed: series.state.speed, ..*here } == series.state;
        if !(rapid && same) || !point.z.is_nan() && Some(self.grid.round(point.z)?) != level {
            return Ok(None);
        }
        Ok(Some([point.x, point.y]))
    }

    /// Count of further holes of a series after the cycle at an index; counts up to [`WORTH`].
    pub(super) fn holes_after(&self, index: usize, series: &Series, level: Option<i64>) -> Result<usize> {
        let mut count = 0;
        while count < WORTH && self.next_hole(index + 1 + 2 * count, series, level)?.is_some() {
            count += 1;
        }
        Ok(count)
    }

    /// Takes a rapid move to the next hole into the series in force; whether it did.
    pub(super) fn joins_series(&mut self, index: usize) -> Result<bool> {
        let Some(series) = self.modal.series else { return Ok(false) };
        let Some(place) = self.next_hole(index, &series, self.place.written[2])? else { return Ok(false) };
        if self.modal.hole.is_some() {
            return Ok(false);
        }
        let mut moves = false;
        for (axis, value) in place.into_iter().enumerate() {
            moves |= !value.is_nan() && self.place.written[axis] != Some(self.grid.round(value)?);
        }
        if self.dialect.native == Native::Calls {
            // The cycle is called by a block that moves.
            if moves {
                self.line([place[0], place[1], f64::NAN], Speed::Rapid { linear: false })?;
                self.modal.hole = Some(String::new());
            }
            return Ok(moves);
        }
        let mut words = String::new();
        for (axis, value) in place.into_iter().enumerate() {
            self.axis(&mut words, axis, value, false)?;
        }
        self.modal.hole = Some(words);
        Ok(true)
    }

    /// Ends the series in force, if there is one.
    pub(super) fn end_series(&mut self) {
        if let Some(series) = self.modal.series.take() {
            self.page.block(series.end.to_owned());
            self.modal.motion = None;
            self.modal.hole = None;
        }
    }
}
