//! From the bytes of a line to the words of a block, each with its place.

use crate::base::Result;
use crate::nc::dialect::{Dialect, FlowWords};
use crate::nc::run::{Expression, Names, Value};

use super::number::Number;
use super::place::{Bytes, SourceText};
use super::reader::answered;

/// A word: an address with its number, or a keyword without one.
#[derive(Clone, Debug)]
pub(super) struct Word<'t> {
    /// Address or keyword, as typed.
    pub(super) name: &'t str,
    pub(super) value: Option<f64>,
    pub(super) bytes: Bytes,
    /// Meaning of the number.
    pub(super) way: WordMode,
    /// Whether the number has a decimal point.
    pub(super) point: bool,
    /// Whether the number was computed.
    pub(super) computed: bool,
    /// Whether a code of the block has used it.
    pub(super) used: bool,
}

impl<'t> Word<'t> {
    /// Whether it has this name, in capitals or not.
    #[inline]
    pub(super) fn is(&self, name: &str) -> bool {
        match (self.name.as_bytes(), name.as_bytes()) {
            // Nearly all are one letter.
            ([own], [letter]) => own.eq_ignore_ascii_case(letter),
            (own, name) => own.eq_ignore_ascii_case(name),
        }
    }

    /// Whether GRBL reads its letter.
    pub(super) fn is_of_grbl(&self) -> bool {
        "FGIJKLMNPRSTXYZ".contains(&self.name.to_ascii_uppercase())
    }

    /// A keyword without a number.
    fn bare(name: &'t str, bytes: Bytes) -> Word<'t> {
        Word { name, value: None, bytes, way: WordMode::Plain, point: false, computed: false, used: false }
    }
}

/// Meaning of the number of a word, whatever mode is in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum WordMode {
    /// As the mode says.
    #[default]
    Plain,
    /// `AC()`.
    Absolute,
    /// `IC()`.
    Increment,
    /// To an angle by the shortest way, `DC()`, upwards, `ACP()`, or downwards, `ACN()`.
    Shortest,
    Up,
    Down,
}

/// Words of the ways.
const WAYS: [(&str, WordMode); 5] = [
    ("AC", WordMode::Absolute),
    ("IC", WordMode::Increment),
    ("DC", WordMode::Shortest),
    ("ACP", WordMode::Up),
    ("ACN", WordMode::Down),
];

/// A call with arguments, those left out as `None`.
#[derive(Clone, Debug)]
pub(super) struct Call<'t> {
    pub(super) name: &'t str,
    pub(super) arguments: Vec<Option<f64>>,
    /// The argument that is a text, between quotes.
    pub(super) text: Option<&'t str>,
    /// Places of the arguments.
    pub(super) places: Vec<Bytes>,
    pub(super) bytes: Bytes,
}

/// A variable that a block sets.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) variable: Variable,
    pub(super) value: Value,
    pub(super) bytes: Bytes,
}

/// A variable by its number or its name.
#[derive(Clone, Debug)]
pub(super) enum Variable {
    Numbered(u32),
    Named(String),
}

