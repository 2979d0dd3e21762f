//! Statements of macro B: `IF`, `GOTO`, `WHILE`, `DO`, `END`.

use crate::base::Result;
use crate::nc::run::Expression;

use super::block::Block;
use super::lex::range;
use super::place::Bytes;
use super::run::{Run, nothing_else};

impl<'s> Run<'s> {
    /// Runs the statement that begins at a byte of a line.
    pub(super) fn statement(
        &mut self,
        start: usize,
        at: usize,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<()> {
        let lexer = self.lexer();
        let mut expression = lexer.expression(at, end);
        let long =
            |expression: &mut Expression<'_, 's>, words: [&str; 2]| words.iter().any(|w| expression.pass(w));
        if expression.pass("IF") {
            let condition = expression.bracketed()?.is_true();
            if expression.pass("THEN") {
                let from = expression.at;
                self.reader.note_unset(&range(at, from));
                let lexer = self.lexer();
                if condition {
                    lexer.line(from, end, block)?;
                    self.block(block)?;
                }
                return Ok(());
            }
            if !long(&mut expression, ["GOTO", "GO"]) {
                let bytes = range(at, expression.at.max(at + 1));
                let finding =
                    self.reader.place.malformed(&bytes, "GOTO or THEN is missing behind the condition");
                return Err(finding.into());
            }
            if !condition {
                // The number of the block may be computed, which needs no value then.
                let stop = expression.at;
                self.reader.note_unset(&range(at, stop));
                return Ok(());
            }
            let value = expression.value()?.number().round();
            let stop = expression.at;
            return self.goes_to(range(at, stop), value, end, block);
        }
        if long(&mut expression, ["GOTO", "GO"]) {
            let value = expression.value()?.number().round();
            let stop = expression.at;
            return self.goes_to(range(at, stop), value, end, block);
        }
        if long(&mut expression, ["WHILE", "WH"]) {
            let condition = expression.bracketed()?.is_true();
            if !expression.pass("DO") {
                let bytes = range(at, expression.at.max(at + 1));
                return Err(self.reader.place.malformed(&bytes, "DO is missing behind the condition").into());
            }
            let bytes = self.label(at, expression, end, block)?;
            return self.begin(start, &bytes, condition);
        }
        if expression.pass("DO") {
            let bytes = self.label(at, expression, end, block)?;
            return self.begin(start, &bytes, true);
        }
        if long(&mut expression, ["END", "EN"]) {
            let bytes = self.label(at, expression, end, block)?;
            return self.end(start, &bytes);
        }
        let bytes = range(at, end);
        Err(self.reader.place.not_understood(&bytes, "this is no statement of macro B").into())
    }

    fn goes_to(&mut self, bytes: Bytes, value: f64, end: usize, block: &mut Block<'s>) -> Result<()> {
        self.reader.note_unset(&bytes);
        self.lexer().line(bytes.end as usize, end, block)?;
        nothing_else(&self.reader, block)?;
        if !(0.0..=f64::from(u32::MAX)).contains(&value) {
            let finding = self.reader.place.malformed(&bytes, "a block number is a whole number");
            return Err(finding.value(value, "").into());
        }
        self.go_to(value as u32, &bytes)
    }

    /// The label of a loop, and nothing behind it.
    fn label(
        &self,
        at: usize,
        mut expression: Expression<'_, 's>,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<Bytes> {
        let label = expression.value()?.number();
        let stop = expression.at;
        let bytes = range(at, stop);
        if ![1.0, 2.0, 3.0].contains(&label) {
            let finding = self.reader.place.malformed(&bytes, "loops are labelled 1, 2 or 3");
            return Err(finding.value(label, "").into());
        }
        self.lexer().line(stop, end, block)?;
        nothing_else(&self.reader, block)?;
        Ok(bytes)
    }

    fn begin(&mut self, start: usize, bytes: &Bytes, condition: bool) -> Result<()> {
        self.reader.note_unset(bytes);
        let Some(behind) = self.places().behind_end(start) else {
            return Err(self.reader.lacks(bytes, "a loop without its END").into());
        };
        if !condition {
            self.at = behind;
        }
        Ok(())
    }

    fn end(&mut self, start: usize, bytes: &Bytes) -> Result<()> {
        let Some(begin) = self.places().begin(start) else {
            return Err(self.reader.lacks(bytes, "an END without its DO").into());
        };
        self.at = begin;
        self.came_back(bytes)
    }
}
