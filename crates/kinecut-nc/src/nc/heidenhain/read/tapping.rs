//! Rigid tapping (207), without a floating holder.
//!
//! At each call: `FMAX` to the set-up clearance `Q200` above the surface `Q203`, down by the depth `Q201` and out again with the feed
//! geared to the spindle, `Q239` a revolution (negative: a left-hand thread), then to the second clearance `Q204`.

use crate::base::{Error, Result};
use crate::program::{Cycle, Speed, Spindle, State, Tapping};
use crate::tool::Hand;

use super::cycle::names;
use super::statement::Word;
use super::{Hole, Reader};

impl<'s> Reader<'s> {
    /// `CYCL DEF 207`.
    pub(super) fn define_tapping(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        names(words);
        let unit = self.modal.unit;
        let mut length = |number: u32| -> Option<f64> {
            let word = words.iter_mut().find(|w| w.parameter == Some(number))?;
            word.used = true;
            word.value.map(|v| v * unit)
        };
        let parts = [200, 201, 239, 203].map(&mut length);
        let [Some(clearance), Some(depth), Some(pitch), Some(surface)] = parts else {
            let why = "rigid tapping needs Q200, Q201, Q239 and Q203";
            return Err(self.lacks(&self.here, why).into());
        };
        let second = length(204).unwrap_or(clearance);
        if !(depth < 0.0 && clearance >= 0.0 && pitch != 0.0) {
            let why = "rigid tapping needs a depth below zero and a pitch";
            return Err(self.lacks(&self.here, why).into());
        }
        self.modal.hole = Some(Hole::Tapping(Tapping {
            reference: surface + clearance,
            bottom: surface + depth,
            retract: surface + if second > clearance { second } else { clearance },
            pitch: pitch.abs(),
            hand: if pitch > 0.0 { Hand::Right } else { Hand::Left },
        }));
        Ok(())
    }

    /// Runs it at the present position.
    pub(super) fn tap(&mut self, tapping: Tapping) -> Result<()> {
        let [Some(_), Some(_), _] = self.modal.position else {
            self.start()?;
            return Ok(());
        };
        let Some(rate) = self.modal.rate.filter(|rate| *rate > 0.0) else {
            return Err(self.lacks(&self.here, "rigid tapping without a spindle speed (S)").into());
        };
        let state = self.state(Speed::PerRevolution(tapping.pitch));
        let state = State { spindle: Spindle::turning(tapping.hand, rate), ..state };
        let located = |e: Error| e.0.at(self.place.sources.locate(self.place.span(&self.here)));
        self.program.push_cycle(Cycle::Tap(tapping), &state, self.origin).map_err(located)?;
        self.modal.direction = None;
        self.modal.position[2] = Some(tapping.retract);
        Ok(())
    }
}
