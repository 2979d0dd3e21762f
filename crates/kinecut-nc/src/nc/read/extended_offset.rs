//! Work offsets beyond G59: `G54.1 P` and `G54 P` of FANUC, `G154 P` and `G110` to `G129` of Haas.
//!
//! `G54 P1` is `G54.1 P1`; `G110` is `G154 P1`. A P that another code of the block uses is not that of the offset.

use crate::base::Result;
use crate::nc::dialect::{Code, FlowWords};
use crate::program::WorkOffset;

use super::block::Word;
use super::reader::{Reader, take};

/// Codes times ten of the first twenty further work offsets of a Haas.
const G110: u32 = 1100;
const G129: u32 = 1290;

impl<'s> Reader<'s> {
    /// The further work offset that has a code of its own (Haas).
    pub(super) fn offset_by_code(&self, tenths: u32) -> Option<WorkOffset> {
        let own = self.dialect.haas && (G110..=G129).contains(&tenths) && tenths.is_multiple_of(10);
        own.then(|| WorkOffset::extended((tenths - G110) / 10 + 1)).flatten()
    }

    /// Puts the work offset that P names in the place of the code before it.
    pub(super) fn extended_offset(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let fanuc = self.dialect.flow == FlowWords::MacroB && !self.dialect.haas;
        let takes = |c: Code| c == Code::ExtendedOffset || fanuc && c == Code::Work(WorkOffset::G54);
        let Some(place) = self.codes.iter().position(|(c, _)| takes(*c)) else { return Ok(()) };
        let (code, bytes) = self.codes[place].clone();
        let needs_p = code == Code::ExtendedOffset;
        let other = self.code(|c| {
            matches!(
                c,
                Code::Dwell
                    | Code::Cycle(_)
                    | Code::CallProgram
                    | Code::CallBlock
                    | Code::Return
                    | Code::FurtherReference
            )
        });
        if let Some((_, other)) = other {
            if needs_p {
                let finding = self.lacks(&other, "two codes of the block use P");
                return Err(finding.help("write them in two blocks").into());
            }
            return Ok(());
        }
        // The wait of the cycle in force.
        if !needs_p && matches!(self.modal.motion, Some(Code::Cycle(_))) {
            return Ok(());
        }
        let Some(word) = take(words, "P") else {
            if needs_p {
                return Err(self.lacks(&bytes, "a further work offset without its number P").into());
            }
            return Ok(());
        };
        let number = self.count(&word, "the number of a work offset")?;
        let Some(offset) = WorkOffset::extended(number).filter(|o| (self.dialect.has_offset)(*o)) else {
            let most = if self.dialect.haas { "P1 to P99" } else { "P1 to P300" };
            let why = format!("the further work offsets of this control are {most}");
            return Err(self.place.malformed(&word.bytes, &why).into());
        };
        self.codes[place].0 = Code::Work(offset);
        Ok(())
    }
}
