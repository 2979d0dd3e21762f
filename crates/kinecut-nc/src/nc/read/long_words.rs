//! Words of SINUMERIK: addresses of several letters with `=`, keywords, calls with arguments, messages.

use crate::base::Result;

use super::block::{Block, Call, Word, WordMode};
use super::lex::{Lexer, range};
use super::number::Number;

/// Words of the ways.
const WAYS: [(&str, WordMode); 5] = [
    ("AC", WordMode::Absolute),
    ("IC", WordMode::Increment),
    ("DC", WordMode::Shortest),
    ("ACP", WordMode::Up),
    ("ACN", WordMode::Down),
];

impl<'s> Lexer<'_, 's> {
    /// An address of one or more letters, a keyword or a call.
    pub(super) fn long_word(&self, at: usize, end: usize, block: &mut Block<'s>) -> Result<usize> {
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
