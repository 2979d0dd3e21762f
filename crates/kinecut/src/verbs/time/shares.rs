//! Shares of the time of programs.

use serde::Serialize;

use super::moving::MovingProgram;
use crate::motion::ProgramTime;
use crate::page;
use crate::trace::SegmentPace;

/// Parts of the time [s].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct TimeShares {
    /// Moves at feed.
    pub feed: f64,
    /// Rapids.
    pub rapid: f64,
    /// Waits that the program asks for.
    pub dwells: f64,
    /// Tool changes and ramps of the spindle, as far as the machine states their time.
    pub changes: f64,
}

impl TimeShares {
    /// Of some programs together.
    pub(super) fn of(programs: &[(MovingProgram, ProgramTime)]) -> TimeShares {
        let mut all = TimeShares::default();
        for (program, time) in programs {
            for (segment, own) in program.trace.segments.iter().zip(&time.segments) {
                match segment.motion {
                    SegmentPace::Rapid => all.rapid += own,
                    SegmentPace::Feed(_) => all.feed += own,
                }
            }
            all.dwells += time.dwells;
            let changes = [time.tool_changes, time.spindle_changes];
            all.changes += changes.iter().filter_map(|changes| changes.time).sum::<f64>();
        }
        all
    }

    /// In words, those that are not zero.
    pub(super) fn words(&self) -> String {
        let parts = [
            ("at feed", self.feed),
            ("rapid", self.rapid),
            ("dwells", self.dwells),
            ("changes", self.changes),
        ];
        let all: f64 = parts.iter().map(|(_, time)| time).sum();
        let one = |(what, time): (&str, f64)| {
            format!("{} {what} ({} %)", page::duration(time), page::fixed(100.0 * time / all, 0))
        };
        let words: Vec<String> = parts.into_iter().filter(|(_, time)| *time > 0.0).map(one).collect();
        words.join(", ")
    }
}
