//! The sheet of a grazing curve for a terminal.

use std::fmt::Write as _;

use super::tables::{MINUTE, degenerate, entering, loops, motion_lines, spans};
use crate::page::{Align, Table, area_share, fixed, terminal};
use crate::verbs::grazing::GrazingSheet;

/// The sheet as text.
pub fn grazing_text(sheet: &GrazingSheet) -> String {
    let mut out = String::new();
    let title = if sheet.title.is_empty() { "Grazing curve" } else { &sheet.title };
    // Writing to a String cannot fail.
    let _ = writeln!(out, "{}", terminal(title));
    let _ = writeln!(out, "  motion   {}", sheet.motion_words());
    for line in motion_lines(sheet) {
        let _ = writeln!(out, "           {}", terminal(&line));
    }
    for line in &sheet.notes {
        let _ = writeln!(out, "  tool     {}", terminal(line));
    }
    for line in degenerate(sheet) {
        let _ = writeln!(out, "  note     {line}");
    }
    if !sheet.loops.is_empty() {
        out.push('\n');
        out += &table(&loops(sheet));
        out.push('\n');
        out += &table(&spans(sheet));
    }
    out.push('\n');
    out += &table(&entering(sheet));
    let [area, enters] = sheet.areas();
    let [gained, lost] = sheet.rates();
    let share = if area > 0.0 { enters / area } else { 0.0 };
    let _ = writeln!(
        out,
        "  in all: {} of {} mm2 enter ({}), {} mm3/min entered, {} left",
        fixed(enters, 3),
        fixed(area, 3),
        area_share(share),
        fixed(gained * MINUTE, 2),
        fixed(lost * MINUTE, 2)
    );
    out
}

/// A table with columns as wide as their cells.
pub(crate) fn table(table: &Table) -> String {
    let head = |c: &crate::page::Column| {
        if c.unit.is_empty() { c.title.clone() } else { format!("{} {}", c.title, c.unit) }
    };
    let mut rows: Vec<Vec<String>> = vec![table.columns.iter().map(head).collect()];
    for row in &table.rows {
        rows.push(row.cells.iter().map(|c| terminal(&c.text).into_owned()).collect());
    }
    let width = |k: usize| rows.iter().filter_map(|r| r.get(k)).map(|t| t.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..table.columns.len()).map(width).collect();
    let mut out = format!("  {}\n", table.caption);
    for row in &rows {
        let mut line = String::from("   ");
        for ((text, column), width) in row.iter().zip(&table.columns).zip(&widths) {
            line.push(' ');
            line.push(' ');
            let room = " ".repeat(width - text.chars().count());
            match column.align {
                Align::Left => line += &format!("{text}{room}"),
                Align::Right => line += &format!("{room}{text}"),
            }
        }
        out += line.trim_end();
        out.push('\n');
    }
    for note in &table.notes {
        out += &format!("    {note}\n");
    }
    out
}