/// The words of a line.
#[derive(Debug, Default)]
pub(super) struct Block<'t> {
    pub(super) words: Vec<Word<'t>>,
    /// Variables that it sets, in the order of the text.
    pub(super) assignments: Vec<Assignment>,
    pub(super) comments: Vec<(&'t str, Bytes)>,
    /// Call with arguments.
    pub(super) call: Option<Call<'t>>,
    /// RegisterState message, as typed between quotes.
    pub(super) message: Option<(&'t str, Bytes)>,
    /// `/` at the beginning.
    pub(super) skip: Option<Bytes>,
    /// `%` line.
    pub(super) tape: bool,
    /// A number was written with blanks inside.
    pub(super) torn: Option<Bytes>,
}

impl Block<'_> {
    fn clear(&mut self) {
        // The lists keep their memory: a block of a loop takes none anew.
        self.words.clear();
        self.assignments.clear();
        self.comments.clear();
        (self.call, self.message, self.skip, self.torn) = (None, None, None, None);
        self.tape = false;
    }

    /// Whether it says anything.
    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty() && self.message.is_none() && self.call.is_none() && self.assignments.is_empty()
    }

    /// Whether it says nothing but words.
    #[inline]
    fn only_words(&self) -> bool {
        self.message.is_none() && self.call.is_none() && self.assignments.is_empty()
    }

    /// From the first to the last word.
    pub(super) fn bytes(&self) -> Bytes {
        // Words stand in the order of the text.
        if let (Some(first), Some(last), true) = (self.words.first(), self.words.last(), self.only_words()) {
            return first.bytes.start..last.bytes.end;
        }
        let call = self.call.iter().map(|c| &c.bytes);
        let set = self.assignments.iter().map(|a| &a.bytes);
        let words = self.words.iter().map(|w| &w.bytes);
        let mut all = self.message.iter().map(|m| &m.1).chain(call).chain(set).chain(words);
        let Some(first) = all.next() else { return 0..0 };
        all.fold(first.clone(), |a, b| a.start.min(b.start)..a.end.max(b.end))
    }
}

