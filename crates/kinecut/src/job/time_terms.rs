//! Terms under which the time of programs holds, in words.

use crate::motion::ProgramTime;
use crate::page;
use crate::trace::Trace;

/// Terms of the time of these programs together: under the limits of the axes where all of them have a law, with the time
/// below which no run can be and what is not in it; else at programmed feeds.
pub(crate) fn terms(programs: &[(&Trace, Option<&ProgramTime>)]) -> String {
    let laws: Option<Vec<&ProgramTime>> = programs.iter().map(|(_, law)| *law).collect();
    let Some(laws) = laws else {
        let complete = programs.iter().all(|(trace, _)| trace.duration().1);
        let rapids = if complete { "rapids at full speed" } else { "without rapids" };
        return format!("at programmed feeds, {rapids}");
    };
    let least = laws.iter().map(|time| time.least()).sum();
    let mut terms = format!("under the limits of the axes, at least {}", page::duration(least));
    let smoothed: usize = laws.iter().map(|time| time.smoothing.smoothed).sum();
    if smoothed > 0 {
        let farthest = laws.iter().map(|time| time.smoothing.farthest).fold(0.0, f64::max);
        // Rounded up: never kinder than it is.
        let off = page::fixed((farthest * 1e3).ceil() / 1e3, 3);
        let joints = if smoothed == 1 { "joint" } else { "joints" };
        terms += &format!("; {smoothed} {joints} smoothed, at most {off} mm off the path");
    }
    let too_many: usize = laws.iter().map(|time| time.without_limit_of_jerk).sum();
    if too_many > 0 {
        terms += &format!("; jerk not counted on {too_many} moves, they are too many");
    }
    let refused: usize = laws.iter().map(|time| time.refused.0).sum();
    if refused > 0 {
        terms += &format!("; {refused} moves at programmed feed");
    }
    let missing = |changes: fn(&ProgramTime) -> (usize, Option<f64>), what: &str| {
        let unknown = laws.iter().map(|time| changes(time)).filter(|c| c.1.is_none());
        let count: usize = unknown.map(|c| c.0).sum();
        (count > 0).then(|| format!("{count} {what}{}", if count == 1 { "" } else { "s" }))
    };
    let missing = [
        missing(|time| time.tool_changes, "tool change"),
        missing(|time| time.spindle_changes, "spindle ramp"),
    ];
    let missing: Vec<String> = missing.into_iter().flatten().collect();
    if !missing.is_empty() {
        terms += &format!("; not counted: {}", missing.join(", "));
    }
    terms
}
