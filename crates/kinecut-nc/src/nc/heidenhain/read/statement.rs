//! From lines to statements: block number, words with their places, comments.
//!
//! A line that ends with `~` goes on in the next one. Numbers may have a sign, a point or a comma; blanks between
//! an address and its number count for nothing.

use crate::base::{Finding, Result};
use crate::nc::multi_axis::ROTARY;
use crate::nc::read::place::{Bytes, SourceText};

/// A word: an address with what follows it.
#[derive(Clone, Debug, Default)]
pub(super) struct Word<'s> {
    /// Address, as typed; empty for a bare number or a text.
    pub(super) name: &'s str,
    pub(super) value: Option<f64>,
    /// A sign without a number (`DR+`): whether it is plus.
    pub(super) sign: Option<bool>,
    /// Text between quotes.
    pub(super) text: Option<&'s str>,
    /// Number of the parameter that the value is given to (`Q200=2`).
    pub(super) parameter: Option<u32>,
    /// Number of the parameter that the value is taken from (`A+Q120`).
    pub(super) from: Option<u32>,
    pub(super) bytes: Bytes,
    pub(super) used: bool,
}

impl Word<'_> {
    pub(super) fn is(&self, name: &str) -> bool {
        self.parameter.is_none() && self.name.eq_ignore_ascii_case(name)
    }
}

/// A block, over all its lines.
#[derive(Clone, Debug, Default)]
pub(super) struct Statement<'s> {
    pub(super) words: Vec<Word<'s>>,
    pub(super) comments: Vec<(&'s str, Bytes)>,
    /// `/` before the block.
    pub(super) skip: Option<Bytes>,
    /// Place of the words.
    pub(super) bytes: Bytes,
}

/// Statements that are known and refused, with the reason.
const REFUSED: &[(&str, &str)] = &[
    ("FN", "Q parameters and jumps are not read yet"),
    ("Q", "Q parameters are not read yet"),
    ("QL", "Q parameters are not read yet"),
    ("QR", "Q parameters are not read yet"),
    ("QS", "Q parameters are not read yet"),
    ("IF", "jumps are not read yet"),
    ("CALL", "calls of labels and programs are not read yet: write the blocks out"),
    ("TCH", "probing moves axes to where only the machine knows"),
    ("APPR", "approaches are not read yet: give their lines and arcs"),
    ("DEP", "departures are not read yet: give their lines and arcs"),
    ("RND", "rounded corners are not read yet"),
    ("CHF", "chamfers are not read yet"),
    ("SPL", "splines are not read yet"),
    ("CTP", "polar tangent arcs are not read yet"),
    ("FL", "free contours (FK) are not read"),
    ("FLT", "free contours (FK) are not read"),
    ("FC", "free contours (FK) are not read"),
    ("FCT", "free contours (FK) are not read"),
    ("FPOL", "free contours (FK) are not read"),
    ("FSELECT", "free contours (FK) are not read"),
    ("PATTERN", "patterns are not read yet"),
    ("SEL", "selected programs and tables are not read"),
    ("SQL", "table access is not read"),
    ("TRAFO", "this transformation is not read yet"),
];
/// Rotary axes, whose values may be what the control has computed: `Q120` to `Q122`.
const COMPUTED: std::ops::RangeInclusive<u32> = 120..=122;

/// Largest number in a program.
const LARGEST: f64 = 1e9;

/// Cuts a text into statements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lexer<'s> {
    pub(super) place: SourceText<'s>,
}

