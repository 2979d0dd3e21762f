//! Pecking of the older controls (`CYCL DEF 1.0` to `1.5`).
//!
//! ```text
//! CYCL DEF 1.0 PECKING
//! CYCL DEF 1.1 SET UP 2     distance from where the tool stands to the surface
//! CYCL DEF 1.2 DEPTH -20    depth below the surface
//! CYCL DEF 1.3 PECKG 5      depth of a step
//! CYCL DEF 1.4 DWELL 0      seconds at the bottom
//! CYCL DEF 1.5 F80
//! ```
//!
//! At a call the tool drills from where it stands, in steps counted from the surface; after each step it withdraws to
//! where it began, by `FMAX`, and comes back to the advanced stop distance above the last depth: 0.6 mm for holes of up
//! to 30 mm, deeper ones a fiftieth of their depth, at most 7 mm. The words before the numbers are those of the
//! control's language. Source: user's manuals of the TNC 370 (page 8-6) and of the TNC 407 to 426 (page 8-4).

use crate::base::{Error, Result};
use crate::nc::read::place::Bytes;
use crate::program::{Between, Cycle, DeepHole, Shortening};

use super::statement::Word;
use super::{Hole, Reader};

/// Words of the cycle: set-up clearance, depth, step, dwell and feed, as programmed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pecking {
    parts: [Option<f64>; 5],
}

/// The advanced stop distance [mm]: the least, the part of the depth, the largest.
const LEAST_STOP: f64 = 0.6;
const STOP_PART: f64 = 1.0 / 50.0;
const LARGEST_STOP: f64 = 7.0;
/// Most steps of a hole.
const MOST_STEPS: f64 = 10_000.0;

impl<'s> Reader<'s> {
    /// A block of the definition; `part` 0 begins it.
    pub(super) fn define_pecking(&mut self, words: &mut [Word<'s>], part: u32, bytes: &Bytes) -> Result<()> {
        if part == 0 {
            super::cycle::names(words);
            self.modal.hole = Some(Hole::Pecking(Pecking::default()));
            return Ok(());
        }
        let index = part as usize - 1;
        let Some(Hole::Pecking(Pecking { parts })) =
            self.modal.hole.as_mut().filter(|_| index < Pecking::default().parts.len())
        else {
            return Err(self.place.not_understood(bytes, "it does not follow CYCL DEF 1.0").into());
        };
        // The cycle's number is used; names have no value.
        let mut values = words.iter_mut().filter(|w| !w.used && w.parameter.is_none() && w.value.is_some());
        let Some(word) = values.next() else {
            return Err(self.place.malformed(bytes, "a number is missing").into());
        };
        word.used = true;
        parts[index] = word.value;
        super::cycle::names(words);
        Ok(())
    }

    /// Runs the cycle from the place of the tool.
    pub(super) fn peck(&mut self, pecking: Pecking) -> Result<()> {
        let [Some(clearance), Some(depth), Some(step), dwell, Some(feed)] = pecking.parts else {
            let why = "pecking needs a set-up clearance, a depth, a step and a feed (CYCL DEF 1.1 to 1.5)";
            return Err(self.lacks(&self.here, why).into());
        };
        let unit = self.modal.unit;
        let start = self.start()?.z;
        let (clearance, step) = (clearance.abs() * unit, step.abs() * unit);
        let (deep, dwell) = (-depth * unit, dwell.unwrap_or(0.0));
        if !(deep > 0.0 && step > 0.0 && deep / step < MOST_STEPS && feed > 0.0 && dwell >= 0.0) {
            let why = "pecking needs a depth below zero, a step, a feed, and a dwell that is not negative";
            return Err(self.lacks(&self.here, why).into());
        }
        let surface = start - clearance;
        let bottom = surface - deep;
        let cycle = if step >= deep {
            Cycle::Drill { reference: start, bottom, retract: start, dwell }
        } else {
            let stop = (STOP_PART * deep).clamp(LEAST_STOP, LARGEST_STOP);
            Cycle::DeepHole(DeepHole {
                reference: start,
                first: surface - step,
                bottom,
                retract: start,
                step,
                shortening: Shortening::None,
                between: Between::Withdraw { clearance: stop, dwell: 0.0 },
                first_feed: 1.0,
                dwell: 0.0,
                dwell_bottom: dwell,
            })
        };
        let state = self.state(self.feed(feed));
        let located = |e: Error| e.0.at(self.place.sources.locate(self.place.span(&self.here)));
        self.program.push_cycle(cycle, &state, self.origin).map_err(located)?;
        self.modal.direction = None;
        Ok(())
    }
}
