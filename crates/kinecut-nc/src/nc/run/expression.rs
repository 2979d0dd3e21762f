//! Expressions, evaluated where they are written.
//!
//! By precedence climbing from left to right over the bytes of a line; blanks count for nothing. No tree is built: an
//! expression in a loop is read again in the time in which its tree would be walked.

use crate::base::{Code, Finding, Result};
use crate::nc::read::number::Number;
use crate::nc::read::place::{Bytes, SourceText};

use super::arithmetic::{Function, Operator};
use super::{Arithmetic, Known, Names, Value};

/// Deepest brackets: what a stack holds with room to spare.
const DEEPEST: usize = 64;
/// Letters of the longest name of a function.
const LONGEST_NAME: usize = 6;
/// Farthest from a whole number that the number of a parameter may be.
const WHOLE: f64 = 1e-4;

/// Reads values from a line.
pub(in crate::nc) struct Expression<'a, 's> {
    place: SourceText<'s>,
    bytes: &'s [u8],
    /// The next byte.
    pub(in crate::nc) at: usize,
    end: usize,
    arithmetic: Arithmetic,
    names: &'a dyn Names,
    depth: usize,
}

impl<'a, 's> Expression<'a, 's> {
    /// From byte `at` of the text on, up to `end`.
    pub(in crate::nc) fn new(
        place: SourceText<'s>,
        at: usize,
        end: usize,
        arithmetic: Arithmetic,
        names: &'a dyn Names,
    ) -> Expression<'a, 's> {
        Expression { place, bytes: place.text().as_bytes(), at, end, arithmetic, names, depth: 0 }
    }

    #[inline]
    fn skip(&mut self) {
        while self.at < self.end && matches!(self.bytes[self.at], b' ' | b'\t' | b'\r') {
            self.at += 1;
        }
    }

    /// The next byte that is no blank, in capitals.
    #[inline]
    fn peek(&mut self) -> Option<u8> {
        self.skip();
        (self.at < self.end).then(|| self.bytes[self.at].to_ascii_uppercase())
    }

    /// Whether this sign or word comes next; it is passed.
    #[inline]
    pub(in crate::nc) fn pass(&mut self, word: &str) -> bool {
        let before = self.at;
        for byte in word.bytes() {
            if self.peek() != Some(byte) {
                self.at = before;
                return false;
            }
            self.at += 1;
        }
        true
    }

    /// Passes comments in round brackets.
    pub(in crate::nc) fn pass_comments(&mut self) -> Result<()> {
        while self.peek() == Some(b'(') {
            let Some(length) = self.bytes[self.at..self.end].iter().position(|b| *b == b')') else {
                let bytes = self.at as u32..self.end as u32;
                return Err(self.place.malformed(&bytes, "this comment is not closed").into());
            };
            self.at += length + 1;
        }
        Ok(())
    }

    /// From a byte to where reading is.
    fn since(&self, from: usize) -> Bytes {
        from as u32..self.at.max(from + 1).min(self.end.max(from + 1)) as u32
    }

    fn expected(&mut self, what: &str) -> Finding {
        self.skip();
        let mut stop = (self.at + 1).min(self.end);
        while !self.place.text().is_char_boundary(stop) {
            stop += 1;
        }
        let from = self.at.min(stop);
        if from == stop {
            let line = &self.place.text()[..self.end];
            let start = line.trim_end().len().saturating_sub(1);
            let bytes = start as u32..self.end.max(start) as u32;
            return self.place.error(Code::NC_SYNTAX, &bytes, format!("the block ends where {what} belongs"));
        }
        let bytes = from as u32..stop as u32;
        let shown = self.place.shown(&bytes);
        self.place.error(Code::NC_SYNTAX, &bytes, format!("`{shown}` is where {what} belongs"))
    }

    fn bracket(&mut self, sign: &str) -> Result<()> {
        if self.pass(sign) { Ok(()) } else { Err(self.expected(&format!("`{sign}`")).into()) }
    }

