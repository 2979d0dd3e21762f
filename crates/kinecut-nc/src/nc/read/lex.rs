//! From the bytes of a line to the words of a block, each with its place.

use crate::base::Result;
use crate::nc::dialect::{Dialect, FlowWords};
use crate::nc::run::{Expression, Names, Value, WithMade};

use super::block::{Assignment, Block, Variable, Word, WordMode};
use super::number::Number;
use super::place::{Bytes, SourceText};
use super::reader::answered;

/// Largest number in a program: beyond it no control reads, and squares stay finite.
pub(super) const LARGEST: f64 = 1e9;

/// Cuts lines into words.
#[derive(Clone, Copy)]
pub(super) struct Lexer<'a, 's> {
    pub(super) place: SourceText<'s>,
    pub(super) dialect: &'static Dialect,
    /// Variables in force.
    pub(super) names: &'a dyn Names,
}

impl<'s> Lexer<'_, 's> {
    /// Reads the line from `start` to `end` (without its line end) into `block`.
    pub(super) fn line(&self, start: usize, end: usize, block: &mut Block<'s>) -> Result<()> {
        block.clear();
        let bytes = self.place.text().as_bytes();
        let mut at = start;
        while at < end {
            at = match bytes[at] {
                b' ' | b'\t' | b'\r' => at + 1,
                b';' => {
                    self.comment(at + 1, end, block);
                    end
                }
                b'(' if self.dialect.round_comments => self.round_comment(at, end, block)?,
                b'/' if block.is_empty() && block.skip.is_none() => {
                    let level = bytes[at + 1..end].iter().take_while(|b| b.is_ascii_digit()).count();
                    block.skip = Some(range(at, at + 1 + level));
                    at + 1 + level
                }
                b':' if self.dialect.program_number && block.is_empty() => {
                    let Number { value, end: stop, point, .. } =
                        self.number(at, self.blanks(at + 1, end), end)?;
                    let (name, bytes, way) = ("O", range(at, stop), WordMode::Plain);
                    block.words.push(Word { name, value, bytes, way, point, computed: false, used: false });
                    stop
                }
                b'%' if block.is_empty() => {
                    block.tape = true;
                    end
                }
                b'#' if self.dialect.flow.has_variables() => self.assignment(at, end, block)?,
                b'#' | b'[' => {
                    let token = range(at, self.token_end(at, end));
                    return Err(self
                        .place
                        .not_understood(&token, "parameters and expressions are not read yet")
                        .into());
                }
                c if c.is_ascii_alphabetic() => self.word(at, end, block)?,
                b',' if self.is_corner(at, end) => self.corner_word(at, end, block)?,
                _ => {
                    let mut stop = at + 1;
                    while !self.place.text().is_char_boundary(stop) {
                        stop += 1;
                    }
                    let token = range(at, stop);
                    let finding = self.place.malformed(&token, "this character has no meaning here");
                    return Err(answered(self.dialect, finding, 1).into());
                }
            };
        }
        Ok(())
    }

    fn comment(&self, from: usize, to: usize, block: &mut Block<'s>) {
        block.comments.push((self.place.text()[from..to].trim(), range(from, to)));
    }

    fn round_comment(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let bytes = self.place.text().as_bytes();
        let stop = bytes[at + 1..end].iter().position(|b| matches!(b, b'(' | b')')).map(|n| at + 1 + n);
        match stop {
            Some(stop) if bytes[stop] == b')' => {
                self.comment(at + 1, stop, block);
                Ok(stop + 1)
            }
            Some(stop) => {
                Err(self.place.malformed(&range(stop, stop + 1), "a comment begins within a comment").into())
            }
            None => Err(self.place.malformed(&range(at, end), "this comment is not closed").into()),
        }
    }

    /// The end of what hangs together from `at` on.
    pub(super) fn token_end(&self, at: usize, end: usize) -> usize {
        let bytes = self.place.text().as_bytes();
        let mut stop = bytes[at..end]
            .iter()
            .position(|b| matches!(b, b' ' | b'\t' | b'\r' | b';'))
            .map_or(end, |n| at + n);
        while !self.place.text().is_char_boundary(stop) {
            stop += 1;
        }
        stop.max(at + 1).min(end)
    }

    #[inline]
    pub(super) fn blanks(&self, mut at: usize, end: usize) -> usize {
        let bytes = self.place.text().as_bytes();
        while at < end && matches!(bytes[at], b' ' | b'\t') {
            at += 1;
        }
        at
    }

    fn word(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        if self.dialect.long_addresses {
            self.long_word(at, end, block)
        } else {
            self.letter_word(at, end, block)
        }
    }

    /// A letter and a number; blanks count for nothing.
    pub(super) fn letter_word(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let next = self.blanks(at + 1, end);
        let o_word = bytes[at].eq_ignore_ascii_case(&b'o') && !self.dialect.program_number;
        if self.dialect.flow.has_variables() && !o_word && self.is_computed(next, end) {
            return self.computed(at, next, end, block);
        }
        if next < end && matches!(bytes[next], b'#' | b'[') || o_word {
            let token = range(at, self.token_end(next.max(at), end));
            return Err(self
                .place
                .not_understood(&token, "parameters, expressions and O words are not read yet")
                .into());
        }
        self.numbered(at, at + 1, next, end, block)
    }

    /// Whether a value that is no plain number begins at a byte: with a parameter, a bracket, or a function.
    #[inline]
    fn is_computed(&self, from: usize, end: usize) -> bool {
        let bytes = self.place.text().as_bytes();
        let mut at = from;
        while at < end && matches!(bytes[at], b'+' | b'-') {
            at = self.blanks(at + 1, end);
        }
        match bytes.get(at).filter(|_| at < end) {
            Some(b'#' | b'[') => true,
            // A letter behind a letter is a function only with a bracket behind it.
            Some(b) if b.is_ascii_alphabetic() => {
                let rest = &bytes[at..end];
                let letters = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
                letters > 1 && rest[letters..].iter().find(|b| **b != b' ') == Some(&b'[')
            }
            _ => false,
        }
    }

    /// An address with a computed value; without a value the word counts for nothing (FANUC).
    fn computed(&self, at: usize, from: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let (value, stop) = self.value(from, end, made(block, None))?;
        let name = &self.place.text()[at..at + 1];
        let bytes = range(at, stop);
        if value == Value::Vacant {
            return Ok(stop);
        }
        let value = Some(self.in_bounds(&bytes, value.number())?);
        let way = WordMode::Plain;
        block.words.push(Word { name, value, bytes, way, point: true, computed: true, used: false });
        Ok(stop)
    }

    /// Values from a byte on.
    pub(super) fn expression(&self, from: usize, end: usize) -> Expression<'_, 's> {
        Expression::new(self.place, from, end, self.dialect.flow.arithmetic(), self.names)
    }

    /// The value at a byte, and where it ends; `made` are names that the block gives a value.
    fn value(&self, from: usize, end: usize, made: Vec<String>) -> Result<(Value, usize)> {
        let with = WithMade { names: self.names, made };
        let names: &dyn Names = if with.made.is_empty() { self.names } else { &with };
        let mut expression = Expression::new(self.place, from, end, self.dialect.flow.arithmetic(), names);
        let value = expression.value()?;
        Ok((value, expression.at))
    }

    /// `#1=2` or `#<name>=2`.
    fn assignment(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let mut expression = self.expression(at + 1, end);
        let named = self.dialect.flow == FlowWords::OWords && expression.pass("<");
        let variable = if named {
            expression.at -= 1;
            Variable::Named(expression.name()?)
        } else {
            Variable::Numbered(expression.index()?)
        };
        if !expression.pass("=") {
            let token = range(at, expression.at);
            let why = "a value belongs to a letter, or is given to a parameter with `=`";
            return Err(self.place.malformed(&token, why).into());
        }
        if self.dialect.flow == FlowWords::MacroB {
            let value = expression.value()?;
            return self.statement(at, expression, variable, value, block);
        }
        let (value, stop) = self.value(expression.at, end, made(block, Some(&variable)))?;
        block.assignments.push(Assignment { variable, value, bytes: range(at, stop) });
        Ok(stop)
    }

    /// An assignment of macro B: its value goes on to the end of the block, without brackets around it.
    fn statement(
        &self,
        at: usize,
        mut expression: Expression<'_, 's>,
        variable: Variable,
        first: Value,
        block: &mut Block<'s>,
    ) -> Result<usize> {
        let value = expression.goes_on(first)?;
        let bytes = range(at, expression.at);
        if let Value::Truth(_) = value {
            let why = "a condition has no value that a variable could hold";
            return Err(self.place.malformed(&bytes, why).into());
        }
        let stop = expression.at;
        block.assignments.push(Assignment { variable, value, bytes });
        Ok(stop)
    }

    /// A computed number that is in the range of numbers.
    pub(super) fn in_bounds(&self, bytes: &Bytes, value: f64) -> Result<f64> {
        if value.abs() <= LARGEST {
            return Ok(value);
        }
        let finding = self.place.malformed(bytes, "the number is too large");
        Err(finding.value(value, "").bound(LARGEST, "").into())
    }

    /// An address with a number that begins at `from`.
    pub(super) fn numbered(
        &self,
        at: usize,
        name_end: usize,
        from: usize,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<usize> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let Number { value, end: stop, torn, point } = self.number(at, from, end)?;
        if stop < end && matches!(bytes[stop], b'o' | b'O' | b'.') && bytes[stop - 1] != b' ' {
            let token = range(at, self.token_end(at, end));
            let why = if bytes[stop] == b'.' {
                "it has two decimal points"
            } else {
                "it has the letter O where a digit belongs"
            };
            return Err(answered(self.dialect, self.place.malformed(&token, why), 2).into());
        }
        let place = range(at, stop);
        if torn {
            block.torn = Some(place.clone());
        }
        let name = &text[at..name_end];
        let way = WordMode::Plain;
        block.words.push(Word { name, value, bytes: place, way, point, computed: false, used: false });
        Ok(stop)
    }

    /// The number from `from` on with all its signs, where the control takes several.
    fn signed(&self, from: usize, end: usize) -> Number {
        let text = &self.place.text()[..end];
        let bytes = text.as_bytes();
        let mut at = from;
        let mut minus = false;
        let sign = |at: usize| bytes.get(at).copied().filter(|b| matches!(b, b'+' | b'-'));
        while self.dialect.signs
            && let Some(first) = sign(at)
            && let next = self.blanks(at + 1, end)
            && sign(next).is_some()
        {
            minus ^= first == b'-';
            at = next;
        }
        let blanks = self.dialect.round_comments;
        let number = Number::written(text, at, blanks);
        let value = number.value.map(|v| if minus { -v } else { v });
        Number { value, ..number }
    }

    /// The number from `from` on.
    pub(super) fn number(&self, at: usize, from: usize, end: usize) -> Result<Number> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let number = self.signed(from, end);
        let last = number.end;
        match number.value {
            Some(value) if value.abs() <= LARGEST => Ok(number),
            Some(value) => {
                let finding = self.place.malformed(&range(at, last), "the number is too large");
                Err(finding.value(value, "").bound(LARGEST, "").into())
            }
            None => {
                let token = range(at, self.token_end(last.max(at + 1), end));
                let letter_o = bytes.get(last).is_some_and(|b| b.eq_ignore_ascii_case(&b'o'));
                let why = if letter_o {
                    "it has the letter O where a digit belongs"
                } else {
                    "a number is missing"
                };
                Err(self.place.malformed(&token, why).into())
            }
        }
    }
}

/// Names that a block gives a value so far, and the one that it is about to.
fn made(block: &Block<'_>, next: Option<&Variable>) -> Vec<String> {
    let all = block.assignments.iter().map(|a| &a.variable).chain(next);
    all.filter_map(|v| if let Variable::Named(name) = v { Some(name.clone()) } else { None }).collect()
}

#[inline]
pub(super) fn range(from: usize, to: usize) -> Bytes {
    // Texts end below 4 GiB.
    from as u32..to as u32
}
