//! The text of a long program: patterns of lines, and the numbers in them.
//!
//! A program is mostly one pattern, `X Y Z` with other numbers on each line, and its numbers change evenly: as columns of
//! differences they take a tenth of the room of deflated text. What is read back is the text, letter by letter: a number is
//! taken out of its line only where its value and its decimals give it again.
//!
//! A pattern is the text of a line with a mark for each number: [`WHOLE`] without a dot, [`DOTTED`] and the decimals with
//! one. A number belongs to the column of the last letter before it; numbers with a dot have a column of their own, in
//! steps of its finest decimal. Texts that are shown have no control characters of their own.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::Streams;
use super::numbers::Numbers;
use crate::page::visible;

/// Mark of a number without a dot.
const WHOLE: u8 = 0x0e;
/// Mark of a number with a dot and no decimals; those of one, two decimals follow.
const DOTTED: u8 = 0x0f;
/// Most decimals, and digits before the dot, of a number with a dot. Together their digits stay below
/// [`GREATEST`](super::numbers::GREATEST).
const DECIMALS: usize = 8;
const WHOLE_DIGITS: usize = 6;
/// Most digits of a number without a dot.
const DIGITS: usize = 14;
/// Columns: those of no letter, of A to Z and of a to z, without a dot and with one.
const COLUMNS: usize = 2 * 53;

pub(super) fn streams(lines: &[String], streams: &mut Streams) {
    let mut listing = Listing::default();
    lines.iter().for_each(|line| listing.line(visible(line).as_bytes()));
    streams.push(("kc-patterns", listing.patterns));
    let mut numbers = Numbers::default();
    numbers.column(&listing.ids);
    for column in listing.columns.iter().filter(|c| !c.values.is_empty()) {
        let finest = column.decimals.iter().copied().max().unwrap_or(0);
        numbers.unsigned(u64::from(finest));
        let scaled = column.values.iter().zip(&column.decimals);
        numbers.column(&scaled.map(|(n, d)| n * 10i64.pow(u32::from(finest - d))).collect::<Vec<_>>());
    }
    streams.push(("kc-numbers", numbers.0));
}

struct Listing {
    /// All patterns, each with a line end before the next.
    patterns: Vec<u8>,
    known: HashMap<Vec<u8>, i64>,
    /// The pattern of each line.
    ids: Vec<i64>,
    columns: Vec<Column>,
    /// Pattern of the line being read.
    pattern: Vec<u8>,
    last: Vec<u8>,
}

#[derive(Clone, Default)]
struct Column {
    values: Vec<i64>,
    decimals: Vec<u8>,
}

impl Default for Listing {
    fn default() -> Listing {
        Listing {
            patterns: Vec::new(),
            known: HashMap::new(),
            ids: Vec::new(),
            columns: vec![Column::default(); COLUMNS],
            pattern: Vec::new(),
            last: Vec::new(),
        }
    }
}

impl Listing {
    fn line(&mut self, line: &[u8]) {
        self.pattern.clear();
        let (mut at, mut letter) = (0, 0);
        while let Some(&byte) = line.get(at) {
            if let Some(number) = Number::at(line, at) {
                let column = &mut self.columns[2 * letter + usize::from(number.mark != WHOLE)];
                column.values.push(number.value);
                column.decimals.push(number.mark.saturating_sub(DOTTED));
                self.pattern.push(number.mark);
                at = number.end;
                continue;
            }
            // The digits of a number that is too long stay where they are.
            let digits = digits(&line[at..]);
            if digits == 0 {
                letter = column_of(byte).unwrap_or(letter);
            }
            let end = at + digits.max(1);
            self.pattern.extend_from_slice(&line[at..end]);
            at = end;
        }
        self.end_line();
    }

    fn end_line(&mut self) {
        // Most lines are like the one before.
        if let Some(&id) = self.ids.last().filter(|_| self.pattern == self.last) {
            self.ids.push(id);
            return;
        }
        let next = self.known.len() as i64;
        let id = match self.known.entry(self.pattern.clone()) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                if next > 0 {
                    self.patterns.push(b'\n');
                }
                self.patterns.extend_from_slice(&self.pattern);
                *new.insert(next)
            }
        };
        self.ids.push(id);
        std::mem::swap(&mut self.last, &mut self.pattern);
    }
}

/// The pair of columns of a letter.
fn column_of(byte: u8) -> Option<usize> {
    match byte {
        b'A'..=b'Z' => Some(1 + usize::from(byte - b'A')),
        b'a'..=b'z' => Some(27 + usize::from(byte - b'a')),
        _ => None,
    }
}

fn digits(text: &[u8]) -> usize {
    text.iter().take_while(|b| b.is_ascii_digit()).count()
}

/// A number that its value and its mark give again.
struct Number {
    /// In steps of its last decimal.
    value: i64,
    mark: u8,
    end: usize,
}

