//! `M19`: the spindle stops at an angle (LinuxCNC: R, P, Q).

use crate::base::Result;
use crate::nc::dialect::Code;
use crate::program::{ControlData, Spindle};

use super::block::Word;
use super::reader::{Reader, Value, take};

impl<'s> Reader<'s> {
    /// Executes `M19`; the spindle does not turn behind it.
    pub(super) fn orientation(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        if self.code(|c| c == Code::Orientation).is_none() {
            return Ok(());
        }
        let shared = |w: &&Word<'s>| !w.used && ["R", "P", "Q"].iter().any(|name| w.is(name));
        if let (true, Some(word)) =
            (self.code(|c| c == Code::Continuous).is_some(), words.iter().find(shared))
        {
            let why = "both G64 and M19 of this block take it";
            return Err(self.place.not_understood(&word.bytes, why).into());
        }
        let (degrees, way, wait) = (take(words, "R"), take(words, "P"), take(words, "Q"));
        if let Some(angle) = degrees.as_ref().filter(|a| !(0.0..=360.0).contains(&a.value)) {
            let finding = self.place.malformed(&angle.bytes, "the angle of M19 is from 0 to 360 degrees");
            return Err(finding.value(angle.value, "deg").bound(360.0, "deg").into());
        }
        let way = match way {
            Some(way) => match self.count(&way, "the sense of M19")? {
                sense @ 0..=2 => sense as u8,
                _ => return Err(self.place.malformed(&way.bytes, "the sense of M19 is P0, P1 or P2").into()),
            },
            None => 0,
        };
        if let Some(wait) = wait.as_ref().filter(|w| w.value <= 0.0) {
            return Err(self.place.malformed(&wait.bytes, "the longest wait of M19 is positive").into());
        }
        let value = |word: Option<Value>| word.map_or(0.0, |w| w.value);
        self.modal.spindle = Spindle::Off;
        self.data(ControlData::Orient { degrees: value(degrees), way, seconds: value(wait) });
        Ok(())
    }
}
