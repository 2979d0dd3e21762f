//! Speed or feed that a tool takes over from one of another kind, because the program does not say its own: S and F stay in
//! force over a tool change. Only programs of others can have that; what a job says of each operation is its own.

use super::text::Text;
use super::work::{Work, radius};
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::program::Speed;
use crate::tool::Tool;

/// Tools of one kind whose diameters differ by less than this share may share speed and feed.
const ALIKE: f64 = 0.25;

pub(super) fn carried(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for pair in simulated.works.windows(2) {
        let [before, work] = pair else { continue };
        if before.setup == work.setup
            && simulated.setups[work.setup].external.is_some()
            && !alike(before.tool, work.tool)
        {
            found.extend(one(simulated, before, work));
        }
    }
    found
}

fn alike(a: &Tool, b: &Tool) -> bool {
    let ratio = radius(a) / radius(b);
    a.cutter.is_axial() == b.cutter.is_axial() && (ratio - 1.0).abs() < ALIKE
}

fn one(simulated: &Simulated<'_>, before: &Work<'_>, work: &Work<'_>) -> Vec<Finding> {
    let outcome = &simulated.setups[work.setup];
    let (Some(external), Some(last), Some(first)) =
        (&outcome.external, before.done.iter().rfind(|d| d.cuts()), work.done.iter().find(|d| d.cuts()))
    else {
        return Vec::new();
    };
    let item = |d: &Done<'_>| d.segment.item as usize;
    let (Some(from), Some(to)) = (outcome.lines[item(last)], outcome.lines[item(first)]) else {
        return Vec::new();
    };
    // A text that jumps is not looked through.
    if from >= to {
        return Vec::new();
    }
    let lines: Vec<Text> = outcome
        .posted
        .text
        .lines()
        .skip(from as usize + 1)
        .take((to - from) as usize)
        .map(|l| Text::of(l, external.control))
        .collect();
    let states = [last, first].map(|d| *outcome.program.state(item(d)));
    let mut found = Vec::new();
    let rates = states.map(|s| s.spindle.rate());
    if rates[0] == rates[1] && rates[1] > 0.0 && !lines.iter().any(|t| t.has_word(b'S')) {
        // The first move on which the spindle turns with the new tool.
        let start = work.done.iter().find(|d| d.segment.spindle_on).unwrap_or(first);
        let message = format!(
            "{} turns at the speed of {}: no S is written for it",
            work.tool.number, before.tool.number
        );
        let finding = Finding::warning(Code::CUTTING_DATA, message)
            .value((rates[1] * 60.0 / std::f64::consts::TAU).round(), "rev/min")
            .help("write its own S after the tool change");
        found.push(simulated.at(work.setup, start.segment.item, finding));
    }
    let feed = |speed: Speed| match speed {
        Speed::PerMinute(feed) => Some((feed * 60.0, "mm/min")),
        Speed::PerRevolution(feed) => Some((feed, "mm/rev")),
        _ => None,
    };
    // The feed of a klartext cycle is in its parameters.
    let written = |t: &Text| t.has_word(b'F') || t.has("Q206=") || t.has("Q207=");
    if let [Some(old), Some(new)] = states.map(|s| feed(s.speed))
        && old == new
        && !lines.iter().any(written)
    {
        let message = format!(
            "{} cuts at the feed of {}: no F is written for it",
            work.tool.number, before.tool.number
        );
        let finding = Finding::warning(Code::CUTTING_DATA, message)
            .value((new.0 * 1e3).round() / 1e3, new.1)
            .help("write its own F after the tool change");
        found.push(simulated.at(work.setup, first.segment.item, finding));
    }
    found
}
