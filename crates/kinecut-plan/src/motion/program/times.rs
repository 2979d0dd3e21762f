//! The time of a program: each path under the limits of all axes, and what the control waits for.

use rayon::prelude::*;

use super::changes::changes;
use super::leg::Task;
use super::program_time::{ProgramTime, Smoothing};
use super::setting::Setting;
use super::stretch::{Stretch, StretchTime, stretches};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::Machine;
use crate::program::Program;
use crate::trace::Trace;

/// Segments up to which a program is solved without counting first.
const UNCOUNTED: usize = 2000;
/// Most cells, times axes, that are solved under a limit of jerk: some ten seconds of work.
const MOST_CELLS: usize = 1_000_000;

/// The time of a program that was followed on a machine; `None` if an axis that moves has no rapid speed or no acceleration.
///
/// Each stretch of feed between stops is run as fast as the axes allow ([`TimeLaw`](super::super::TimeLaw)); at joints the
/// control stops or leaves the path by its tolerance, whichever is faster. Rapids and straight moves from stop to stop are
/// exact.
///
/// # Errors
/// `KC0009` when it was cancelled.
pub fn program_time(
    program: &Program,
    trace: &Trace,
    machine: &Machine,
    progress: &dyn Progress,
) -> Result<Option<ProgramTime>> {
    let setting = Setting::new(machine, progress);
    let stretches = stretches(program, trace, &setting);
    let done = done(&stretches, (program, trace), &setting, task(&stretches, (program, trace), &setting)?)?;
    let [tool_changes, spindle_changes] = changes(program, &machine.control);
    let mut time = ProgramTime {
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
    let mut first: Option<(u32, Finding)> = None;
    for (stretch, done) in stretches.iter().zip(done) {
        let done = match done {
            Ok(Some(done)) => done,
            Ok(None) => return Ok(None),
            Err(reason) => {
                time.refused += stretch.segments.len();
                let item = stretch.segments.first().map_or(0, |i| trace.segments[*i].item);
                first.get_or_insert((item, *reason.0));
                stretch.as_programmed(trace)
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
    }
    time.reason = first.map(|(item, reason)| {
        let what = format!(
            "the time of {} moves is that at their programmed feed, without the limits of the axes: {}",
            time.refused, reason.message
        );
        Finding { value: reason.value, bound: reason.bound, ..Finding::note(reason.code, what) }.item(item)
    });
    Ok(Some(time))
}

/// The task that stretches can be given: of a long program the cells are counted before any of them is solved.
///
/// # Errors
/// `KC0009` when it was cancelled.
pub(super) fn task(stretches: &[Stretch], of: (&Program, &Trace), setting: &Setting) -> Result<Task> {
    if of.1.segments.len() <= UNCOUNTED || !setting.limits_jerk() {
        return Ok(Task::Solve);
    }
    let counted = done(stretches, of, setting, Task::Count)?;
    let cells: usize = counted.into_iter().flatten().flatten().map(|time| time.cells).sum();
    Ok(if cells > MOST_CELLS { Task::SolveWithoutJerk } else { Task::Solve })
}

/// This task done for stretches; an error of one is that of its law.
///
/// # Errors
/// `KC0009` when it was cancelled.
pub(super) fn done<'a>(
    stretches: &[Stretch],
    (program, trace): (&Program, &'a Trace),
    setting: &Setting,
    task: Task,
) -> Result<Vec<Result<Option<StretchTime<'a>>>>> {
    let progress = setting.progress;
    let time = |stretch: &Stretch| {
        if progress.cancelled() {
            return Ok(None);
        }
        let time = stretch.time(program, trace, setting, task);
        if task != Task::Count {
            progress.advance(stretch.segments.len() as u64);
        }
        time
    };
    let done = stretches.par_iter().with_max_len(1).map(time).collect();
    match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "the run was cancelled").into()),
        false => Ok(done),
    }
}
