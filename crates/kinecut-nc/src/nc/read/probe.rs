//! Probing, `G38.2` to `G38.5` (LinuxCNC, GRBL): a move at feed that ends where the probe changes its state.
//!
//! Nobody knows where that is: the move is an item of its own, its way is not followed, and the axes that it names are nowhere known
//! behind it.

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::dialect::Code;
use crate::program::{Comp, ControlData};

use super::block::Word;
use super::reader::{Kind, Reader};

impl<'s> Reader<'s> {
    /// Executes a block of a probe.
    pub(super) fn probing(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some((Code::Probe { kind }, bytes)) = self.code(|c| matches!(c, Code::Probe { .. })) else {
            return Ok(());
        };
        if !self.has_axis(words) {
            return Err(self.answers(self.lacks(&bytes, "a probe without an axis"), 26).into());
        }
        if self.modal.comp != Comp::Off {
            return Err(self.while_on(&bytes).into());
        }
        if self.modal.turned.motion != Rigid::IDENTITY || self.has_rotary(words) {
            let why = "a probe in shifted or turned coordinates, or with a rotary axis, is not read";
            return Err(self.place.not_understood(&bytes, why).into());
        }
        let speed = self.feed_speed()?;
        let named = [0, 1, 2].map(|axis| words.iter().any(|w| w.is(crate::nc::dialect::AXES[axis])));
        let end = self.end(words)?;
        let place = [0, 1, 2].map(|axis| end[axis].filter(|_| named[axis]));
        self.flush(Kind::Tip);
        self.program.push_data(ControlData::Probe { kind, place }, &self.state(speed), self.origin);
        for axis in (0..3).filter(|axis| named[*axis]) {
            self.modal.position[axis] = None;
        }
        self.modal.tool_item = None;
        self.doubt(
            &bytes,
            "a probe stops where it touches: its way is not followed, and the place behind it is not known",
            "prove the rest from a known place behind it",
        );
        Ok(())
    }
}
