//! Pages and messages in inches: every number that has a unit of length, and coordinates, in place of millimetres.
//!
//! Numbers without a unit stay, and so do micrometres.

use super::{Block, Column, Fact, Section, Table, trimmed};

/// A unit of texts.
#[derive(Debug)]
struct Unit {
    metric: &'static str,
    inch: &'static str,
    /// One of the second in the first.
    size: f64,
    /// Decimals in inches beyond those of the metric number, and the least number of them.
    more: usize,
    least: usize,
}

const fn unit(metric: &'static str, inch: &'static str, size: f64, more: usize, least: usize) -> Unit {
    Unit { metric, inch, size, more, least }
}

/// Millimetres.
const MM: Unit = unit("mm", "in", 25.4, 2, 3);
/// All units: with so many decimals that the rounding is a small part of the last metric one.
static UNITS: [Unit; 12] = [
    MM,
    unit("mm/min", "in/min", 25.4, 1, 1),
    unit("mm/tooth", "in/tooth", 25.4, 2, 4),
    unit("mm/rev", "in/rev", 25.4, 2, 4),
    unit("mm2", "in2", 645.16, 3, 3),
    unit("mm\u{b2}", "in\u{b2}", 645.16, 3, 3),
    unit("mm3", "in3", 16_387.064, 4, 4),
    unit("mm\u{b3}", "in\u{b3}", 16_387.064, 4, 4),
    unit("cm\u{b3}/min", "in\u{b3}/min", 16.387_064, 2, 2),
    unit("cm\u{b3}", "in\u{b3}", 16.387_064, 2, 2),
    unit("m/min", "ft/min", 0.3048, 0, 0),
    unit("m", "ft", 0.3048, 0, 1),
];

/// The unit that a text begins with.
fn unit_at(text: &str) -> Option<&'static Unit> {
    let ends = |rest: &str| {
        !rest.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '/' | '\u{b2}' | '\u{b3}'))
    };
    UNITS.iter().find(|unit| text.strip_prefix(unit.metric).is_some_and(ends))
}

/// A number in a unit, as it was shown, in that of inches: with the digits that it had, and never a zero for what is none.
fn converted(shown: &str, unit: &Unit) -> Option<String> {
    let value = shown.parse::<f64>().ok()? / unit.size;
    if shown.contains('e') {
        return Some(format!("{value:.1e}"));
    }
    let decimals = shown.split_once('.').map_or(0, |(_, part)| part.len());
    let mut decimals = (decimals + unit.more).max(unit.least);
    while decimals < 12 && value != 0.0 && (value.abs() * 10f64.powi(decimals as i32)) < 0.5 {
        decimals += 1;
    }
    Some(trimmed(value, decimals))
}

/// A number in a text.
#[derive(Clone, Copy, Debug)]
struct Number {
    start: usize,
    end: usize,
    /// The letter of an axis just before it: `X12.7`.
    axis: Option<char>,
}

/// The numbers of a text: not those within words, names and codes.
fn numbers(text: &str) -> Vec<Number> {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let before = |at: usize| text[..at].chars().next_back();
    let is_word =
        |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '#' | '`'));
    let mut all = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        if !digit(at) {
            at += 1;
            continue;
        }
        let mut end = at;
        while digit(end) || bytes.get(end) == Some(&b'.') && digit(end + 1) {
            end += 1;
        }
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'-' | b'+')));
        if bytes.get(end) == Some(&b'e') && digit(end + 1 + sign) {
            end += 1 + sign;
            while digit(end) {
                end += 1;
            }
        }
        let mut start = at;
        let signed =
            |c: Option<char>| !c.is_some_and(char::is_alphanumeric) || matches!(c, Some('X' | 'Y' | 'Z'));
        if before(start) == Some('-') && signed(before(start - 1)) {
            start -= 1;
        }
        let letter = before(start).filter(|c| matches!(c, 'X' | 'Y' | 'Z') && !is_word(before(start - 1)));
        // A diameter: `D6.5 hole`.
        let is_diameter =
            before(start) == Some('D') && !is_word(before(start - 1)) && text[end..].starts_with(" hole");
        let joined = text[end..].starts_with(|c: char| c.is_alphanumeric() && c != 'm' || c == '_');
        if (letter.is_some() || is_diameter || !is_word(before(start))) && !joined {
            all.push(Number { start, end, axis: letter.or(is_diameter.then_some('D')) });
        }
        at = end;
    }
    all
}

/// Words between two numbers of one unit.
const JOINS: &[&str] =
    &[" x ", " \u{d7} ", "\u{d7}", " to ", " mm to ", "..", " \u{2013} ", "\u{2013}", " and at most "];

