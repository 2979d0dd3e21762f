//! Codes that call a program or return from it: `M98`, `M99`, `G65`. `G66` is next door.

use crate::base::Result;
use crate::nc::dialect::{Code, FlowWords};
use crate::nc::fanuc::arguments::Arguments;
use crate::nc::run::Level;

use super::block::Word;
use super::jump::Jump;
use super::place::Bytes;
use super::reader::{Reader, take};

/// Letters of `G65` whose numbers count least increments without a decimal point.
const LENGTHS: [&str; 12] = ["A", "C", "I", "J", "K", "Q", "R", "U", "V", "X", "Y", "Z"];

impl<'s> Reader<'s> {
    /// Keeps the call or return of a block for when all else of it is done.
    pub(super) fn jumping(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        match self.code(|c| matches!(c, Code::CallProgram | Code::CallBlock | Code::Return)) {
            Some((code @ (Code::CallProgram | Code::CallBlock), bytes)) => {
                self.program_call(words, code, &bytes)
            }
            Some((_, bytes)) => {
                let to = match take(words, "P") {
                    Some(block) => Some(self.count(&block, "a block number")?),
                    None => None,
                };
                self.jump = Some(Jump::Return { to, bytes });
                Ok(())
            }
            None => Ok(()),
        }
    }

    fn program_call(&mut self, words: &mut [Word<'s>], code: Code, bytes: &Bytes) -> Result<()> {
        // Digits of a number that is written, not computed.
        let digits = words.iter().find(|w| w.is("P") && !w.computed).map_or(0, |w| {
            let text = self.place.text().get(w.bytes.start as usize..w.bytes.end as usize).unwrap_or("");
            text.bytes().filter(u8::is_ascii_digit).count()
        });
        let Some(program) = take(words, "P") else {
            return Err(self
                .lacks(bytes, "a call without the number of the program")
                .help("program P")
                .into());
        };
        let mut number = self.count(&program, "the number of a program")?;
        let mut times = 1;
        match take(words, "L") {
            Some(count) => times = self.count(&count, "a number of calls")?,
            // Up to four digits before the four of the program say how often (FANUC).
            None if self.dialect.flow == FlowWords::MacroB && !self.dialect.haas && digits > 4 => {
                (times, number) = ((number / 10_000).max(1), number % 10_000);
            }
            None => {}
        }
        let bytes = bytes.clone();
        self.jump = Some(match code {
            Code::CallBlock => Jump::Block { number, times, bytes },
            _ => Jump::Program { number, times, bytes },
        });
        Ok(())
    }

    /// Executes a block with `G65`, `G66` or `G67`; whether it is one.
    pub(super) fn calls_macro(&mut self, words: &mut [Word<'s>]) -> Result<bool> {
        const CODES: [f64; 4] = [65.0, 66.0, 66.1, 67.0];
        let is_call = |w: &Word<'s>| w.is("G") && CODES.iter().any(|code| w.value == Some(*code));
        let Some(call) = words.iter().position(is_call) else { return Ok(false) };
        if words[call].value != Some(65.0) {
            return self.modal_macro(words, call).map(|()| true);
        }
        let bytes = words[call].bytes.clone();
        let (number, times, locals) = self.macro_call(words, call)?;
        self.jump = Some(Jump::Macro { number, times, locals, bytes });
        Ok(true)
    }

    /// Number of the program, of the calls, and the arguments of the macro call at a place among the words of a block.
    pub(super) fn macro_call(&mut self, words: &mut [Word<'s>], call: usize) -> Result<(u32, u32, Level)> {
        let bytes = words[call].bytes.clone();
        words[call].used = true;
        let Some(program) = take(words, "P") else {
            return Err(self
                .lacks(&bytes, "a call without the number of the program")
                .help("program P")
                .into());
        };
        let number = self.count(&program, "the number of a program")?;
        let times = match take(words, "L") {
            Some(count) => self.count(&count, "a number of calls")?,
            None => 1,
        };
        let step = if self.modal.length_unit == 1.0 { 0.001 } else { 0.0001 };
        let mut arguments = Arguments::new();
        for (i, word) in words.iter().enumerate().filter(|(_, w)| !w.used) {
            if i == 0 && word.is("N") {
                continue;
            }
            if i < call {
                let finding =
                    self.lacks(&word.bytes, "a word before the code of a macro call is no argument");
                return Err(finding.help("write G65 or G66 first").into());
            }
            let value = word.value.unwrap_or_default();
            let counts = !word.point && !self.points.in_units && LENGTHS.iter().any(|l| word.is(l));
            let value =
                if counts { value * if word.is("A") || word.is("C") { 0.001 } else { step } } else { value };
            let letter = word.name.as_bytes().first().copied().unwrap_or_default();
            if !arguments.take(letter, value) {
                let why = "this letter is no argument of a macro";
                return Err(self.place.not_understood(&word.bytes, why).into());
            }
        }
        Ok((number, times, arguments.level()))
    }
}
