//! Macro statements of FANUC and Haas, and the places that they name.

use std::collections::HashMap;

/// Places of a text that statements name.
#[derive(Debug, Default)]
pub(in crate::nc) struct Places {
    /// Programs in the order of the text: number, first byte of the line, and of the one behind it.
    programs: Vec<(u32, usize, usize)>,
    /// Lines with a block number, ascending.
    numbers: HashMap<u32, Vec<usize>>,
    /// For the line of each `DO` the one behind its `END`, and back.
    ends: HashMap<usize, usize>,
    begins: HashMap<usize, usize>,
}

/// The first byte of a line behind blanks, `/` and a block number; the block number.
#[inline]
pub(in crate::nc) fn head(line: &[u8]) -> (usize, Option<u32>) {
    let mut at = 0;
    let mut number = None;
    loop {
        match line.get(at) {
            Some(b' ' | b'\t') => at += 1,
            Some(b'/') if number.is_none() => {
                at += 1;
                at += line[at..].iter().take_while(|b| b.is_ascii_digit()).count();
            }
            Some(b'n' | b'N') if number.is_none() => {
                let mut value: Option<u32> = None;
                let mut end = at + 1;
                while let Some(byte) = line.get(end).filter(|b| matches!(b, b'0'..=b'9' | b' ')) {
                    if byte.is_ascii_digit() {
                        value = value
                            .unwrap_or(0)
                            .checked_mul(10)
                            .and_then(|v| v.checked_add(u32::from(byte - b'0')));
                    }
                    end += 1;
                }
                if value.is_none() {
                    return (at, None);
                }
                (at, number) = (end, value);
            }
            _ => return (at, number),
        }
    }
}

/// Whether a statement begins here: two letters behind one another, which no word of a block has.
#[inline]
pub(in crate::nc) fn begins(line: &[u8]) -> Option<usize> {
    let (at, _) = head(line);
    let first = line.get(at)?.to_ascii_uppercase();
    if !matches!(first, b'I' | b'W' | b'D' | b'E' | b'G') {
        return None;
    }
    let second = line[at + 1..].iter().find(|b| **b != b' ')?.to_ascii_uppercase();
    matches!((first, second), (b'I', b'F') | (b'W', b'H') | (b'D', b'O') | (b'E', b'N') | (b'G', b'O'))
        .then_some(at)
}

/// The number of a program at the head of a line.
pub(in crate::nc) fn program_number(line: &[u8]) -> Option<u32> {
    let at = line.iter().position(|b| !matches!(b, b' ' | b'\t'))?;
    if !matches!(line[at], b'O' | b'o' | b':') {
        return None;
    }
    let digits = line[at + 1..].iter().filter(|b| **b != b' ').take_while(|b| b.is_ascii_digit());
    let mut value: Option<u32> = None;
    for digit in digits {
        value = Some(value.unwrap_or(0).checked_mul(10)?.checked_add(u32::from(digit - b'0'))?);
    }
    value
}

/// The label of a `DO` or `END` from a byte on; whether it is an `END`.
fn label(line: &[u8], at: usize) -> Option<(u32, bool)> {
    let code: Vec<u8> = line[at..]
        .iter()
        .take_while(|b| !matches!(b, b';' | b'\n'))
        .filter(|b| !b.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let number = |from: &[u8]| {
        let digits: String = from.iter().take_while(|b| b.is_ascii_digit()).map(|b| *b as char).collect();
        digits.parse::<u32>().ok()
    };
    let begins = |word: &[u8]| code.starts_with(word).then(|| &code[word.len()..]);
    if let Some(rest) = begins(b"END").or_else(|| begins(b"EN")) {
        return number(rest).map(|n| (n, true));
    }
    let rest = if code.starts_with(b"WH") {
        let mut depth = 0;
        let close = code.iter().position(|b| {
            depth += i32::from(*b == b'[') - i32::from(*b == b']');
            depth == 0 && *b == b']'
        })?;
        code[close + 1..].strip_prefix(b"DO".as_slice())?
    } else {
        begins(b"DO")?
    };
    number(rest).map(|n| (n, false))
}

impl Places {
    /// Looks through a text.
    pub(in crate::nc) fn of(text: &str) -> Places {
        let mut places = Places::default();
        let mut open: Vec<(u32, usize)> = Vec::new();
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let bytes = line.as_bytes();
            let after = start + line.len();
            if let Some(number) = program_number(bytes) {
                places.programs.push((number, start, after));
                open.clear();
            }
            let (at, number) = head(bytes);
            if let Some(number) = number {
                places.numbers.entry(number).or_default().push(start);
            }
            if matches!(bytes.get(at), Some(b'W' | b'w' | b'D' | b'd' | b'E' | b'e'))
                && let Some((label, ends)) = label(bytes, at)
            {
                if !ends {
                    open.push((label, start));
                } else if let Some(i) = open.iter().rposition(|o| o.0 == label) {
                    let (_, begin) = open[i];
                    places.ends.insert(begin, after);
                    places.begins.insert(start, begin);
                    open.truncate(i);
                }
            }
            start = after;
        }
        places
    }

    /// The line behind the head of a program.
    pub(in crate::nc) fn program(&self, number: u32) -> Option<usize> {
        self.programs.iter().find(|p| p.0 == number).map(|p| p.2)
    }

    /// The line of a block number: forward from a byte to the end of its program, then from its beginning.
    pub(in crate::nc) fn block(&self, number: u32, from: usize) -> Option<usize> {
        let next = self.programs.partition_point(|p| p.1 < from);
        let begin = if next == 0 { 0 } else { self.programs[next - 1].1 };
        let end = self.programs.get(next).map_or(usize::MAX, |p| p.1);
        let lines = self.numbers.get(&number)?;
        let own = || lines.iter().copied().filter(|line| (begin..end).contains(line));
        own().find(|line| *line >= from).or_else(|| own().next())
    }

    /// The line behind the `END` of the `DO` in a line.
    pub(in crate::nc) fn behind_end(&self, start: usize) -> Option<usize> {
        self.ends.get(&start).copied()
    }

    /// The line of the `DO` of the `END` in a line.
    pub(in crate::nc) fn begin(&self, start: usize) -> Option<usize> {
        self.begins.get(&start).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_as_the_control_finds_them() {
        let text = "O1\nN10 G0\nWHILE[#1LT[2+3]]DO1\nDO 2\nEND2\nN10 END1\nM30\nO2(X)\nN10 G1\nM99\n";
        let places = Places::of(text);
        let at = |what: &str| text.find(what).unwrap();
        assert_eq!(places.program(2), Some(at("N10 G1")));
        assert_eq!(places.block(10, at("WHILE")), Some(at("N10 END1")));
        assert_eq!(places.block(10, at("M30")), Some(at("N10 G0")));
        assert_eq!(places.block(10, at("M99")), Some(at("N10 G1")));
        assert_eq!(places.block(11, 0), None);
        assert_eq!(places.behind_end(at("WHILE")), Some(at("M30")));
        assert_eq!(places.begin(at("END2")), Some(at("DO 2")));
        assert_eq!(begins(b"N5 IF[1]"), Some(3));
        assert_eq!(begins(b"G0 X1"), None);
        assert_eq!(begins(b"I5. J6."), None);
        assert_eq!(program_number(b":0097\n"), Some(97));
    }
}
