//! Rigid tapping: the spindle and the feed geared to one another, in, and out the same way in reverse.

use super::CycleStep;
use crate::base::{Code, Finding, Result};
use crate::tool::Hand;

/// A thread cut by a tap; heights in the frame of the program [mm], along the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tapping {
    /// Height from which the feed is geared to the spindle, and to which the tap withdraws.
    pub reference: f64,
    /// Height of the bottom, where the spindle turns back.
    pub bottom: f64,
    /// Height to which the tool returns.
    pub retract: f64,
    /// Way of one revolution [mm].
    pub pitch: f64,
    /// Hand of the thread: a right-hand one is cut clockwise.
    pub hand: Hand,
}

/// Largest difference of two pitches that are the same [mm]: a thread of a hundred turns ends within its tolerance.
pub const SAME_PITCH: f64 = 1e-5;

impl Tapping {
    /// The moves along the tool axis, after the one to the reference height and before the return.
    ///
    /// # Errors
    /// `KC0204` when the pitch is not usable.
    pub(super) fn steps(&self) -> Result<[CycleStep; 2]> {
        let pitch = self.pitch;
        if !(pitch > 0.0 && pitch.is_finite()) {
            let finding = Finding::error(Code::NC_STATE, "the pitch of a tapping cycle must be positive");
            return Err(finding.value_mm(pitch).into());
        }
        Ok([self.bottom, self.reference].map(|height| CycleStep::Thread { height, pitch }))
    }
}
