//! Sections as plain text for a terminal: facts and sentences as lines, tables as columns. Pictures are left out.

use super::{Align, Block, Cell, Column, Fact, Row, Section, Table, terminal};

/// Columns of the terminal that texts are made for.
pub const WIDTH: usize = 100;
/// Least width to which a column of words is narrowed: less cannot be read.
const NARROW: usize = 24;
/// Blanks between columns.
const GAP: usize = 2;

/// Sections as text of lines up to `width` columns, where words and numbers are not longer by themselves. Control characters
/// in text from outside are spelled out.
///
/// ```
/// use kinecut::page::{Block, Fact, Section, text};
/// let section = Section::new("Bore").with(Block::Facts(vec![Fact::new("Time", "3 s").note("at feed")]));
/// assert_eq!(text(&[section], 100), "Bore\n  Time  3 s (at feed)\n");
/// ```
pub fn text(sections: &[Section], width: usize) -> String {
    let mut out = String::new();
    for section in sections {
        if !out.is_empty() {
            out.push('\n');
        }
        wrapped(&mut out, &section.title, width, ["", ""]);
        section.blocks.iter().for_each(|block| put(&mut out, block, width));
    }
    out
}

fn put(out: &mut String, block: &Block, width: usize) {
    match block {
        Block::Heading(title) => {
            out.push('\n');
            wrapped(out, title, width, ["", ""]);
        }
        Block::Text(text) => wrapped(out, text, width, ["  ", "  "]),
        Block::Facts(facts) => lines(out, facts, width),
        Block::List(items) => items.iter().for_each(|item| wrapped(out, item, width, ["  - ", "    "])),
        Block::Table(table) => {
            if !out.is_empty() {
                out.push('\n');
            }
            columns(out, table, width);
        }
        Block::Chart(_) | Block::Plan(_) | Block::Drawing(_) | Block::Picture(_) => {}
    }
}

/// A text from outside in lines, the first and the others behind their prefixes.
fn wrapped(out: &mut String, text: &str, width: usize, [first, other]: [&str; 2]) {
    let text = terminal(text);
    for (i, line) in broken(&text, width.saturating_sub(other.chars().count())).iter().enumerate() {
        out.push_str(if i == 0 { first } else { other });
        out.push_str(line);
        out.push('\n');
    }
}

/// A text as lines of whole words; a word that is too long has a line of its own.
fn broken(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut long = 0;
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        let letters = word.chars().count();
        match lines.last_mut() {
            Some(line) if long + 1 + letters <= width => {
                line.push(' ');
                line.push_str(word);
                long += 1 + letters;
            }
            _ => {
                lines.push(word.to_owned());
                long = letters;
            }
        }
    }
    lines
}

/// Facts in two columns.
fn lines(out: &mut String, facts: &[Fact], width: usize) {
    let names: Vec<String> = facts.iter().map(|f| terminal(&f.label).into_owned()).collect();
    let room = names.iter().map(|n| n.chars().count()).max().unwrap_or(0) + GAP;
    for (fact, name) in facts.iter().zip(&names) {
        let note = if fact.note.is_empty() { String::new() } else { format!(" ({})", fact.note) };
        wrapped(
            out,
            &format!("{}{note}", fact.value),
            width,
            [&format!("  {}", padded(name, room, Align::Left)), &" ".repeat(room + 2)],
        );
    }
}

fn padded(text: &str, room: usize, align: Align) -> String {
    let blank = " ".repeat(room.saturating_sub(text.chars().count()));
    match align {
        Align::Left => format!("{text}{blank}"),
        Align::Right => format!("{blank}{text}"),
    }
}

/// A column as it is set: index, head, cells, width.
struct Set<'a> {
    head: &'a Column,
    cells: Vec<String>,
    width: usize,
}

impl Set<'_> {
    /// The column of this index; none where all its cells are empty.
    fn of<'a>(index: usize, head: &'a Column, rows: &[Row]) -> Option<Set<'a>> {
        let cells: Vec<String> =
            rows.iter().map(|row| row.cells.get(index).map_or_else(String::new, shown)).collect();
        if cells.iter().all(String::is_empty) {
            return None;
        }
        let words = head.title.split(' ').chain([head.unit.as_str()]);
        let width =
            words.chain(cells.iter().map(String::as_str)).map(|w| w.chars().count()).max().unwrap_or(0);
        Some(Set { head, cells, width })
    }
}

/// A cell, with the text printed before it was corrected next to it.
fn shown(cell: &Cell) -> String {
    let text = terminal(&cell.text).replace('\u{a0}', " ");
    match &cell.printed {
        Some(printed) => format!("{text} (printed: {})", terminal(printed)),
        None => text,
    }
}

