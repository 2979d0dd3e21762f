//! The time of a program: each path under the limits of all axes, and what the control waits for.

use rayon::prelude::*;

use super::gathering::Gathering;
use super::leg::Task;
use super::program_time::ProgramTime;
use super::setting::Setting;
use super::stretch::{Stretch, StretchTime, stretches};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::Machine;
use crate::program::Program;
use crate::trace::Trace;

/// Segments up to which a program is solved without counting first.
const UNCOUNTED: usize = 2000;
/// Most cells, times axes, that are solved under a limit of jerk: a minute of work, or a million short blocks of three axes.
const MOST_CELLS: usize = 4_000_000;

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
    let mut gathering = Gathering::new(program, trace, &setting);
    for (stretch, done) in stretches.iter().zip(&done) {
        if !gathering.add(stretch, done) {
            return Ok(None);
        }
    }
    Ok(Some(gathering.time()))
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
