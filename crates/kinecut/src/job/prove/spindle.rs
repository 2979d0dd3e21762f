//! The spindle turns the wrong way for the tool that cuts, or faster than tool or machine may.

use std::f64::consts::TAU;

use super::Simulated;
use super::text::line_with;
use super::work::Work;
use crate::base::{Code, Finding};
use crate::operations::Operation;
use crate::program::{Item, Spindle};
use crate::tool::Hand;

pub(super) fn spindle(simulated: &Simulated<'_>) -> Vec<Finding> {
    let works = simulated.works;
    let mut found: Vec<Finding> = works.iter().filter_map(|w| backwards(simulated, w)).collect();
    found.extend(works.iter().filter_map(|w| too_fast(simulated, w)));
    found
}

fn backwards(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let program = &simulated.setups[work.setup].program;
    // An operation that mills with a left-hand cutter says so itself.
    let left = work.operation.is_some_and(Operation::is_left_hand);
    let hand = if left { Hand::Left } else { work.tool.limits.hand };
    let wrong = |item: u32| match (program.state(item as usize).spindle, hand) {
        (Spindle::CounterClockwise(rate), Hand::Right) | (Spindle::Clockwise(rate), Hand::Left) => rate > 0.0,
        _ => false,
    };
    let cut = work.done.iter().find(|d| d.met() && wrong(d.segment.item))?;
    // The move from which on it turns that way; a tool call may be noted late.
    let moves = |i: &u32| matches!(program.items.get(*i as usize), Item::Move(_) | Item::Cycle(..));
    let turned = (0..=cut.segment.item).rev().take_while(|&i| wrong(i) || !moves(&i));
    let first = turned.filter(moves).last().unwrap_or(cut.segment.item);
    let (word, right, hand) = match hand {
        Hand::Right => ("M4", "M3", "right"),
        Hand::Left => ("M3", "M4", "left"),
    };
    let message = format!("{word} turns {} backwards: it is a {hand}-hand tool", work.tool.number);
    let finding = Finding::error(Code::SPINDLE_WRONG, message)
        .help(format!("write {right}; `hand` of the tool says which way it cuts"));
    // A block that only switches makes no item: its line is between two of them.
    let digit = word.as_bytes()[1];
    let line = line_with(&simulated.setups[work.setup], first, |t| t.has_code(b'M', digit));
    let mut finding = simulated.at(work.setup, first, finding);
    if line.is_some() {
        finding.place = simulated.place_of_line(work.setup, line);
    }
    Some(finding)
}

fn too_fast(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let machine = simulated.job.machine.as_ref().and_then(|m| m.control.max_speed);
    let limits = [(work.tool.limits.max_speed, "tool"), (machine, "machine")];
    let (most, of) = limits
        .into_iter()
        .filter_map(|(limit, of)| limit.map(|l| (l, of)))
        .reduce(|a, b| if b.0 < a.0 { b } else { a })?;
    let program = &simulated.setups[work.setup].program;
    /// Rounding of a speed.
    const ROUNDING: f64 = 1.0 + 1e-6;
    let fast = |item: u32| program.state(item as usize).spindle.rate();
    let first = work.done.iter().find(|d| fast(d.segment.item) > most * ROUNDING)?;
    let message = format!("the spindle turns faster than the {of} may with {}", work.tool.number);
    let finding = Finding::error(Code::SPINDLE_WRONG, message)
        .value(per_minute(fast(first.segment.item)), "rev/min")
        .bound(per_minute(most), &format!("rev/min, `max_speed` of the {of}"))
        .help("lower the speed");
    Some(simulated.at(work.setup, first.segment.item, finding))
}

/// From rad/s to whole revolutions per minute.
fn per_minute(rate: f64) -> f64 {
    (rate * 60.0 / TAU).round()
}
