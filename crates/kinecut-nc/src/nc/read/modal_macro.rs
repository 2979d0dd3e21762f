//! Macros that are called after each block that moves: `G66`, `G67` (FANUC).
//!
//! `G66 P L` with arguments calls nothing itself. After each block that moves an axis the macro runs with those arguments, until `G67`.
//! A `G66` within another puts its macro before it: after a move of the main program the last runs, after a move of that macro the one
//! before, and `G67` ends the last. A macro's own moves do not call it again.
//!
//! Whether a macro that changes its arguments has them changed at its next call is read in two ways: they are followed as said anew
//! with each call, and such a macro is a doubt. `G66.1`, which makes a call of every block, is refused.
//!
//! Source: operator's manual of the NCT 99M, section 20, and programming manual of the Mitsubishi M700V, section 13.5 (order of several);
//! that a macro's own moves do not call it is their rule too. For a Haas no page is known that says it has `G66`: refused.

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::run::{Level, Value};
use crate::program::Item;

use super::block::Word;
use super::place::Bytes;
use super::reader::Reader;
use super::run::Run;

/// Macros that are called after each block that moves, in the order of `G66`.
#[derive(Clone, Debug, Default)]
pub(super) struct ModalMacros {
    all: Vec<ModalMacro>,
    /// Number of them that a move calls here: all, or within one of them those before it.
    pub(super) reach: usize,
    /// Whether a macro with variables of its own runs.
    pub(super) in_macro: bool,
}

/// A call that is repeated.
#[derive(Clone, Debug)]
struct ModalMacro {
    number: u32,
    times: u32,
    locals: Level,
}

impl ModalMacros {
    /// A number that differs where another macro is called.
    pub(super) fn state(&self) -> u64 {
        let numbers = self.all.iter().map(|one| u64::from(one.number));
        numbers.fold(self.reach as u64, |a, n| a.wrapping_mul(1_000_003).wrapping_add(n + 1))
    }
}

impl<'s> Reader<'s> {
    /// Executes a block with `G66` or `G67`.
    pub(super) fn modal_macro(&mut self, words: &mut [Word<'s>], call: usize) -> Result<()> {
        let (bytes, value) = (words[call].bytes.clone(), words[call].value);
        if self.dialect.haas {
            let why = "what this control does with a call after each move is not published; G65 is read";
            return Err(self.place.not_understood(&bytes, why).into());
        }
        if value == Some(66.1) {
            let why = "every block that follows would be a call, its words arguments; only G66 is read";
            return Err(self.place.not_understood(&bytes, why).into());
        }
        if self.modal_macros.in_macro {
            let message = "G66 or G67 within a macro: what of it stays when the macro returns is not known";
            return Err(self.lacks(&bytes, message).help("write it in the program that calls").into());
        }
        if value == Some(67.0) {
            words[call].used = true;
            let first = words.first().filter(|w| w.is("N")).map(|w| w.bytes.clone());
            if let Some(word) = words.iter().find(|w| !w.used && Some(&w.bytes) != first.as_ref()) {
                let why = "G67 stands in a block of its own";
                return Err(self.place.not_understood(&word.bytes, why).into());
            }
            if self.modal_macros.all.pop().is_none() {
                self.note("G67 where no macro is called after each move");
            }
        } else {
            let (number, times, locals) = self.macro_call(words, call)?;
            self.modal_macros.all.push(ModalMacro { number, times, locals });
        }
        self.modal_macros.reach = self.modal_macros.all.len();
        Ok(())
    }

    /// Whether a block has moved an axis; `before`: number of items before it.
    fn has_moved(&self, before: usize) -> bool {
        let items = &self.program.items;
        (before..items.len()).any(|i| matches!(items.get(i), Item::Move(_) | Item::Cycle(..)))
    }
}

impl Run<'_> {
    /// Calls the macro that is in force after each move, if the block has moved; `before`: number of items before it.
    pub(super) fn call_modal_macro(&mut self, before: usize) -> Result<bool> {
        let reach = self.reader.modal_macros.reach;
        let Some(one) = reach.checked_sub(1).and_then(|last| self.reader.modal_macros.all.get(last)) else {
            return Ok(true);
        };
        if !self.reader.has_moved(before) {
            return Ok(true);
        }
        let ModalMacro { number, times, locals } = one.clone();
        self.reader.corner_without_move()?;
        let bytes: Bytes = self.reader.here.clone();
        let begin = self.called_program(number, &bytes)?;
        let depth = self.frames.len();
        let goes_on = self.call(begin, times, Some(locals), bytes)?;
        if self.frames.len() > depth
            && let Some(frame) = self.frames.last_mut()
        {
            frame.modal_macro = Some(reach);
            self.reader.modal_macros.reach = reach - 1;
        }
        Ok(goes_on)
    }

    /// Refuses a block that moves and calls another program, while a macro is called after each move.
    pub(super) fn no_modal_macro(&self, before: usize) -> Result<()> {
        if self.reader.modal_macros.reach == 0 || !self.reader.has_moved(before) {
            return Ok(());
        }
        let message =
            "a block that moves and calls another program while a macro is called after each move (G66)";
        Err(self.reader.lacks(&self.reader.here, message).help("write them in two blocks").into())
    }

    /// Says that a macro that returns has changed its arguments.
    pub(super) fn leave_modal_macro(&mut self) {
        let Some(frame) = self.frames.last() else { return };
        let Some(one) = frame.modal_macro.and_then(|reach| self.reader.modal_macros.all.get(reach - 1))
        else {
            return;
        };
        let changed = one.locals.locals.iter().enumerate().any(|(i, given)| {
            let now = self.reader.variables.numbered(i as u32 + 1);
            !given.is_nan() && now != Some(Value::Number(*given))
        });
        if !changed {
            return;
        }
        let message = format!(
            "O{} changes its arguments, and is called after each move (G66): each call is followed with those of G66",
            one.number
        );
        let said = self.reader.findings.iter().any(|f| f.message == message);
        if !said {
            let place = frame.back.0;
            let place = place.sources.locate(place.span(&frame.called));
            let finding = Finding::doubt(FindingCode::NC_ASSUMED, message).at(place);
            self.reader.findings.push(finding.help("use other variables in it"));
        }
    }
}
