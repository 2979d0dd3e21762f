//! A face as text for a terminal of a hundred columns.

use super::MilledFace;
use super::crossings::crossing_lines;
use super::edges::bad_edges;
use super::tables::{
    before_after, certificate_words, cutter_words, descents_words, irreducible, outline_words,
    placement_words, rule_words, sensitivity_words, toothed, toothed_words, trimmed, turn, weight_words,
};
use crate::page::{area_share, fixed, terminal};

/// Columns of a sentence.
const WIDTH: usize = 98;
/// Rows of a list before the rest is only counted.
const MOST: usize = 12;

/// The face as text, with what the paper's program does where it is known. The crossings of the teeth come last.
pub(crate) fn face_words(face: &MilledFace<'_>) -> String {
    let mut out = String::new();
    put(&mut out, &terminal(face.title));
    head(&mut out, "rule", &rule_words(face));
    head(&mut out, "outline", &outline_words(face));
    if let Some(words) = weight_words(face) {
        head(&mut out, "counting", &words);
    }
    face.notes.iter().for_each(|n| head(&mut out, "note", n));
    head(&mut out, "cutter", &cutter_words(face));
    lengths(&mut out, face);
    placement_words(face)
        .iter()
        .enumerate()
        .for_each(|(i, w)| head(&mut out, if i == 0 { "set-up" } else { "" }, w));
    head(&mut out, "proof", &certificate_words(face));
    if let Some(words) = sensitivity_words(face) {
        head(&mut out, "errors", &words);
    }
    unavoidable(&mut out, face);
    if let Some(t) = toothed(face) {
        toothed_words(&t)
            .iter()
            .enumerate()
            .for_each(|(i, w)| head(&mut out, if i == 0 { "teeth" } else { "" }, w));
    }
    alternatives(&mut out, face);
    ways(&mut out, face);
    edges(&mut out, face);
    if !face.survey.is_empty() {
        the_paper(&mut out, face);
    }
    crossing_lines(face).iter().for_each(|line| put(&mut out, line));
    out
}

/// A sentence with its word in front.
fn head(out: &mut String, word: &str, text: &str) {
    const INDENT: usize = 10;
    let word = if word.is_empty() { String::new() } else { format!("{word}:") };
    let mut line = format!("{word:<INDENT$}");
    let mut at = INDENT;
    let mut first = true;
    for w in terminal(text).split_whitespace() {
        let n = w.chars().count();
        if !first && at + 1 + n > WIDTH {
            put(out, &line);
            line = " ".repeat(INDENT);
            at = INDENT;
            first = true;
        }
        if !first {
            line.push(' ');
            at += 1;
        }
        line.push_str(w);
        at += n;
        first = false;
    }
    put(out, &line);
}

fn put(out: &mut String, line: &str) {
    out.push_str(line.trim_end());
    out.push('\n');
}

/// A name cut to columns.
fn name(text: &str, columns: usize) -> String {
    terminal(text).chars().take(columns).collect()
}

fn lengths(out: &mut String, face: &MilledFace<'_>) {
    let rows = before_after(face);
    put(out, &format!("\n{:<64}{:>12}{:>14}", "bad length [mm]", "", "with guard"));
    for (n, bad, guarded) in &rows {
        put(out, &format!("{:<64}{:>12}{:>14}", name(n, 63), fixed(*bad, 3), fixed(*guarded, 3)));
    }
    if let [(_, before, _), (_, after, _)] = &rows[..]
        && *before > 0.0
    {
        let saved = before - after;
        let share = format!("{} %", fixed(100.0 * saved / before, 1));
        put(out, &format!("{:<64}{:>12}{:>14}", "less by", fixed(saved, 3), share));
    }
    put(out, "");
}

fn unavoidable(out: &mut String, face: &MilledFace<'_>) {
    let all: Vec<_> = irreducible(face).into_iter().filter(|x| x.1 > 0.0).collect();
    if all.is_empty() {
        return;
    }
    let total: f64 = all.iter().map(|x| x.1).sum();
    let list: Vec<String> = all
        .iter()
        .take(MOST)
        .map(|(n, l, s)| format!("{n} {} mm ({})", fixed(*l, 3), area_share(*s)))
        .collect();
    let more = if all.len() > MOST { format!("; {} more loops", all.len() - MOST) } else { String::new() };
    head(
        out,
        "always",
        &format!(
            "no straight pass avoids {} mm: {}{more}; chamfer there before milling",
            fixed(total, 3),
            list.join("; ")
        ),
    );
}