impl<'s> Lexer<'s> {
    /// The statement that begins at `start`, and where the next one does.
    pub(super) fn statement(&self, start: usize) -> Result<(Statement<'s>, usize)> {
        let text = self.place.text();
        let mut statement = Statement::default();
        let mut at = start;
        let mut first = true;
        let mut comment = false;
        loop {
            let stop = text[at..].find('\n').map_or(text.len(), |n| at + n);
            let line = text[at..stop].trim_end();
            let goes_on = line.ends_with('~');
            let end = at + line.trim_end_matches('~').len();
            let from = if first { self.number(at, end, &mut statement) } else { at };
            let from = self.blanks(from, end);
            if first && from < end {
                statement.bytes = range(from, end);
                self.refuse(from, end)?;
            }
            if comment || first && text[from..end].starts_with('*') {
                let mark = usize::from(text[from..end].starts_with('*'));
                statement.comments.push((text[from + mark..end].trim(), range(from, end)));
                comment = true;
            } else if first && is_frame(&text[from..end]) {
                // A program name may be anything.
                let name = text[from..end].split_ascii_whitespace().next().unwrap_or("");
                let text = Some(&text[from..end]);
                statement.words.push(Word { name, text, bytes: range(from, end), ..Word::default() });
            } else {
                self.words(from, end, &mut statement)?;
                comment = first && statement.words.is_empty();
            }
            if let (Some(first), Some(last)) = (statement.words.first(), statement.words.last()) {
                statement.bytes = first.bytes.start..last.bytes.end;
            }
            at = stop + 1;
            first = false;
            if !goes_on || at >= text.len() {
                return Ok((statement, at.min(text.len())));
            }
        }
    }

    /// Skip mark and block number; where the rest begins.
    fn number(&self, at: usize, end: usize, statement: &mut Statement<'s>) -> usize {
        let bytes = self.place.text().as_bytes();
        let mut at = self.blanks(at, end);
        if at < end && bytes[at] == b'/' {
            statement.skip = Some(range(at, at + 1));
            at = self.blanks(at + 1, end);
        }
        at + bytes[at..end].iter().take_while(|b| b.is_ascii_digit()).count()
    }

    fn refuse(&self, from: usize, end: usize) -> Result<()> {
        let text = &self.place.text()[from..end];
        let letters = text.bytes().take_while(u8::is_ascii_alphabetic).count();
        let Some((_, why)) = REFUSED.iter().find(|(name, _)| name.eq_ignore_ascii_case(&text[..letters]))
        else {
            return Ok(());
        };
        let shown = text.split(';').next().unwrap_or("").trim_end().len();
        Err(self.place.not_understood(&range(from, from + shown), why).into())
    }

    fn blanks(&self, at: usize, end: usize) -> usize {
        let bytes = self.place.text().as_bytes();
        at + bytes[at..end].iter().take_while(|b| b.is_ascii_whitespace()).count()
    }

    fn words(&self, from: usize, end: usize, statement: &mut Statement<'s>) -> Result<()> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let mut at = from;
        while at < end {
            match bytes[at] {
                b if b.is_ascii_whitespace() => at += 1,
                b';' => {
                    statement.comments.push((text[at + 1..end].trim(), range(at, end)));
                    at = end;
                }
                b'"' => {
                    let Some(n) = text[at + 1..end].find('"') else {
                        return Err(self.place.malformed(&range(at, end), "this text is not closed").into());
                    };
                    let stop = at + 2 + n;
                    let inner = Some(&text[at + 1..stop - 1]);
                    statement.words.push(Word { text: inner, bytes: range(at, stop), ..Word::default() });
                    at = stop;
                }
                b if b.is_ascii_alphanumeric() || matches!(b, b'.' | b',' | b'+' | b'-') => {
                    let (word, stop) = self.word(at, end)?;
                    statement.words.push(word);
                    at = stop;
                }
                _ => {
                    let stop = at + text[at..].chars().next().map_or(1, char::len_utf8);
                    let token = range(at, stop);
                    return Err(self.place.malformed(&token, "this character has no meaning here").into());
                }
            }
        }
        Ok(())
    }

