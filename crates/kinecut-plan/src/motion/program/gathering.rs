//! The times of stretches, gathered to that of their program.

use super::changes::changes;
use super::program_time::{ProgramTime, Smoothing};
use super::setting::Setting;
use super::stretch::{Stretch, StretchTime};
use crate::base::{Finding, Result};
use crate::program::Program;
use crate::trace::Trace;

/// The time of the stretches so far.
pub(super) struct Gathering<'a> {
    trace: &'a Trace,
    time: ProgramTime,
    /// Item and reason of the first stretch without a law.
    first: Option<(u32, Finding)>,
}

impl<'a> Gathering<'a> {
    /// The waits of a program, and no stretch yet.
    pub(super) fn new(program: &Program, trace: &'a Trace, setting: &Setting) -> Gathering<'a> {
        let [tool_changes, spindle_changes] = changes(program, &setting.machine.control);
        let time = ProgramTime {
            segments: vec![0.0; trace.segments.len()],
            moves: 0.0,
            without_jerk: 0.0,
            limits_jerk: setting.limits_jerk(),
            // The sum of nothing is the other zero.
            dwells: trace.dwells.iter().fold(0.0, |sum, d| sum + d.1),
            tool_changes,
            spindle_changes,
            smoothing: Smoothing::default(),
            dilation: 1.0,
            jerk_left_out: 0,
            refused: 0,
            reason: None,
            swings: 0.0,
        };
        Gathering { trace, time, first: None }
    }

    /// Adds a stretch, one without a law in the time that the program gives it; false if an axis that moves has no limits.
    pub(super) fn add(&mut self, stretch: &Stretch, done: &Result<Option<StretchTime>>) -> bool {
        let (trace, time) = (self.trace, &mut self.time);
        let programmed;
        let done = match done {
            Ok(Some(done)) => done,
            Ok(None) => return false,
            Err(reason) => {
                time.refused += stretch.segments.len();
                let item = stretch.segments.first().map_or(0, |i| trace.segments[*i].item);
                self.first.get_or_insert_with(|| (item, Finding::clone(&reason.0)));
                programmed = stretch.as_programmed(trace);
                &programmed
            }
        };
        for (i, own) in stretch.segments.iter().zip(&done.times) {
            time.segments[*i] = *own;
            time.moves += own;
        }
        time.without_jerk += done.without_jerk;
        time.smoothing.add(&done.smoothing);
        time.dilation = time.dilation.max(done.dilation);
        time.jerk_left_out += done.jerk_left_out;
        time.swings += done.swings;
        true
    }

    /// The time of all.
    pub(super) fn time(self) -> ProgramTime {
        let refused = self.time.refused;
        let reason = self.first.map(|(item, reason)| {
            let what = format!(
                "the time of {refused} moves is that at their programmed feed, without the limits of the axes: {}",
                reason.message
            );
            Finding { value: reason.value, bound: reason.bound, ..Finding::note(reason.code, what) }.item(item)
        });
        ProgramTime { reason, ..self.time }
    }
}