fn alternatives(out: &mut String, face: &MilledFace<'_>) {
    let Ok(optimum) = &face.plan.optimum else { return };
    if optimum.alternatives.is_empty() {
        return;
    }
    put(
        out,
        &format!(
            "\n{:<34}{:>12}{:>12}{:>12}",
            "other minima of one straight pass", "bad mm", "turn deg", "line Y"
        ),
    );
    for a in &optimum.alternatives {
        let p = face.seen(a.placement);
        put(
            out,
            &format!(
                "{:<34}{:>12}{:>12}{:>12}",
                "",
                fixed(a.value, 3),
                fixed(turn(p.angle), 3),
                fixed(p.offset, 3)
            ),
        );
    }
}

fn ways(out: &mut String, face: &MilledFace<'_>) {
    put(out, &format!("\n{:>8}{:>10}{:>12}{:>10}  ways by time", "s", "bad mm", "with guard", "feed mm"));
    for (i, w) in face.plan.ways.iter().enumerate() {
        let mark = match (i == face.plan.chosen, w.unbeaten) {
            (true, _) => ">",
            (_, true) => "*",
            _ => " ",
        };
        let numbers = [fixed(w.time, 1), fixed(w.bad, 3), fixed(w.guarded, 3), fixed(w.feed_length, 1)];
        let [time, bad, guarded, feed] = numbers;
        put(out, &format!("{mark}{time:>7}{bad:>10}{guarded:>12}{feed:>10}  {}", terminal(&w.name)));
    }
    put(
        out,
        match face.plan.ways.len() {
            1 => "> chosen; --compare plans other ways too, each with its price",
            _ => "> chosen; * unbeaten: no other way is both faster and leaves less",
        },
    );
}

fn edges(out: &mut String, face: &MilledFace<'_>) {
    let all = bad_edges(face, face.chosen());
    if all.is_empty() {
        put(out, "\nno edge keeps a bad burr");
        return;
    }
    put(
        out,
        &format!(
            "\n{:<6}{:<16}{:>22}{:>22}{:>10}{:>8}{:>14}",
            "edge", "label", "from X, Y", "to X, Y", "bad mm", "deg", "chip mm"
        ),
    );
    for e in all.iter().take(MOST) {
        let point = |p: glam::DVec2| format!("{}, {}", fixed(p.x, 3), fixed(p.y, 3));
        put(
            out,
            &format!(
                "{:<6}{:<16}{:>22}{:>22}{:>10}{:>8}{:>14}",
                e.edge,
                name(e.label.as_deref().unwrap_or(""), 15),
                point(e.ends[0]),
                point(e.ends[1]),
                fixed(e.length, 3),
                fixed(e.exit_angles[0].to_degrees(), 1),
                trimmed(e.chip[1])
            ),
        );
    }
    if all.len() > MOST {
        let rest: f64 = all[MOST..].iter().map(|e| e.length).sum();
        put(out, &format!("and {} shorter stretches, {} mm", all.len() - MOST, fixed(rest, 3)));
    }
    put(
        out,
        "deg: least exit angle; chip: thickest where teeth leave; edges from 0 as in the outline as given",
    );
}

fn the_paper(out: &mut String, face: &MilledFace<'_>) {
    put(out, "");
    if let Some(words) = descents_words(face) {
        head(out, "paper", &words);
    }
    /// Lines of the table over a turn.
    const LINES: usize = 24;
    if !face.survey.iter().any(|p| p.covered) {
        return;
    }
    put(
        out,
        &format!("\n{:>10}{:>22}{:>12}   cutter over the middle", "turn deg", "largest exit angle", "bad mm"),
    );
    let step = face.survey.len().div_ceil(LINES).max(1);
    for p in face.survey.iter().step_by(step) {
        let angle = turn(if face.plan.left_hand { -p.angle } else { p.angle });
        let [largest, bad] = if p.covered {
            [fixed(p.largest_exit_angle.to_degrees(), 2), fixed(p.bad, 3)]
        } else {
            ["too wide", ""].map(str::to_owned)
        };
        put(out, &format!("{:>10}{largest:>22}{bad:>12}", fixed(angle, 1)));
    }
}
