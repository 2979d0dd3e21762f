//! Moves on which the tool leans or turns: the stock is not cut along them, so each of them counts as not proven unless the
//! swept bound of the tool keeps clear of the stock's box.

use super::Simulated;
use super::swept::{RevolvedBody, bodies, is_clear, is_uncut};
use crate::base::{Code, Finding};
use crate::geom::Aabb;
use crate::job::check::Job;
use crate::job::setup_outcome::SetupOutcome;
use crate::tool::ToolNumber;
use crate::trace::{Segment, Trace};

/// Distance of a tool from the box of the stock above which a move counts as clear of it [mm].
pub(in crate::job) const MARGIN: f64 = 1.0;

/// The segments of a program that are not cut and may come near the stock, by their indices.
pub(in crate::job) fn near_stock<'a>(job: &Job, done: &'a SetupOutcome) -> &'a [usize] {
    done.known.near_stock.get_or_init(|| near(job, &done.trace))
}

fn near(job: &Job, trace: &Trace) -> Vec<usize> {
    let bounds = job.stock.bounds();
    let mut known: Vec<(ToolNumber, Option<Vec<RevolvedBody>>)> = Vec::new();
    let uncut = trace.segments.iter().enumerate().filter(|(_, s)| is_uncut(s));
    uncut.filter(|(_, s)| !clear(job, s, bounds, trace.chord_error, &mut known)).map(|(i, _)| i).collect()
}

fn clear(
    job: &Job,
    segment: &Segment,
    bounds: Aabb,
    error: f64,
    known: &mut Vec<(ToolNumber, Option<Vec<RevolvedBody>>)>,
) -> bool {
    let Some(number) = segment.tool else { return false };
    if known.iter().all(|(n, _)| *n != number) {
        let tool = job.tools.iter().find(|t| t.number == number);
        known.push((number, tool.and_then(|t| bodies(t).ok())));
    }
    let body = known.iter().find(|(n, _)| *n == number).and_then(|(_, b)| b.as_deref());
    body.is_some_and(|bodies| is_clear(segment, bodies, bounds, MARGIN, error))
}

/// Moves that are not cut and come near the stock: one doubt for each setup, at the first of them.
pub(super) fn turned(simulated: &Simulated<'_>) -> Vec<Finding> {
    let one = |(setup, done): (usize, &SetupOutcome)| {
        let near = near_stock(simulated.job, done);
        let segments = || near.iter().map(|&i| &done.trace.segments[i]);
        let first = segments().next()?;
        let mut items: Vec<u32> = segments().map(|s| s.item).collect();
        items.dedup();
        let way: f64 = segments().filter(|s| !s.alternative).map(|s| s.curve.length()).sum();
        let lines: Vec<u32> =
            items.iter().filter_map(|&i| done.lines.get(i as usize).copied().flatten()).collect();
        let what = format!(
            "{} of a tool that leans or turns near the stock {} not cut: it is not known what they cut or touch{}",
            if items.len() == 1 { "a move".to_owned() } else { format!("{} moves", items.len()) },
            if items.len() == 1 { "is" } else { "are" },
            in_lines(&lines)
        );
        let finding = Finding::doubt(Code::NOT_CUT, what)
            .value(way.round(), "mm")
            .help("run them above the part first; a rapid that only turns the axes: retract before it");
        Some(Finding { place: simulated.place(setup, first.item), ..finding })
    };
    simulated.setups.iter().enumerate().filter_map(one).collect()
}

/// Lines, 0-based and ascending, as ranges counted from 1.
fn in_lines(lines: &[u32]) -> String {
    /// Ranges that are shown.
    const MOST: usize = 8;
    let mut ranges: Vec<[u32; 2]> = Vec::new();
    for line in lines.iter().map(|l| l + 1) {
        match ranges.last_mut() {
            Some([_, last]) if line == *last || line == *last + 1 => *last = line,
            _ => ranges.push([line, line]),
        }
    }
    let one = |[from, to]: &[u32; 2]| match to - from {
        0 => format!("{from}"),
        _ => format!("{from} to {to}"),
    };
    let shown: Vec<String> = ranges.iter().take(MOST).map(one).collect();
    let more = if ranges.len() > MOST { " and further" } else { "" };
    match shown.is_empty() {
        true => String::new(),
        false => format!(" (lines {}{more})", shown.join(", ")),
    }
}

/// Claim about the moves that are not cut, with its bound, if there are some and all keep clear.
pub(in crate::job) fn clear_claim(job: &Job, done: &SetupOutcome) -> Option<(String, String)> {
    let uncut = done.trace.segments.iter().filter(|s| is_uncut(s)).count();
    (uncut > 0 && near_stock(job, done).is_empty()).then(|| {
        (
            format!("where the tool of `{}` leans or turns it keeps clear of the stock", done.file),
            format!(
                "swept bound of flutes, shank and given holder, {MARGIN} mm or more from the box of the stock"
            ),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::in_lines;

    #[test]
    fn lines_are_counted_from_one_and_joined_to_ranges() {
        assert_eq!(in_lines(&[13, 14, 14, 15, 20]), " (lines 14 to 16, 21)");
        assert_eq!(in_lines(&[]), "");
    }
}
