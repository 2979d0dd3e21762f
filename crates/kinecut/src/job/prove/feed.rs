//! A feed that is faster than the tool may go, or the machine can.

use super::Simulated;
use crate::base::{Code, Finding};

/// Faster than this no machine tool feeds [mm/s]: 150 m/min, above the rapid of linear motors.
const FASTEST: f64 = 2500.0;
/// Rounding of a feed.
const ROUNDING: f64 = 1.0 + 1e-6;

pub(super) fn feed(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    let machine = simulated.job.machine.as_ref();
    for work in simulated.works {
        let limits = [
            (work.tool.limits.max_feed, "`max_feed` of the tool"),
            (machine.and_then(|m| m.control.max_feed), "`max_feed` of the machine"),
            (machine.and_then(|m| m.control.max_feed.or(m.dynamics.rapid)), "the rapid of the machine"),
            (Some(FASTEST), "faster than any machine"),
        ];
        let least = limits.into_iter().filter_map(|(limit, of)| limit.map(|l| (l, of)));
        let Some((most, of)) = least.reduce(|a, b| if b.0 < a.0 { b } else { a }) else { continue };
        let mut last = 0.0;
        for done in work.feeds() {
            // A tool that turns about its tip has no path speed to speak of.
            let Some(feed) = done.feed().filter(|_| done.segment.turning.is_none()) else { continue };
            if feed > most * ROUNDING && feed != last {
                let message = format!("{} feeds faster than it can or may", work.tool.number);
                let finding = Finding::error(Code::FEED_TOO_FAST, message)
                    .value((feed * 60.0).round(), "mm/min")
                    .bound((most * 60.0).round(), &format!("mm/min, {of}"))
                    .help("correct F, or whether it counts per minute (G94) or per revolution (G95)");
                found.push(simulated.at(work.setup, done.segment.item, finding));
            }
            last = feed;
        }
    }
    found
}