/// A table: columns as wide as their cells; where they have no room together, columns of words are broken into lines, and
/// where that does not suffice each row is a block of its own.
fn columns(out: &mut String, table: &Table, width: usize) {
    const INDENT: usize = 2;
    wrapped(out, &table.caption, width, ["  ", "  "]);
    let mut sets: Vec<Set<'_>> =
        table.columns.iter().enumerate().filter_map(|(i, head)| Set::of(i, head, &table.rows)).collect();
    let total = |sets: &[Set<'_>]| sets.iter().map(|s| s.width + GAP).sum::<usize>() + INDENT;
    let mut wordy = false;
    while total(&sets) > width {
        let over = total(&sets) - width;
        let wide = sets.iter_mut().filter(|s| s.head.align == Align::Left && s.width > NARROW);
        let Some(widest) = wide.max_by_key(|s| s.width) else { break };
        // A step at a time, so that columns of one width stay alike.
        widest.width -= over.min(4).min(widest.width - NARROW);
        wordy = true;
    }
    if wordy && total(&sets) > width {
        (0..table.rows.len()).for_each(|row| record(out, &sets, row, width));
    } else {
        stacked(out, &sets, table.rows.len(), width, INDENT);
    }
    table.notes.iter().for_each(|note| wrapped(out, note, width, ["  ", "  "]));
}

/// A row as lines, each a column's name and its cell, below the first cell.
fn record(out: &mut String, sets: &[Set<'_>], row: usize, width: usize) {
    let Some((first, rest)) = sets.split_first() else { return };
    out.push('\n');
    wrapped(out, &first.cells[row], width, ["  ", "  "]);
    let name = |s: &Set<'_>| format!("{} {}", s.head.title, s.head.unit).trim_end().to_owned();
    let room = rest.iter().map(|s| name(s).chars().count()).max().unwrap_or(0) + GAP;
    for set in rest {
        let head = format!("    {}", padded(&name(set), room, Align::Left));
        wrapped(out, &set.cells[row], width, [&head, &" ".repeat(4 + room)]);
    }
}

fn stacked(out: &mut String, sets: &[Set<'_>], rows: usize, width: usize, indent: usize) {
    // Columns without room next to the first one come below, behind the first column again.
    let mut from = 0;
    while from < sets.len() {
        let first = if from == 0 { 0 } else { sets[0].width + GAP };
        let mut room = width.saturating_sub(indent + first);
        let fits = sets[from..].iter().take_while(|s| {
            let has_room = s.width + GAP <= room;
            room = room.saturating_sub(s.width + GAP);
            has_room
        });
        // The first column is never repeated alone.
        let to = from + fits.count().max(if from == 0 { 2 } else { 1 });
        let to = to.min(sets.len());
        let part: Vec<&Set<'_>> = sets[..1].iter().filter(|_| from > 0).chain(&sets[from..to]).collect();
        block(out, &part, rows, indent);
        from = to;
    }
}

/// Columns next to each other: heads, at the bottom of their line, and the rows.
fn block(out: &mut String, sets: &[&Set<'_>], rows: usize, indent: usize) {
    let mut put = |cells: Vec<Vec<String>>| {
        for i in 0..cells.iter().map(Vec::len).max().unwrap_or(0) {
            let mut line = " ".repeat(indent);
            for (set, cell) in sets.iter().zip(&cells) {
                line += &" ".repeat(GAP);
                line += &padded(cell.get(i).map_or("", String::as_str), set.width, set.head.align);
            }
            out.push_str(line.trim_end());
            out.push('\n');
        }
    };
    let heads = sets.iter().map(|s| {
        let mut lines = broken(&s.head.title, s.width);
        lines.extend((!s.head.unit.is_empty()).then(|| s.head.unit.clone()));
        lines
    });
    let heads: Vec<Vec<String>> = heads.collect();
    let high = heads.iter().map(Vec::len).max().unwrap_or(0);
    let lift = |lines: Vec<String>| [vec![String::new(); high - lines.len()], lines].concat();
    put(heads.into_iter().map(lift).collect());
    for row in 0..rows {
        put(sets.iter().map(|s| broken(&s.cells[row], s.width)).collect());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        Table {
            caption: "Ways".to_owned(),
            columns: vec![
                Column::number("Bad length", "mm"),
                Column::text("Way"),
                Column::text("Nothing"),
                Column::number("Time", "s"),
            ],
            rows: vec![
                Row::new(vec!["117.690".into(), "one pass, turned".into(), "".into(), "9.1".into()]),
                Row::new(vec!["0.000".into(), "three rows, to and fro".into(), "".into(), "12.0".into()]),
            ],
            notes: vec!["Without tool change.".to_owned()],
        }
    }

    #[test]
    fn a_table_has_columns_as_wide_as_its_cells_and_none_that_is_empty() {
        let section = Section::new("Cover").with(table());
        let want = "Cover\n\n  Ways\n        Bad\n     length                          Time\n         mm  Way                        s\n    \
                    117.690  one pass, turned         9.1\n      0.000  three rows, to and fro  12.0\n  Without tool change.\n";
        assert_eq!(text(&[section], 100), want);
    }

    #[test]
    fn words_are_broken_where_the_width_does_not_suffice() {
        let section = Section::new("Cover").with(table()).with(Block::List(vec!["one two three ".repeat(9)]));
        let narrow = text(std::slice::from_ref(&section), 46);
        assert!(narrow.lines().all(|line| line.chars().count() <= 46), "{narrow}");
        let words = |text: &str| {
            let mut words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
            words.sort();
            words
        };
        assert_eq!(words(&narrow), words(&text(&[section], 100)));
    }

    #[test]
    fn text_from_outside_steers_no_terminal() {
        let fact = Fact::new("a\u{1b}[2J", "b\u{9b}").note("c\u{202e}");
        let shown = text(&[Section::new("d\r").with(Block::Facts(vec![fact]))], 100);
        assert!(shown.chars().all(|c| c == '\n' || !(c.is_control() || c == '\u{202e}')), "{shown:?}");
    }
}
