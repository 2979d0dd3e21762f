//! Cycles: dwell, tolerance, preset; shift and rotation, and drilling, are next door.

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::heidenhain::{LONGEST_DWELL, offset};
use crate::nc::read::place::Bytes;
use crate::program::{Blend, SetupId};

use super::statement::Word;
use super::{RAPID, Reader};

/// Rounding of the number of a cycle.
const WHOLE: f64 = 1e-9;

impl<'s> Reader<'s> {
    pub(super) fn cycle(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some(kind) = words.get_mut(1) else {
            return Err(self.place.malformed(&self.here, "a cycle is defined or called").into());
        };
        kind.used = true;
        let bytes = kind.bytes.clone();
        if kind.is("CALL") && kind.value.is_none() {
            self.modal_call(words)?;
            return Ok(());
        }
        let (Some(number), true) = (kind.value, kind.is("DEF")) else {
            return Err(self.place.not_understood(&bytes, "a cycle is defined or called").into());
        };
        let tenths = (number * 10.0).round();
        if tenths < 0.0 || (tenths - number * 10.0).abs() > WHOLE * tenths.max(1.0) {
            return Err(self.place.malformed(&bytes, "this is no number of a cycle").into());
        }
        let (cycle, part) = ((tenths / 10.0).floor() as u32, tenths as u32 % 10);
        match (cycle, part) {
            (7 | 9 | 10 | 32, 0) => names(words),
            (7, _) => {
                self.uncompensated("the datum is moved")?;
                self.shift(words)?;
            }
            (10, _) => {
                self.uncompensated("the coordinates are turned")?;
                self.rotation(words)?;
            }
            (1, part) => self.define_pecking(words, part, &bytes)?,
            (9, _) => self.dwell(words)?,
            (32, 1) => self.tolerance(words)?,
            (32, _) => {
                self.note(
                    "the mode and the rotary tolerance of CYCL DEF 32 are not followed: they move no axis",
                );
                words.iter_mut().for_each(|w| w.used = true);
            }
            (247, 0) => self.preset(words, &bytes)?,
            (207, 0) => self.define_tapping(words)?,
            (200 | 201 | 203 | 205, 0) => self.define(words, cycle)?,
            _ => {
                return Err(self.place.not_understood(&bytes, "this cycle is not read yet").into());
            }
        }
        Ok(())
    }

    /// `CYCL CALL`, with the M functions of its block.
    fn modal_call(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        self.drill()?;
        self.finish_functions(&functions)
    }

    fn dwell(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some(word) = words.iter_mut().find(|w| !w.used && w.value.is_some()) else {
            return Err(self.lacks(&self.here, "a dwell without a time").into());
        };
        word.used = true;
        let seconds = word.value.unwrap_or(0.0);
        if !(0.0..=LONGEST_DWELL).contains(&seconds) {
            let finding = self.place.malformed(&word.bytes, "a dwell is 0 to 3600 s");
            return Err(finding.value(seconds, "s").bound(LONGEST_DWELL, "s").into());
        }
        names(words);
        self.push_dwell(seconds);
        Ok(())
    }

    pub(super) fn push_dwell(&mut self, seconds: f64) {
        self.program.push_dwell(seconds, &self.state(RAPID), self.origin);
    }

    fn tolerance(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.modal.blend = match self.take(words, "T")? {
            Some((path, bytes)) if path < 0.0 => {
                return Err(self.place.malformed(&bytes, "a tolerance is not negative").into());
            }
            Some((path, _)) if path > 0.0 => Blend::within(path * self.modal.unit),
            _ => Blend::Continuous,
        };
        Ok(())
    }

    fn preset(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        names(words);
        let Some(word) = words.iter_mut().find(|w| w.parameter == Some(339)) else {
            return Err(self.lacks(bytes, "a preset without its number Q339").into());
        };
        word.used = true;
        let at = word.bytes.clone();
        let number = self.count(word.value.unwrap_or(0.0), &at, "a preset")?;
        let Some(offset) = offset(number) else {
            return Err(self.place.not_understood(&at, "presets 1 to 99 are read").into());
        };
        let same = self.modal.offset == Some(offset);
        if !same || self.modal.motion != Rigid::IDENTITY {
            self.uncompensated("the preset changes")?;
        }
        if self.modal.tilt.is_some() {
            let why = "a preset within a tilted plane: whether the plane stays is not certain";
            return Err(self
                .place
                .not_understood(bytes, why)
                .help("take the plane back first (PLANE RESET)")
                .into());
        }
        // It takes back what was shifted and turned.
        self.modal.shift = [0.0; 3];
        self.modal.degrees = 0.0;
        self.modal.uncertain = None;
        self.set_frame();
        if same {
            return Ok(());
        }
        self.modal.offset = Some(offset);
        self.modal.position = [None; 3];
        self.modal.direction = None;
        self.modal.pole = None;
        self.set_frame();
        let has = |i: usize| self.program.setups.get(i).is_some_and(|s| s.work_offsets.contains_key(&offset));
        let now = self.modal.setup.0 as usize;
        let count = self.program.setups.len();
        // The present clamping if it has the preset, otherwise the next one that has.
        if let Some(found) = (now..count).chain(0..now).find(|i| has(*i)) {
            self.modal.setup = SetupId(found as u32);
        }
        Ok(())
    }
}

/// The name of a cycle says nothing more.
pub(super) fn names(words: &mut [Word<'_>]) {
    for word in words.iter_mut().filter(|w| w.value.is_none() && w.parameter.is_none()) {
        word.used = true;
    }
}