/// A text with its lengths in inches. `key` is the factor of a key's number, of `stepdown = 2`, in the same way as [`UNITS`]
/// have their size, where it is known.
pub(crate) fn in_inches(text: &str, key: &dyn Fn(&str) -> Option<f64>) -> String {
    let numbers = numbers(text);
    let mut units: Vec<Option<&Unit>> = vec![None; numbers.len()];
    for i in (0..numbers.len()).rev() {
        let rest = &text[numbers[i].end..];
        let next = || numbers.get(i + 1).map(|next| &text[numbers[i].end..next.start]);
        units[i] = unit_at(rest.trim_start_matches([' ', '\u{a0}', '\u{202f}']))
            .or_else(|| next().filter(|gap| JOINS.contains(gap)).and_then(|_| units[i + 1]));
    }
    // A length and, in brackets, that of which it is a share: `0.15 mm (0.3 x 0.5)`.
    for i in 1..numbers.len() {
        let gap = &text[numbers[i - 1].end..numbers[i].start];
        let of = units[i - 1].filter(|unit| gap.trim_start() == format!("{} (", unit.metric));
        if text[numbers[i].end..].starts_with(" x ") && units[i].is_none() {
            units[i] = of;
        }
    }
    coordinates(text, &numbers, &mut units);
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    for (i, (number, unit)) in numbers.iter().zip(&units).enumerate() {
        if number.start < done {
            continue;
        }
        out.push_str(&text[done..number.start]);
        done = number.start;
        let shown = &text[number.start..number.end];
        let of_key = || key_before(text, number.start).and_then(key).map(|mm| (shown, mm));
        if let Some((shown, mm)) = of_key() {
            let value = shown.parse::<f64>().unwrap_or(f64::NAN) / mm;
            out.push_str(&trimmed(value, 5));
            done = number.end;
            // Its unit may follow in words.
            let rest = &text[done..];
            for (of, to) in [(" (mm)", " (in)"), (" (mm/min)", " (in/min)"), (" (m/min)", " (ft/min)")] {
                if rest.starts_with(of) {
                    out.push_str(to);
                    done += of.len();
                }
            }
            continue;
        }
        let Some(unit) = unit else { continue };
        let Some(value) = converted(shown, unit) else { continue };
        out.push_str(&value);
        done = number.end;
        // The unit itself, where it is written behind this one.
        let rest = &text[done..];
        let blank = rest.len() - rest.trim_start_matches([' ', '\u{a0}', '\u{202f}']).len();
        let own =
            unit_at(&rest[blank..]).filter(|_| numbers.get(i + 1).is_none_or(|n| n.start >= done + blank));
        if let Some(own) = own {
            out.push_str(&rest[..blank]);
            out.push_str(own.inch);
            done += blank + own.metric.len();
        }
    }
    out.push_str(&text[done..]);
    out
}

/// Marks the numbers that are coordinates: two or three in brackets, or behind the letter of an axis. `X1 Y2` of a block of a
/// program is in the program's own unit.
fn coordinates(text: &str, numbers: &[Number], units: &mut [Option<&Unit>]) {
    let in_code = |at: usize| text[..at].matches('`').count() % 2 == 1;
    let behind_word = |at: usize| {
        let word = text[..at].trim_end().rsplit(' ').next().unwrap_or_default();
        word.strip_prefix(['G', 'N', 'M', 'F', 'S'])
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    let mut block = false;
    for i in 0..numbers.len() {
        let (at, before) = (numbers[i].start, &text[..numbers[i].start]);
        let axis = ["X ", "Y ", "Z ", "X = ", "Y = ", "Z = "].iter().any(|axis| {
            before.strip_suffix(axis).is_some_and(|rest| !rest.ends_with(|c: char| c.is_alphanumeric()))
        });
        if axis && units[i].is_none() {
            units[i] = Some(&MM);
        }
        if let Some(letter) = numbers[i].axis {
            // The second and third of a place follow the first.
            let goes_on = i > 0
                && numbers[i - 1].axis.is_some()
                && text[numbers[i - 1].end..at].trim() == letter.to_string();
            block = if goes_on { block } else { in_code(at) || behind_word(at - 1) };
            if !block && units[i].is_none() {
                units[i] = Some(&MM);
            }
        }
        for (open, close) in [('(', ')'), ('[', ']')] {
            if !before.ends_with(open) || key_before(text, at).is_some() {
                continue;
            }
            let mut last = i;
            while numbers.get(last + 1).is_some_and(|next| &text[numbers[last].end..next.start] == ", ") {
                last += 1;
            }
            let count = last - i + 1;
            if (2..=3).contains(&count) && text[numbers[last].end..].starts_with(close) {
                units[i..=last].iter_mut().for_each(|unit| *unit = Some(unit.unwrap_or(&MM)));
            }
        }
    }
}

/// The key to which a number belongs: `key = 5`, `key = [5, 6]`.
fn key_before(text: &str, start: usize) -> Option<&str> {
    let before = &text[..start];
    let list = before.rfind('[').filter(|at| {
        before[at + 1..].chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | ',' | ' ' | '-' | '['))
    });
    let before = list.map_or(before, |at| before[..at].trim_end_matches('['));
    let before = before.strip_suffix(" = ")?;
    let from = before
        .rfind(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
    (from < before.len()).then(|| &before[from..])
}

