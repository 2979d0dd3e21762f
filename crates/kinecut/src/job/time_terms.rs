//! Terms under which the time of programs holds, in words.

use crate::machine::Machine;
use crate::motion::{Changes, ProgramTime, axis_limits};
use crate::page;
use crate::trace::Trace;

/// Terms of the time of these programs together: under the limits of the axes where all of them have a law, with the time if
/// jerk had no limit and what is not in it; else at programmed feeds, with the axes whose limits are missing.
pub(crate) fn terms(programs: &[(&Trace, Option<&ProgramTime>)], machine: Option<&Machine>) -> String {
    let laws: Option<Vec<&ProgramTime>> = programs.iter().map(|(_, law)| *law).collect();
    match laws {
        Some(laws) => of_laws(&laws),
        None => at_programmed_feeds(programs.iter().all(|(trace, _)| trace.duration().1), machine),
    }
}

/// Terms of a time at programmed feeds; `complete`: rapids are in it.
pub(crate) fn at_programmed_feeds(complete: bool, machine: Option<&Machine>) -> String {
    let rapids = if complete { "rapids at full speed" } else { "without rapids" };
    format!("at programmed feeds, {rapids}{}", machine.map(unlimited).unwrap_or_default())
}

/// The axes of a machine that has some limits and lacks others.
fn unlimited(machine: &Machine) -> String {
    let limits = axis_limits(machine);
    if limits.iter().all(Option::is_none) {
        return String::new();
    }
    let without: Vec<String> = ['X', 'Y', 'Z', 'A', 'B', 'C']
        .into_iter()
        .zip(limits)
        .filter(|(letter, limit)| limit.is_none() && machine.joint(*letter).is_some())
        .map(|(letter, _)| letter.to_string())
        .collect();
    match without.len() {
        0 => String::new(),
        1 => format!("; axis {} has no rapid speed or no acceleration", without[0]),
        _ => format!("; axes {} have no rapid speed or no acceleration", without.join(", ")),
    }
}

fn of_laws(laws: &[&ProgramTime]) -> String {
    let mut terms = "under the limits of the axes".to_owned();
    if laws.iter().any(|time| time.limits_jerk) {
        let free = laws.iter().map(|time| time.total_without_jerk()).sum();
        terms += &format!(", {} if jerk had no limit", page::duration(free));
    } else {
        terms += ", jerk not limited";
    }
    let sum = |count: fn(&ProgramTime) -> usize| laws.iter().map(|time| count(time)).sum::<usize>();
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let smoothed = sum(|time| time.smoothing.smoothed);
    if smoothed > 0 {
        let farthest = laws.iter().map(|time| time.smoothing.most_off()).fold(0.0, f64::max);
        // Rounded up: never kinder than it is.
        let off = page::fixed((farthest * 1e3).ceil() / 1e3, 3);
        terms += &format!("; {} smoothed, up to {off} mm off the path", counted(smoothed, "joint"));
    }
    let swings: f64 = laws.iter().map(|time| time.swings).sum();
    if swings > 0.0 {
        terms += &format!("; {} of turns on the spot", page::duration(swings));
    }
    let mut missing = Vec::new();
    let jerk = sum(|time| time.jerk_left_out);
    if jerk > 0 {
        missing.push(format!("jerk on {}", counted(jerk, "move")));
    }
    let refused = sum(|time| time.refused);
    if refused > 0 {
        missing.push(format!("limits on {}", counted(refused, "move")));
    }
    let unknown = |changes: fn(&ProgramTime) -> Changes| -> usize {
        laws.iter().map(|time| changes(time)).filter(|c| c.time.is_none()).map(|c| c.count).sum()
    };
    let waits = [
        (unknown(|time| time.tool_changes), "tool change"),
        (unknown(|time| time.spindle_changes), "spindle ramp"),
    ];
    missing
        .extend(waits.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| counted(count, what)));
    if !missing.is_empty() {
        terms += &format!("; not counted: {}", missing.join(", "));
    }
    terms
}