    fn deeper(&mut self) -> Result<()> {
        self.depth += 1;
        if self.depth <= DEEPEST {
            return Ok(());
        }
        let bytes = self.at as u32..self.at as u32 + 1;
        let finding = self.place.error(Code::NC_SYNTAX, &bytes, "the brackets are nested too deep");
        Err(finding.value(self.depth as f64, "").bound(DEEPEST as f64, "").into())
    }

    /// A value in brackets.
    pub(in crate::nc) fn bracketed(&mut self) -> Result<Value> {
        self.deeper()?;
        self.bracket("[")?;
        let value = self.chain(0)?;
        self.bracket("]")?;
        self.depth -= 1;
        Ok(value)
    }

    /// Values joined by operators of at least a rank.
    fn chain(&mut self, least: u8) -> Result<Value> {
        let from = self.at;
        let first = self.value()?;
        self.joined_on(from, first, least)
    }

    /// A value that was read, and what operators join to it.
    pub(in crate::nc) fn goes_on(&mut self, first: Value) -> Result<Value> {
        self.joined_on(self.at, first, 0)
    }

    fn joined_on(&mut self, from: usize, first: Value, least: u8) -> Result<Value> {
        let mut left = first;
        while let Some((operator, rank, length)) = self.operator() {
            if rank < least {
                break;
            }
            self.pass(length);
            let right = self.chain(rank + 1)?;
            left = self.joined(operator, left, right, from)?;
        }
        Ok(left)
    }

    /// The operator that comes next; it is not passed.
    fn operator(&mut self) -> Option<(Operator, u8, &'static str)> {
        let first = self.peek()?;
        // What ends most values is looked for in no table.
        if !matches!(first, b'*' | b'/' | b'+' | b'-' | b'A'..=b'Z') {
            return None;
        }
        let before = self.at;
        let mut table = self.arithmetic.operators().iter().filter(|(word, _, _)| word.as_bytes()[0] == first);
        let found = table.find(|(word, _, _)| self.pass(word));
        self.at = before;
        found.map(|(word, operator, rank)| (*operator, *rank, *word))
    }

    fn joined(&self, operator: Operator, a: Value, b: Value, from: usize) -> Result<Value> {
        let compares = matches!(
            operator,
            Operator::Equal
                | Operator::NotEqual
                | Operator::Greater
                | Operator::GreaterEqual
                | Operator::Less
                | Operator::LessEqual
        );
        // Only these tell a variable without a value from nought.
        let vacancy = a == Value::Vacant || b == Value::Vacant;
        match operator {
            Operator::Equal if vacancy => return Ok(Value::Truth(a == b)),
            Operator::NotEqual if vacancy => return Ok(Value::Truth(a != b)),
            _ => {}
        }
        let number = self
            .arithmetic
            .apply(operator, a.number(), b.number())
            .map_err(|why| self.no_value(from, why))?;
        let truths = matches!((a, b), (Value::Truth(_), Value::Truth(_)));
        let logic = matches!(operator, Operator::And | Operator::Or | Operator::Xor);
        if compares || truths && logic {
            return Ok(Value::Truth(number != 0.0));
        }
        self.finite(number, from)
    }

    fn finite(&self, number: f64, from: usize) -> Result<Value> {
        if number.is_finite() {
            return Ok(Value::Number(number));
        }
        Err(self.no_value(from, "it is too large for a number").into())
    }

    fn no_value(&self, from: usize, why: &str) -> Finding {
        let bytes = self.since(from);
        let message = format!("`{}` has no value: {why}", self.place.shown(&bytes).trim());
        self.place.error(Code::NC_STATE, &bytes, message)
    }

    /// A number, parameter, bracket or function with its signs.
    pub(in crate::nc) fn value(&mut self) -> Result<Value> {
        let from = self.at;
        match self.peek() {
            Some(b'[') => self.bracketed(),
            Some(b'#') => {
                self.at += 1;
                self.parameter(from)
            }
            Some(sign @ (b'+' | b'-')) => {
                let sign_at = self.at;
                self.at += 1;
                match self.peek() {
                    Some(b'0'..=b'9' | b'.') => {
                        self.at = sign_at;
                        self.number()
                    }
                    _ => {
                        self.deeper()?;
                        let value = self.value()?;
                        self.depth -= 1;
                        Ok(if sign == b'-' { Value::Number(-value.number()) } else { value })
                    }
                }
            }
            Some(b'0'..=b'9' | b'.') => self.number(),
            Some(b'A'..=b'Z') => self.function(from),
            _ => Err(self.expected("a value").into()),
        }
    }

