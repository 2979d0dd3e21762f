//! The share of the way on which the axes hold the programmed feed.

use crate::motion::ProgramTime;
use crate::trace::{SegmentPace, Trace};

/// Programmed feeds against those that the law of the axes reaches.
pub(crate) struct HeldFeed {
    /// Way at feed [mm].
    way: f64,
    /// Way of the moves whose mean feed is the programmed one, to one percent [mm].
    held: f64,
    /// The move that loses most time: its item, its mean feed and the programmed one [mm/s].
    slowest: Option<(u32, [f64; 2])>,
}

impl HeldFeed {
    /// Of a program with its law.
    pub(crate) fn of(trace: &Trace, law: &ProgramTime) -> HeldFeed {
        /// Share of the feed from which a move holds it.
        const HOLDS: f64 = 0.99;
        let mut all = HeldFeed { way: 0.0, held: 0.0, slowest: None };
        let mut lost_most = 0.0;
        for (segment, time) in trace.segments.iter().zip(&law.segments) {
            let SegmentPace::Feed(feed) = segment.motion else { continue };
            let way = segment.curve.length();
            if segment.alternative || !(way > 0.0 && *time > 0.0) {
                continue;
            }
            let mean = way / time;
            all.way += way;
            if mean >= HOLDS * feed {
                all.held += way;
            }
            let lost = time - way / feed;
            if lost > lost_most && mean < HOLDS * feed {
                lost_most = lost;
                all.slowest = Some((segment.item, [mean, feed]));
            }
        }
        all
    }

    /// The share, and the line and feeds of the move that loses most time; nothing where nothing moves at feed.
    pub(crate) fn words(&self, line: impl Fn(u32) -> Option<u32>) -> Option<(String, String)> {
        if self.way <= 0.0 {
            return None;
        }
        // Rounded down: never kinder than it is.
        let share = (100.0 * self.held / self.way).floor();
        let place = |item: u32| line(item).map_or(String::new(), |line| format!(" in line {}", line + 1));
        let slowest = self.slowest.map(|(item, [mean, feed])| {
            let [mean, feed] = [mean, feed].map(|v| (v * 60.0).round());
            format!("most time is lost{}: {mean} of {feed} mm/min on average", place(item))
        });
        Some((format!("held on {share} % of the way"), slowest.unwrap_or_default()))
    }
}
