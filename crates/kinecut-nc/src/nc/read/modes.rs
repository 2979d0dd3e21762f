//! Modes of a control that move no axis: each is said once, with what it may do to the path.

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::dialect::Code;
use crate::nc::modes::Mode;

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

impl<'s> Reader<'s> {
    /// The mode that a block sets.
    pub(super) fn mode(&self) -> Option<(&'static Mode, Bytes)> {
        self.codes.iter().find_map(|(code, bytes)| match code {
            Code::Mode(mode) => Some((*mode, bytes.clone())),
            _ => None,
        })
    }

    /// Executes the mode of a block: says what is not followed.
    pub(super) fn set_mode(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some((mode, bytes)) = self.mode() else { return Ok(()) };
        if let Some((_, second)) = self.code(|c| matches!(c, Code::Mode(other) if other != mode)) {
            return Err(self.twice(&second).into());
        }
        let mut end = bytes.end;
        let (mut tolerance, mut smooths) = (None, false);
        for name in mode.words {
            let Some(word) = take(words, name) else { continue };
            end = end.max(word.bytes.end);
            if mode.tolerance == Some(*name) {
                tolerance = Some(word.value * self.modal.length_unit);
            }
            smooths |= *name == "Q" && mode.smooths.iter().any(|q| f64::from(*q) == word.value);
        }
        let said = self.place.shown(&(bytes.start..end));
        let what = mode.what;
        let message = match tolerance {
            Some(most) if most < 0.0 => {
                return Err(self.place.malformed(&bytes, "a tolerance is not negative").into());
            }
            Some(most) => {
                let most = (most * 1e6).round() / 1e6;
                format!("`{said}` ({what}) is not followed: the path may differ by {most} mm at its corners")
            }
            None => format!("`{said}` ({what}) is not followed: it moves no axis"),
        };
        if self.findings.iter().all(|f| f.message != message) {
            let place = self.place.sources.locate(self.place.span(&bytes));
            self.findings.push(Finding::note(FindingCode::NC_WORD, message).at(place));
        }
        if smooths {
            let message = format!(
                "`{said}`: the control lays curves through the lines that follow, within parameters of the machine: the lines are followed"
            );
            self.doubt(&bytes, &message, "write the curves as arcs where they matter");
        }
        Ok(())
    }
}