/// A name that an operation gives itself, such as `pocket 38.1 x 25.4 x 6.35`, of which all numbers but counts are lengths.
pub(crate) fn name(name: &str) -> String {
    const COUNTED: &[&str] = &[" hole", " place", " point", " time"];
    let mut out = String::with_capacity(name.len());
    let mut rest = name;
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let end = rest[at..].find(|c: char| !(c.is_ascii_digit() || c == '.')).map_or(rest.len(), |n| at + n);
        let (before, number, behind) = (&rest[..at], &rest[at..end], &rest[end..]);
        let before_sign = before.strip_suffix('-').unwrap_or(before);
        // A thread is a word: `M8x1.25`.
        let within = before_sign.ends_with(|c: char| c.is_alphanumeric() && !matches!(c, 'X' | 'Y'));
        let counted = COUNTED.iter().any(|word| behind.starts_with(word));
        out.push_str(before);
        match number.parse::<f64>() {
            Ok(mm) if !within && !counted => out.push_str(&trimmed(mm / 25.4, 3)),
            _ => out.push_str(number),
        }
        rest = behind;
    }
    out.push_str(rest);
    out
}

/// A text turned into inches.
pub(crate) type Turn<'a> = &'a dyn Fn(&mut String);

/// A text without keys.
pub(crate) fn words(text: &mut String) {
    *text = in_inches(text, &|_| None);
}

/// A fact.
pub(crate) fn fact(fact: &mut Fact, turn: Turn<'_>) {
    [&mut fact.label, &mut fact.value, &mut fact.note].into_iter().for_each(turn);
}

/// A table: the columns in units of length too.
pub(crate) fn table(table: &mut Table, turn: Turn<'_>) {
    turn(&mut table.caption);
    table.notes.iter_mut().for_each(turn);
    // A unit may stand within the words of a column, `Chip [mm] (teeth)`, and coordinates have none.
    let in_title = |title: &str| match title.contains("X, Y") {
        true => Some(&MM),
        false => title.split_once('[').and_then(|(_, rest)| unit_at(rest)),
    };
    let of = |column: &Column| unit_at(&column.unit).or_else(|| in_title(&column.title));
    let units: Vec<Option<&Unit>> = table.columns.iter().map(of).collect();
    for (column, unit) in table.columns.iter_mut().zip(&units) {
        turn(&mut column.title);
        if let Some(unit) = unit {
            column.unit = column.unit.replacen(unit.metric, unit.inch, 1);
            column.title =
                column.title.replacen(&format!("[{}]", unit.metric), &format!("[{}]", unit.inch), 1);
        }
    }
    for row in &mut table.rows {
        for (i, cell) in row.cells.iter_mut().enumerate() {
            let unit = units.get(i).copied().flatten();
            for text in std::iter::once(&mut cell.text).chain(&mut cell.printed) {
                match unit {
                    Some(unit) => *text = in_column(text, unit),
                    None => turn(text),
                }
            }
        }
    }
}

/// A cell of a column with a unit: all its numbers are in it.
fn in_column(text: &str, unit: &Unit) -> String {
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    for number in numbers(text) {
        // Teeth in brackets are a count.
        let counted = text[..number.start].ends_with('(');
        if let Some(value) = converted(&text[number.start..number.end], unit).filter(|_| !counted) {
            out.push_str(&text[done..number.start]);
            out.push_str(&value);
            done = number.end;
        }
    }
    out.push_str(&text[done..]);
    out
}