impl Number {
    /// The number that begins at a place of a line: no more than a zero where a zero leads.
    fn at(line: &[u8], start: usize) -> Option<Number> {
        let negative = line[start] == b'-';
        let first = start + usize::from(negative);
        let whole = match line.get(first)? {
            b'0' => 1,
            _ => digits(&line[first..]),
        };
        let dot = first + whole;
        let is_dotted = whole > 0 && line.get(dot) == Some(&b'.');
        let decimals = if is_dotted { digits(&line[dot + 1..]) } else { 0 };
        let fits = if is_dotted { whole <= WHOLE_DIGITS && decimals <= DECIMALS } else { whole <= DIGITS };
        if whole == 0 || !fits {
            return None;
        }
        let end = dot + usize::from(is_dotted) + decimals;
        let all = line[first..end].iter().filter(|b| b.is_ascii_digit());
        let value = all.fold(0, |n, b| 10 * n + i64::from(b - b'0'));
        // Zero has no sign: the one of `-0` stays a letter of the line.
        if negative && value == 0 {
            return None;
        }
        let mark = if is_dotted { DOTTED + decimals as u8 } else { WHOLE };
        Some(Number { value: if negative { -value } else { value }, mark, end })
    }
}

#[cfg(test)]
mod tests {
    use super::super::numbers::tests::Reader;
    use super::*;
    use proptest::prelude::*;

    /// The lines again, by the description at the head of this file.
    fn read(streams: &Streams, count: usize) -> Vec<String> {
        let patterns = std::str::from_utf8(&streams[0].1).unwrap();
        let patterns: Vec<&str> = patterns.split('\n').collect();
        let mut numbers = Reader::of(streams[1].1.clone());
        let ids = numbers.column(count);
        let is_mark = |c: char| ('\u{e}'..='\u{17}').contains(&c);
        let key = |before: &str, mark: char| {
            let letter = before.rfind(|c: char| c.is_ascii_alphabetic()).map(|i| before.as_bytes()[i]);
            (letter.unwrap_or(0), mark != '\u{e}')
        };
        let mut counts = std::collections::BTreeMap::new();
        for id in &ids {
            let pattern = patterns[*id as usize];
            for (i, c) in pattern.char_indices().filter(|(_, c)| is_mark(*c)) {
                *counts.entry(key(&pattern[..i], c)).or_insert(0) += 1;
            }
        }
        let mut columns = std::collections::BTreeMap::new();
        for (key, count) in counts {
            let finest = numbers.unsigned();
            columns.insert(key, (finest, numbers.column(count).into_iter()));
        }
        assert!(numbers.is_done());
        let line = |id: i128| {
            let pattern = patterns[id as usize];
            let mut line = String::new();
            for (i, c) in pattern.char_indices() {
                if !is_mark(c) {
                    line.push(c);
                    continue;
                }
                let (finest, values) = columns.get_mut(&key(&pattern[..i], c)).unwrap();
                let n = values.next().unwrap();
                let decimals = (c as u32).saturating_sub(0xf) as usize;
                let n = n / 10i128.pow(*finest as u32 - decimals as u32);
                let digits = format!("{:0width$}", n.abs(), width = decimals + 1);
                let (whole, rest) = digits.split_at(digits.len() - decimals);
                line += if n < 0 { "-" } else { "" };
                line += whole;
                line += if c == '\u{e}' { "" } else { "." };
                line += rest;
            }
            line
        };
        ids.into_iter().map(line).collect()
    }

    fn packed(lines: &[&str]) -> Streams {
        let lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        let mut all = Streams::default();
        streams(&lines, &mut all);
        let back = read(&all, lines.len());
        let seen: Vec<_> = lines.iter().map(|line| visible(line).into_owned()).collect();
        assert_eq!(back, seen);
        all
    }

    #[test]
    fn each_letter_of_the_text_comes_back() {
        let streams = packed(&[
            "%",
            "N10 G0 X-0.86204 Y0.00000 Z5.",
            "N20 X-0. Y-0.000 Z+5.12 A.5 B-.5 C007 (12.345678901 of 1234567.5)",
            "",
            "Q1=-99999999999999 + Q2*999999.99999999 - 100000000000000",
            "L X+12.345 Y-3.2 R0 F MAX M3 ; 3--4..5.6.",
            "\u{b5}m\t\u{1b}[2J\u{e}\u{17} 1.5",
            "x0x00x1e-5",
        ]);
        let [(patterns, text), (numbers, _)] = &streams[..] else { panic!("two streams") };
        assert_eq!((*patterns, *numbers), ("kc-patterns", "kc-numbers"));
        assert!(text.windows(4).any(|w| w == b"N\x0e G"), "numbers are taken out");
        packed(&[]);
    }

    #[test]
    fn lines_alike_share_a_pattern_and_take_few_bytes() {
        // A wave along a line, as long as it takes for its numbers to matter alone.
        let line = |i: usize| {
            let x = i as f64 * 0.1;
            format!("X{x:.4} Z{:.4}", (x / 20.0).sin() * 5.0 - 7.0)
        };
        let lines: Vec<String> = (0..20_000).map(line).collect();
        let mut all = Streams::default();
        streams(&lines, &mut all);
        assert_eq!(read(&all, lines.len()), lines);
        let bytes: usize = all.iter().map(|(_, bytes)| super::super::numbers::packed(bytes).len()).sum();
        assert!(bytes < 2 * lines.len(), "{} bytes a line", bytes as f64 / lines.len() as f64);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn any_text_comes_back(lines in prop::collection::vec("[-+0-9.XY a\u{e}\t\u{e4}]{0,40}", 0..12)) {
            packed(&lines.iter().map(String::as_str).collect::<Vec<_>>());
        }
    }
}