    fn number(&mut self) -> Result<Value> {
        let number = Number::written(&self.place.text()[..self.end], self.at, true);
        match number.value {
            Some(value) => {
                self.at = number.end;
                Ok(Value::Number(value))
            }
            None => Err(self.expected("a number").into()),
        }
    }

    fn function(&mut self, from: usize) -> Result<Value> {
        let mut name = [0; LONGEST_NAME];
        let mut length = 0;
        while let Some(letter) = self.peek().filter(u8::is_ascii_uppercase) {
            if let Some(place) = name.get_mut(length) {
                *place = letter;
            }
            length += 1;
            self.at += 1;
        }
        let name = name.get(..length).and_then(|name| std::str::from_utf8(name).ok());
        let Some(function) = name.and_then(|name| self.arithmetic.function(name)) else {
            let bytes = self.since(from);
            let why = "an expression has no function of this name";
            return Err(self.place.not_understood(&bytes, why).into());
        };
        if function == Function::Exists {
            return self.exists();
        }
        self.deeper()?;
        self.bracket("[")?;
        let first = self.chain(0)?.number();
        let mut second = None;
        if matches!(function, Function::ArcTangent | Function::PowerOf) && self.pass(",") {
            second = Some(self.chain(0)?.number());
        }
        self.bracket("]")?;
        let quotient = function == Function::ArcTangent && second.is_none();
        if quotient && self.pass("/") {
            second = Some(self.bracketed()?.number());
        } else if quotient && self.arithmetic == Arithmetic::Ngc {
            return Err(self.expected("`/` and the second value of ATAN").into());
        }
        self.depth -= 1;
        let number = match (function, second) {
            (Function::ArcTangent, Some(x)) => Ok(self.arithmetic.angle(first, x)),
            (Function::PowerOf, Some(power)) => self.arithmetic.apply(Operator::Power, first, power),
            (Function::PowerOf, None) => return Err(self.expected("`,` and the power").into()),
            _ => self.arithmetic.call(function, first),
        };
        let number = number.map_err(|why| self.no_value(from, why))?;
        self.finite(number, from)
    }

    /// `EXISTS[#<name>]`.
    fn exists(&mut self) -> Result<Value> {
        self.bracket("[")?;
        self.bracket("#")?;
        let name = self.name()?;
        self.bracket("]")?;
        Ok(Value::Number(f64::from(u8::from(self.names.named(&name) != Known::Missing))))
    }

    /// A name in `<>`.
    pub(in crate::nc) fn name(&mut self) -> Result<String> {
        self.bracket("<")?;
        let from = self.at;
        let Some(length) = self.bytes[from..self.end].iter().position(|b| *b == b'>') else {
            let bytes = from as u32 - 1..self.end as u32;
            return Err(self.place.malformed(&bytes, "the name is not closed (`>`)").into());
        };
        self.at = from + length + 1;
        let name: String = self.place.text()[from..from + length]
            .chars()
            .filter(|c| !c.is_ascii_whitespace())
            .map(|c| c.to_ascii_lowercase())
            .collect();
        if name.is_empty() {
            return Err(self.place.malformed(&self.since(from - 1), "the name is empty").into());
        }
        Ok(name)
    }

    /// The number of a parameter behind `#`.
    pub(in crate::nc) fn index(&mut self) -> Result<u32> {
        let from = self.at;
        let value = self.value()?.number();
        let whole = value.round();
        let near = self.arithmetic == Arithmetic::MacroB || (value - whole).abs() <= WHOLE;
        if near && (0.0..=f64::from(u32::MAX)).contains(&whole) {
            return Ok(whole as u32);
        }
        let bytes = self.since(from);
        Err(self.place.malformed(&bytes, "the number of a parameter is whole").value(value, "").into())
    }

