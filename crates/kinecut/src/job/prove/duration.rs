//! Programs and moves that take absurdly long at their programmed feeds.

use super::Simulated;
use crate::base::{Code, Finding};

/// Longest program [s]: a day.
const PROGRAM: f64 = 24.0 * 3600.0;
/// Longest single move [s].
const MOVE: f64 = 4.0 * 3600.0;

pub(super) fn duration(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (setup, outcome) in simulated.setups.iter().enumerate() {
        let hours = |seconds: f64| (seconds / 360.0).round() / 10.0;
        let slow = simulated.segments(setup).find(|d| d.segment.duration.is_some_and(|t| t > MOVE));
        if let Some(done) = slow {
            let finding = Finding::warning(Code::ABSURD_RUN, "a single move takes absurdly long")
                .value(hours(done.segment.duration.unwrap_or_default()), "h")
                .bound(hours(MOVE), "h")
                .help("correct the feed");
            found.push(simulated.at(setup, done.segment.item, finding));
            continue;
        }
        let (time, _) = outcome.trace.duration();
        if time > PROGRAM {
            let message = format!("program `{}` takes absurdly long", outcome.file);
            let slowest = simulated
                .segments(setup)
                .filter_map(|d| Some((d.segment.item, d.segment.duration?)))
                .reduce(|a, b| if b.1 > a.1 { b } else { a });
            let finding = Finding::warning(Code::ABSURD_RUN, message)
                .value(hours(time), "h")
                .bound(hours(PROGRAM), "h")
                .help("correct the feeds; the block is that which takes longest");
            found.extend(slowest.map(|(item, _)| simulated.at(setup, item, finding)));
        }
    }
    found
}