/// A section. Charts, plans, drawings and pictures stay in millimetres.
pub(crate) fn section(section: &mut Section, turn: Turn<'_>) {
    turn(&mut section.title);
    for block in &mut section.blocks {
        match block {
            Block::Heading(text) | Block::Text(text) => turn(text),
            Block::Facts(facts) => facts.iter_mut().for_each(|of| fact(of, turn)),
            Block::List(list) => list.iter_mut().for_each(turn),
            Block::Table(of) => table(of, turn),
            Block::Chart(_) | Block::Plan(_) | Block::Drawing(_) | Block::Picture(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Row;

    fn shown(text: &str) -> String {
        let key = |key: &str| match key {
            "stepdown" | "size" | "feed" => Some(25.4),
            "cutting_speed" => Some(0.3048),
            _ => None,
        };
        in_inches(text, &key)
    }

    #[test]
    fn lengths_have_inches_and_all_else_stays() {
        for (text, inches) in [
            ("12.7 mm deep", "0.5 in deep"),
            ("a hole of 5 mm, 3 times", "a hole of 0.197 in, 3 times"),
            ("0.001 mm", "0.00004 in"),
            ("0 mm", "0 in"),
            ("-2.54 mm", "-0.1 in"),
            ("0.254 mm (0.508 x 0.5 (edge))", "0.01 in (0.02 x 0.5 (edge))"),
            ("1436.7 mm at feed, 30.48 m", "56.563 in at feed, 100 ft"),
            ("\u{b1}0.254 mm", "\u{b1}0.01 in"),
            ("508 mm/min", "20 in/min"),
            ("120 m/min", "394 ft/min"),
            ("16.387 cm\u{b3}", "1 in\u{b3}"),
            ("50.8 x 25.4 mm", "2 x 1 in"),
            ("from 25.4 to 50.8 mm", "from 1 to 2 in"),
            ("at (25.4, -50.8)", "at (1, -2)"),
            ("at X 25.4 Y -12.7, Z 0", "at X 1 Y -0.5, Z 0"),
            ("45 degrees, 12 \u{b5}m, S 5000, T3, N340", "45 degrees, 12 \u{b5}m, S 5000, T3, N340"),
            ("M8 x 1.25", "M8 x 1.25"),
            ("2 holes, 4 places (12 of 30)", "2 holes, 4 places (12 of 30)"),
            ("1680 N/mm\u{b2}", "1680 N/mm\u{b2}"),
            ("write stepdown = 2.54", "write stepdown = 0.1"),
            ("give size = [50.8, 25.4] or teeth = 4", "give size = [2, 1] or teeth = 4"),
            ("give feed = 600 (mm/min)", "give feed = 23.62205 (in/min)"),
            ("cutting_speed = 100 (m/min)", "cutting_speed = 328.08399 (ft/min)"),
            ("M12.5 stays, 3mm does not", "M12.5 stays, 0.118in does not"),
            ("part_2.stl: 10.5 mm", "part_2.stl: 0.413 in"),
            ("gap 2.54e-3 mm", "gap 1.0e-4 in"),
            ("at most 0.034 mm", "at most 0.00134 in"),
            ("hole 1 at X-50.8 Y25.4: 2 lines", "hole 1 at X-2 Y1: 2 lines"),
            ("X25.4 Y0", "X1 Y0"),
            ("D12.7 hole 2 at X0 Y-25.4", "D0.5 hole 2 at X0 Y-1"),
            ("line 5: G1 X25.4 Y2", "line 5: G1 X25.4 Y2"),
            ("write `X25.4 Y2`", "write `X25.4 Y2`"),
            ("D2 of T5, X12", "D2 of T5, X0.472"),
        ] {
            assert_eq!(shown(text), inches, "{text}");
        }
    }

    #[test]
    fn names_of_operations_have_inches() {
        for (mm, inch) in [
            ("pocket 38.1 x 25.4 x 6.35", "pocket 1.5 x 1 x 0.25"),
            ("drilling 6.5278, 2 holes", "drilling 0.257, 2 holes"),
            ("drilling 6.35 at X-12.7 Y25.4", "drilling 0.25 at X-0.5 Y1"),
            ("tap M8x1.25, 4 holes", "tap M8x1.25, 4 holes"),
            ("path of 12 points", "path of 12 points"),
        ] {
            assert_eq!(name(mm), inch);
        }
    }

    #[test]
    fn columns_have_their_unit() {
        let mut of = Table::new("Depth 5.08 mm", "Name; Depth [mm]; Chip [mm] (teeth); Arc [\u{b0}]")
            .rows([Row::new(vec!["5 mm".into(), "25.40".into(), "0.05 (4)".into(), "60".into()])]);
        table(&mut of, &words);
        let units: Vec<&str> = of.columns.iter().map(|c| c.unit.as_str()).collect();
        assert_eq!(of.caption, "Depth 0.2 in");
        assert_eq!(units[1], "in");
        let cells: Vec<&str> = of.rows[0].cells.iter().map(|c| c.text.as_str()).collect();
        assert_eq!([cells[0], cells[1], cells[3]], ["0.197 in", "1", "60"]);
    }
}
