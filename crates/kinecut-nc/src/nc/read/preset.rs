//! `G92`: the present position gets new coordinates, over all work offsets.
//!
//! The shift is kept in the place of `G52`: LinuxCNC keeps both in the parameters 5211 to 5219. `G92.1` takes it back for good,
//! `G92.2` until `G92.3`. It is in force beyond the end of the program: LinuxCNC and GRBL keep it, which is said.

use glam::DVec3;

use crate::base::Result;
use crate::nc::dialect::{AXES, Code};

use super::lex::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

impl<'s> Reader<'s> {
    /// Executes `G92` to `G92.3`.
    pub(super) fn presetting(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let is = |c: Code| matches!(c, Code::PresetShift | Code::ShiftOff { .. } | Code::ShiftAgain);
        let Some((code, bytes)) = self.code(is) else { return Ok(()) };
        match code {
            Code::PresetShift => self.preset(words, &bytes)?,
            Code::ShiftOff { keep } => {
                self.modal.turned.shift = DVec3::ZERO;
                if !keep {
                    self.stored_shift = DVec3::ZERO;
                }
            }
            _ => self.modal.turned.shift = self.stored_shift,
        }
        self.modal.sticky.end();
        self.set_frame();
        Ok(())
    }

    fn preset(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        let unit = self.modal.length_unit;
        let mut by = DVec3::ZERO;
        let mut any = false;
        for axis in 0..3 {
            let Some(word) = take(words, AXES[axis]) else { continue };
            any = true;
            let Some(here) = self.modal.position[axis] else {
                let message = format!(
                    "G92 gives coordinates to a position whose {} the program has not set",
                    AXES[axis]
                );
                let finding = self.lacks(&word.bytes, &message);
                return Err(finding.help("move there first").into());
            };
            by[axis] = here - word.value * unit;
        }
        if !any {
            return Err(self.lacks(bytes, "G92 without an axis").into());
        }
        // Shifts of these controls count in the coordinates that a work offset turns.
        self.modal.turned.shift += by;
        self.stored_shift = self.modal.turned.shift;
        Ok(())
    }
}
