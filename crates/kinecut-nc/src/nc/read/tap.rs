//! Rigid tapping: `G84` and `G74` after `M29`, and `G33.1`.
//!
//! `G84` and `G74` are canned cycles whose feed is the pitch: F itself in `G95`, F over S in `G94`. `G33.1 Z K` runs from the
//! position of the tool to Z and back, K a revolution.

use crate::base::Result;
use crate::program::{Cycle, Speed, Spindle, State, Tapping};
use crate::tool::Hand;

use super::block::Word;
use super::reader::{Kind, Reader, take};

/// Said of `G84` and `G74` without `M29`.
const BY_PARAMETER: &str =
    "G84 and G74 without M29 are rigid by a parameter of the machine (5200) only: they are read as rigid";
/// Said of a wait at the bottom.
const WAIT: &str = "the wait P at the bottom of a thread is left out of the time";

impl<'s> Reader<'s> {
    /// Feed and spindle of a thread whose feed was said as any other.
    pub(super) fn geared(&mut self, speed: Speed, hand: Hand) -> Result<(Speed, Spindle)> {
        let here = self.here.clone();
        let Some(rate) = self.modal.speed.filter(|rate| *rate > 0.0) else {
            return Err(self
                .lacks(&here, "a tapping cycle without a spindle speed")
                .help("program S")
                .into());
        };
        // A Haas taps rigidly by itself.
        if !self.modal.sticky.rigid && !self.dialect.haas {
            self.note(BY_PARAMETER);
        }
        let pitch = match speed {
            Speed::PerMinute(feed) => feed * std::f64::consts::TAU / rate,
            Speed::PerRevolution(pitch) => pitch,
            _ => return Err(self.lacks(&here, "a tapping cycle without a feed").into()),
        };
        Ok((Speed::PerRevolution(pitch), Spindle::turning(hand, rate)))
    }

    /// A tapping cycle has no steps, and its wait is no part of its motion.
    pub(super) fn plain_thread(&mut self, step: Option<f64>, dwell: Option<f64>) -> Result<()> {
        if step.is_some_and(|q| q != 0.0) {
            let here = self.here.clone();
            return Err(self.place.not_understood(&here, "tapping in steps (Q) is not read yet").into());
        }
        if dwell.is_some_and(|p| p > 0.0) {
            self.note(WAIT);
        }
        Ok(())
    }

    /// `G33.1`.
    pub(super) fn synchronised_tap(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let here = self.here.clone();
        let from = self.start()?;
        let hand = match self.modal.spindle {
            Spindle::Clockwise(rate) if rate > 0.0 => Hand::Right,
            Spindle::CounterClockwise(rate) if rate > 0.0 => Hand::Left,
            _ => return Err(self.lacks(&here, "G33.1 while the spindle does not turn").into()),
        };
        let Some(pitch) = take(words, "K") else {
            return Err(self.lacks(&here, "G33.1 without its pitch K").into());
        };
        let pitch = pitch.value * self.modal.length_unit;
        let [x, y, z] = self.end(words)?;
        if x != Some(from.x) || y != Some(from.y) {
            return Err(self.place.not_understood(&here, "a thread that is not along Z is not read").into());
        }
        self.flush(Kind::Tip);
        let bottom = z.unwrap_or(from.z);
        let tapping = Tapping { reference: from.z, bottom, retract: from.z, pitch, hand };
        let state: State = self.state(Speed::PerRevolution(pitch));
        let located = |e: crate::base::Error| e.0.at(self.place.sources.locate(self.place.span(&here)));
        self.program.push_cycle(Cycle::Tap(tapping), &state, self.origin).map_err(located).map_err(Into::into)
    }
}
