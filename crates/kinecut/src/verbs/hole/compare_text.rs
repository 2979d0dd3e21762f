//! A comparison and a planned hole as text for a terminal of a hundred columns.

use std::fmt::Write as _;

use super::compare::{number, step};
use super::{HoleComparison, HolePlan};
use crate::holes::compare::Holds;
use crate::page::{duration, fixed, length, terminal};

/// Columns of a claim's words.
const WIDTH: usize = 96;

/// The table of a comparison and the paper's claims.
pub(super) fn compare_text(hole: &HoleComparison) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail, here and below.
    let _ = put(&mut out, hole);
    out
}

fn put(out: &mut String, hole: &HoleComparison) -> std::fmt::Result {
    let c = &hole.comparison;
    let t = &c.terms;
    writeln!(out, "{}", terminal(&hole.title))?;
    let start =
        if t.entry > 0.0 { format!("circle R {}", number(Some(t.entry))) } else { "centre".to_owned() };
    writeln!(
        out,
        "bore D{} depth {}, cutter D{}, wall path R {}, step {}, from the {start}, {} m/min\n",
        hole.diameter,
        hole.depth,
        2.0 * t.cutter,
        number(Some(t.wall)),
        t.step,
        number(Some(t.limits.feed * 0.06))
    )?;
    let heads = ["strategy", "length", "blocks", "wall", "worst", "da", "dj", "load", "time"];
    line(out, heads.map(str::to_owned))?;
    line(out, ["", "mm", "", "", "", "mm/s2", "mm/s3", "deg", "s"].map(str::to_owned))?;
    for row in &c.rows {
        let Some(f) = &row.figures else {
            let why = row.error.as_ref().map_or("not possible", |e| e.message.as_str());
            writeln!(out, "{:<24}  not here: {}", row.strategy, clip(&terminal(why), WIDTH - 36))?;
            continue;
        };
        line(
            out,
            [
                row.strategy.to_owned(),
                fixed(f.length, 2),
                f.blocks.to_string(),
                f.closing.contact.to_owned(),
                f.worst.map_or("-".to_owned(), |j| j.contact.to_owned()),
                step(f.closing.steps.acceleration),
                step(f.closing.steps.jerk),
                fixed(f.load.most.to_degrees(), 1),
                f.times.first().map_or("-".to_owned(), |t| fixed(t.time, 2)),
            ],
        )?;
    }
    writeln!(
        out,
        "\nwall, worst: contact there and in the worst joint; da, dj: steps of acceleration, jerk at the wall;"
    )?;
    writeln!(out, "load: largest engagement; length, time: circles at entry and wall included")?;
    writeln!(out, "\nThe paper's claims on this hole")?;
    for claim in &c.claims {
        let holds = match claim.holds {
            Holds::Yes => "holds",
            Holds::Partly => "in part",
            Holds::No => "does not hold",
        };
        writeln!(out, "- {}: {holds}.", claim.claim)?;
        wrapped(out, &claim.found, "  ")?;
    }
    Ok(())
}

fn clip(text: &str, most: usize) -> String {
    text.chars().take(most).collect()
}

fn line(out: &mut String, cells: [String; 9]) -> std::fmt::Result {
    const WIDTHS: [usize; 9] = [24, 9, 7, 6, 6, 8, 8, 7, 9];
    for (i, (cell, width)) in cells.iter().zip(WIDTHS).enumerate() {
        let pad = " ".repeat(width.saturating_sub(cell.chars().count()));
        if i == 0 { write!(out, "{cell}{pad}")? } else { write!(out, " {pad}{cell}")? }
    }
    out.truncate(out.trim_end_matches(' ').len());
    out.push('\n');
    Ok(())
}

fn wrapped(out: &mut String, text: &str, indent: &str) -> std::fmt::Result {
    let mut at = 0;
    for word in text.split_whitespace() {
        let n = word.chars().count();
        if at > 0 && at + 1 + n > WIDTH {
            out.push('\n');
            at = 0;
        }
        if at == 0 {
            write!(out, "{indent}")?
        } else {
            out.push(' ')
        }
        out.push_str(word);
        at += n + 1;
    }
    out.push('\n');
    Ok(())
}

/// A planned hole in a few lines.
pub(super) fn hole_text(plan: &HolePlan) -> String {
    let mut out = format!("{}\n", terminal(&plan.title));
    for e in &plan.entries {
        let sign = if e.chosen { "->" } else { "  " };
        let possible = if e.possible { "possible" } else { "not possible" };
        let _ = writeln!(out, "{sign} {:<22} {possible:<13} {}", e.way, terminal(&e.reason));
    }
    for p in &plan.passes {
        let floors = p.floors.iter().map(|f| number(Some(*f))).collect::<Vec<_>>().join(", ");
        let _ = writeln!(
            out,
            "   {:<7} wall path R {}, {} turns, step {} mm, {} a level, floors at {floors}",
            p.pass,
            number(Some(p.path_radius)),
            number(Some(p.turns)),
            number(Some(p.step)),
            length(p.length)
        );
    }
    let _ = writeln!(
        out,
        "   {} at feed, {} of it down into the material; {} without rapids; {} lines for {}",
        length(plan.feed_length + plan.entry_length),
        length(plan.entry_length),
        duration(plan.feed_time),
        plan.program_lines,
        plan.control
    );
    out
}