/// Largest number in a program: beyond it no control reads, and squares stay finite.
const LARGEST: f64 = 1e9;

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
    fn token_end(&self, at: usize, end: usize) -> usize {
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
    fn blanks(&self, mut at: usize, end: usize) -> usize {
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
        let mut expression = self.expression(from, end);
        let value = expression.value()?;
        let (name, stop) = (&self.place.text()[at..at + 1], expression.at);
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
        let value = expression.value()?;
        if self.dialect.flow == FlowWords::MacroB {
            return self.statement(at, expression, variable, value, block);
        }
        let stop = expression.at;
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
    fn in_bounds(&self, bytes: &Bytes, value: f64) -> Result<f64> {
        if value.abs() <= LARGEST {
            return Ok(value);
        }
        let finding = self.place.malformed(bytes, "the number is too large");
        Err(finding.value(value, "").bound(LARGEST, "").into())
    }

    /// An address with a number that begins at `from`.
    fn numbered(
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
    fn number(&self, at: usize, from: usize, end: usize) -> Result<Number> {
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

    /// An address of one or more letters, a keyword or a call.
    fn long_word(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let letters = bytes[at..end].iter().take_while(|b| b.is_ascii_alphabetic() || **b == b'_').count();
        let name_end = at + letters;
        let name = &text[at..name_end];
        let next = self.blanks(name_end, end);
        let whole = |to: usize| range(at, self.token_end(to, end));
        match bytes.get(next).filter(|_| next < end) {
            Some(b'=') => {
                let from = self.blanks(next + 1, end);
                if let Some(stop) = self.way(at, name_end, from, end, block)? {
                    return Ok(stop);
                }
                let plain =
                    bytes.get(from).is_some_and(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.'));
                let stop = if plain { self.number(at, from, end).map(|n| n.end) } else { Ok(from) };
                let ends = |stop: usize| {
                    stop >= end
                        || matches!(bytes[stop], b' ' | b'\t' | b'\r' | b';' | b'.')
                        || bytes[stop].is_ascii_alphabetic()
                };
                match stop {
                    Ok(stop) if plain && ends(stop) => self.numbered(at, name_end, from, end, block),
                    Err(error) if bytes.get(from + 1).is_none_or(|b| !b.is_ascii_alphabetic()) => Err(error),
                    _ => Err(self
                        .place
                        .not_understood(&whole(from.min(end)), "expressions and names are not read yet")
                        .into()),
                }
            }
            Some(b'(') if name.eq_ignore_ascii_case("MSG") => self.message(at, next, end, block),
            Some(b'(') if name.eq_ignore_ascii_case("TRAORI") => self.transformation(at, next, end, block),
            Some(b'(') => Err(self.place.not_understood(&whole(at), "calls are not read yet").into()),
            Some(b':') => {
                Err(self.place.not_understood(&whole(at), "labels and jumps are not read yet").into())
            }
            Some(b)
                if letters == 1 && b.is_ascii_digit() && self.numbered_address(at, next, end).is_some() =>
            {
                let (name_end, from) = self.numbered_address(at, next, end).unwrap_or((next, next));
                self.numbered(at, name_end, from, end, block)
            }
            Some(b) if letters == 1 && (b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.')) => {
                let stop = self.numbered(at, name_end, next, end, block)?;
                let after = self.blanks(stop, end);
                if after < end && bytes[after] == b'=' {
                    let why = if name.eq_ignore_ascii_case("R") {
                        "R parameters are not read yet"
                    } else {
                        "numbered addresses are not read yet"
                    };
                    return Err(self.place.not_understood(&whole(after), why).into());
                }
                Ok(stop)
            }
            Some(b)
                if b.is_ascii_digit()
                    && next == name_end
                    && letters > 1
                    && self.calls(name_end, end).is_some() =>
            {
                let open = self.calls(name_end, end).unwrap_or(end);
                self.call(at, open, end, block)
            }
            Some(b) if b.is_ascii_digit() && next == name_end => {
                Err(self.place.not_understood(&whole(at), "this call is not read yet").into())
            }
            _ if name.len() > 1 && name[1..].bytes().all(|b| b.eq_ignore_ascii_case(&b'o')) => {
                Err(self.place.malformed(&whole(at), "it has the letter O where a digit belongs").into())
            }
            _ if letters == 1 => Err(self.place.malformed(&whole(at), "a number is missing").into()),
            _ => {
                block.words.push(Word::bare(name, range(at, name_end)));
                Ok(name_end)
            }
        }
    }

    /// `TRAORI(1)`: the first of the machine's transformations, with its parenthesis at `open`; where it ends.
    fn transformation(&self, at: usize, open: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let text = self.place.text();
        let close = text[open..end].find(')').map(|n| open + n);
        let Some(close) = close.filter(|c| matches!(text[open + 1..*c].trim(), "" | "1")) else {
            let why = "only the first transformation is read, without further arguments";
            return Err(self.place.not_understood(&range(at, self.token_end(at, end)), why).into());
        };
        let name = text[at..open].trim_end();
        block.words.push(Word::bare(name, range(at, close + 1)));
        Ok(close + 1)
    }

    /// `IC(5)` and its like from `from` on, as the value of an axis; where it ends.
    fn way(
        &self,
        at: usize,
        name_end: usize,
        from: usize,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<Option<usize>> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let letters = bytes[from.min(end)..end].iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let found = WAYS.iter().find(|(word, _)| text[from..from + letters].eq_ignore_ascii_case(word));
        let open = self.blanks(from + letters, end);
        let (Some((_, way)), true) = (found, open < end && bytes[open] == b'(') else { return Ok(None) };
        let whole = range(at, self.token_end(open, end));
        let inner = self.blanks(open + 1, end);
        if !bytes.get(inner).is_some_and(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.')) {
            return Err(self.place.not_understood(&whole, "expressions and names are not read yet").into());
        }
        let Number { value, end: stop, point, .. } = self.number(at, inner, end)?;
        let close = self.blanks(stop, end);
        if bytes.get(close).filter(|_| close < end) != Some(&b')') {
            return Err(self.place.not_understood(&whole, "expressions and names are not read yet").into());
        }
        let (name, bytes) = (&text[at..name_end], range(at, close + 1));
        block.words.push(Word { name, value, bytes, way: *way, point, computed: false, used: false });
        Ok(Some(close + 1))
    }

    /// Ends of the name and beginning of the value of an address with a number that this control has (`A3=`).
    fn numbered_address(&self, at: usize, digits: usize, end: usize) -> Option<(usize, usize)> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let count = bytes[digits..end].iter().take_while(|b| b.is_ascii_digit()).count();
        let name_end = digits + count;
        let equals = self.blanks(name_end, end);
        if digits != at + 1 || equals >= end || bytes[equals] != b'=' {
            return None;
        }
        let known = self.dialect.axes.vector?.0;
        let name = &text[at..name_end];
        let is = |word: &&str| word.trim_end_matches('=').eq_ignore_ascii_case(name);
        known.iter().any(is).then(|| (name_end, self.blanks(equals + 1, end)))
    }

    /// The bracket after the number of a name (`CYCLE81(`).
    fn calls(&self, from: usize, end: usize) -> Option<usize> {
        let bytes = self.place.text().as_bytes();
        let digits = bytes[from..end].iter().take_while(|b| b.is_ascii_digit()).count();
        let open = self.blanks(from + digits, end);
        (open < end && bytes[open] == b'(').then_some(open)
    }

    /// A call whose arguments are numbers, or left out.
    fn call(&self, at: usize, open: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let name = text[at..open].trim_ascii_end();
        let whole = range(at, self.token_end(at, end));
        let swivel = name.eq_ignore_ascii_case(crate::nc::sinumerik::swivel::NAME);
        if crate::nc::sinumerik::cycle::Call::parse(name).is_none() && !swivel {
            return Err(self.place.not_understood(&whole, "this call is not read yet").into());
        }
        if block.call.is_some() {
            return Err(self.place.malformed(&whole, "a block has one call").into());
        }
        let (mut arguments, mut places) = (Vec::new(), Vec::new());
        let mut said = None;
        let mut from = open + 1;
        loop {
            let here = self.blanks(from, end);
            let (value, stop) = match bytes.get(here).filter(|_| here < end) {
                Some(b',' | b')') => (None, here),
                // The name of the machine's swivel data.
                Some(b'"') if swivel && arguments.len() == crate::nc::sinumerik::swivel::TC => {
                    let Some(close) = text[here + 1..end].find('"').map(|n| here + 1 + n) else {
                        let token = range(at, end);
                        return Err(self.place.malformed(&token, "the name has no closing quote").into());
                    };
                    said = Some(&text[here + 1..close]);
                    (None, close + 1)
                }
                Some(b) if b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.') => {
                    let Number { value, end: stop, .. } = self.number(at, here, end)?;
                    (value, stop)
                }
                Some(_) => {
                    let token = range(at, self.token_end(here, end));
                    return Err(self
                        .place
                        .not_understood(&token, "expressions and names are not read yet")
                        .into());
                }
                None => {
                    let token = range(at, end);
                    return Err(self.place.malformed(&token, "the call has no closing bracket").into());
                }
            };
            arguments.push(value);
            places.push(range(here, stop.max(here + 1)));
            let after = self.blanks(stop, end);
            match bytes.get(after).filter(|_| after < end) {
                Some(b',') => from = after + 1,
                Some(b')') => {
                    let bytes = range(at, after + 1);
                    block.call = Some(Call { name, arguments, text: said, places, bytes });
                    return Ok(after + 1);
                }
                Some(_) => {
                    let token = range(at, self.token_end(after, end));
                    return Err(self
                        .place
                        .not_understood(&token, "expressions and names are not read yet")
                        .into());
                }
                None => {
                    return Err(self
                        .place
                        .malformed(&range(at, end), "the call has no closing bracket")
                        .into());
                }
            }
        }
    }

    /// `MSG("text")` or `MSG()`.
    fn message(&self, at: usize, open: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
        let text = &self.place.text()[..end];
        let bad = || self.place.malformed(&range(at, end), "a message is MSG(\"text\")").into();
        let inner = self.blanks(open + 1, end);
        let (from, to, close) = match text.as_bytes().get(inner) {
            Some(b')') => (inner, inner, inner),
            Some(b'"') => {
                let to = text[inner + 1..].find('"').map(|n| inner + 1 + n).ok_or_else(bad)?;
                (inner + 1, to, self.blanks(to + 1, end))
            }
            _ => return Err(bad()),
        };
        if text.as_bytes().get(close) != Some(&b')') {
            return Err(bad());
        }
        block.message = Some((&text[from..to], range(at, close + 1)));
        Ok(close + 1)
    }
}

#[inline]
pub(super) fn range(from: usize, to: usize) -> Bytes {
    // Texts end below 4 GiB.
    from as u32..to as u32
}