    fn word(&self, at: usize, end: usize) -> Result<(Word<'s>, usize)> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let name_end = at + bytes[at..end].iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let mut word = Word { name: &text[at..name_end], ..Word::default() };
        let mut from = self.blanks(name_end, end);
        if word.is("MODE") && bytes.get(name_end) == Some(&b':') {
            // Of the tolerance cycle.
            from = name_end + 1;
        }
        let (mut value, mut stop) = self.value(at, from, end)?;
        if stop == from {
            stop = name_end;
        }
        if value.is_none() && stop > name_end {
            // A sign alone, or before a parameter.
            word.sign = Some(bytes[from] == b'+');
            if bytes.get(self.blanks(stop, end)).is_some_and(|b| b.eq_ignore_ascii_case(&b'q'))
                && self.blanks(stop, end) < end
                && !word.name.is_empty()
            {
                let (digits, to) = (self.blanks(stop, end) + 1, self.token_end(self.blanks(stop, end), end));
                let number = text[digits..to].parse().ok().filter(|n| COMPUTED.contains(n));
                if number.is_none() || !ROTARY.iter().any(|axis| word.is(axis)) {
                    let token = range(at, to);
                    return Err(self.place.not_understood(&token, "Q parameters are not read yet").into());
                }
                (word.from, stop) = (number, to);
            }
        }
        if let (Some(number), "Q" | "q") = (value, word.name) {
            let equals = self.blanks(stop, end);
            if equals >= end || bytes[equals] != b'=' || number.fract() != 0.0 || number < 0.0 {
                let token = range(at, stop);
                return Err(self.place.not_understood(&token, "Q parameters are not read yet").into());
            }
            word.parameter = Some(number as u32);
            let from = self.blanks(equals + 1, end);
            let (given, to) = self.value(at, from, end)?;
            if given.is_none() {
                let token = range(at, self.token_end(from.max(at + 1).min(end), end));
                return Err(self.place.not_understood(&token, "Q parameters are not read yet").into());
            }
            (value, stop) = (given, to);
        }
        word.value = value;
        word.bytes = range(at, stop);
        let after = bytes.get(stop).filter(|_| stop < end);
        let bad = match after {
            Some(b'.' | b',') => Some("it has two decimal points"),
            Some(b'o' | b'O') if value.is_some() => Some("it has the letter O where a digit belongs"),
            Some(b'=') => Some("this word takes no `=`"),
            _ => None,
        };
        match bad {
            Some(why) => Err(self.place.malformed(&range(at, self.token_end(stop, end)), why).into()),
            None => Ok((word, stop)),
        }
    }

    /// The number at `from`, if there is one, and its end; a sign without a number ends after the sign.
    fn value(&self, at: usize, from: usize, end: usize) -> Result<(Option<f64>, usize)> {
        let text = self.place.text();
        let bytes = text.as_bytes();
        let sign = usize::from(from < end && matches!(bytes[from], b'+' | b'-'));
        let first = if sign == 1 { self.blanks(from + 1, end) } else { from };
        let mut stop = first;
        let mut point = false;
        while stop < end && (bytes[stop].is_ascii_digit() || !point && matches!(bytes[stop], b'.' | b',')) {
            point |= !bytes[stop].is_ascii_digit();
            stop += 1;
        }
        if !text[first..stop].bytes().any(|b| b.is_ascii_digit()) {
            if stop > first {
                return Err(self.place.malformed(&range(at, stop), "a number is missing").into());
            }
            return Ok((None, from + sign));
        }
        let Ok(size) = text[first..stop].replace(',', ".").parse::<f64>() else {
            return Err(self.place.malformed(&range(at, stop), "this is no number").into());
        };
        if size > LARGEST {
            let finding: Finding = self.place.malformed(&range(at, stop), "the number is too large");
            return Err(finding.value(size, "").bound(LARGEST, "").into());
        }
        let negative = sign == 1 && bytes[from] == b'-';
        Ok((Some(if negative { -size } else { size }), stop))
    }

    fn token_end(&self, at: usize, end: usize) -> usize {
        let text = self.place.text();
        let length = text[at..end].find(|c: char| c.is_whitespace() || c == ';').unwrap_or(end - at);
        at + length
    }
}

/// Whether a line is the first or last of a program.
fn is_frame(line: &str) -> bool {
    let mut words = line.split_ascii_whitespace();
    let (first, second) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
    (first.eq_ignore_ascii_case("BEGIN") || first.eq_ignore_ascii_case("END"))
        && second.eq_ignore_ascii_case("PGM")
}

fn range(from: usize, to: usize) -> Bytes {
    // Texts end below 4 GiB.
    from as u32..to as u32
}