    /// The value of the parameter whose number or name comes next; its `#` is at `from`.
    fn parameter(&mut self, from: usize) -> Result<Value> {
        self.deeper()?;
        let known = if self.peek() == Some(b'<') && self.arithmetic == Arithmetic::Ngc {
            let name = self.name()?;
            self.names.named(&name)
        } else {
            let index = self.index()?;
            self.names.numbered(index)
        };
        self.depth -= 1;
        match known {
            Known::Value(value) => Ok(value),
            Known::Unknown(why) => Err(self.no_value(from, why).into()),
            Known::Missing => {
                let bytes = self.since(from);
                let message =
                    format!("`{}` has no value: nothing has set it", self.place.shown(&bytes).trim());
                Err(self.place.error(Code::NC_STATE, &bytes, message).into())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Sources;

    struct Few;

    impl Names for Few {
        fn numbered(&self, number: u32) -> Known {
            match number {
                0 => Known::Value(Value::Vacant),
                1 => Known::Value(Value::Number(2.0)),
                2 => Known::Value(Value::Number(30.0)),
                9 => Known::Unknown("the clock is known at the machine only"),
                _ => Known::Missing,
            }
        }

        fn named(&self, name: &str) -> Known {
            if name == "depth" { Known::Value(Value::Number(-5.0)) } else { Known::Missing }
        }
    }

    fn evaluated(text: &str, arithmetic: Arithmetic) -> Result<Value> {
        let mut sources = Sources::default();
        let file = sources.add("a", text);
        let place = SourceText::new(&sources, file);
        Expression::new(place, 0, text.len(), arithmetic, &Few).value()
    }

    #[test]
    fn values_are_those_of_each_language() {
        let both = |text| [Arithmetic::Ngc, Arithmetic::MacroB].map(|a| evaluated(text, a).unwrap().number());
        assert_eq!(both("[1+2*3]"), [7.0; 2]);
        assert_eq!(both("-[2-5]"), [3.0; 2]);
        assert_eq!(both("#[#1-1]"), [2.0; 2]);
        assert_eq!(both("[ S I N [#2] ]").map(|v| (v * 1e9).round()), [5e8; 2]);
        assert_eq!(both("[-2 MOD 5]"), [3.0, -2.0]);
        assert_eq!(both("[1 + ATAN[-1]/[-1]]"), [-134.0, 226.0]);
        let ngc = |text| evaluated(text, Arithmetic::Ngc).unwrap().number();
        assert_eq!((ngc("[-2 ** 2]"), ngc("[2**3**2]")), (4.0, 64.0));
        assert_eq!((ngc("[1 AND 3 EQ 3]"), ngc("##1"), ngc("#<DE pth>")), (1.0, 30.0, -5.0));
        assert_eq!((ngc("EXISTS[#<depth>]"), ngc("EXISTS[#<no>]")), (1.0, 0.0));
        let fanuc = |text| evaluated(text, Arithmetic::MacroB).unwrap();
        assert_eq!(fanuc("[#0EQ0]"), Value::Truth(false));
        assert_eq!(fanuc("[[#1EQ2]AND[#2GT#1]]"), Value::Truth(true));
        assert_eq!(fanuc("[6AND3]"), Value::Number(2.0));
        assert_eq!(fanuc("#0"), Value::Vacant);
        assert_eq!(fanuc("[#0+1]"), Value::Number(1.0));
    }

    #[test]
    fn a_fault_is_said_with_its_place() {
        let said = |text: &str| evaluated(text, Arithmetic::Ngc).unwrap_err().to_string();
        assert_eq!(said("[1/0]"), "a:1:2: `1/0` has no value: division by zero");
        assert_eq!(said("#7"), "a:1:1: `#7` has no value: nothing has set it");
        assert_eq!(said("#9"), "a:1:1: `#9` has no value: the clock is known at the machine only");
        assert_eq!(said("[1+]"), "a:1:4: `]` is where a value belongs");
        assert_eq!(said("[1+2"), "a:1:4: the block ends where `]` belongs");
        assert_eq!(
            said("FOO[1]"),
            "a:1:1: `FOO` is not understood: an expression has no function of this name"
        );
        assert!(said(&"[".repeat(100)).contains("nested too deep"));
        assert!(said("[10**999]").contains("too large"));
        assert!(said("#1.5").contains("the number of a parameter is whole"));
    }
}
