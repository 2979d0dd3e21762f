//! Samples of the motion of a program at a control's cycle.
//!
//! The moves are solved again, some thousand at a time in order, and looked at at multiples of the cycle; nothing is kept.

use super::gathering::Gathering;
use super::motion::AxisMoment;
use super::program_time::ProgramTime;
use super::sampler::{Sampler, multiples};
use super::setting::Setting;
use super::stretch::{Stretch, stretches};
use super::times::{done, task};
use super::waits::waits;
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::Machine;
use crate::program::Program;
use crate::trace::Trace;

/// Moves that are solved together; a stretch without a stop always is.
const MOVES: usize = 4096;

/// All axes X Y Z A B C at a moment of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionSample {
    /// Time from the start of the program [s].
    pub time: f64,
    /// Index of the program item.
    pub item: u32,
    /// Index of the segment in the trace; none while the axes rest.
    pub segment: Option<u32>,
    /// Speed of the tip along the programmed path [mm/s]; of linear axes that run for themselves, their speed together.
    pub feed: f64,
    /// The axes.
    pub axes: [AxisMoment; 6],
}

/// Extent of a program that was sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampledMotion {
    /// Number of samples.
    pub count: u64,
    /// Moment of the last sample [s]: the time of the program.
    pub time: f64,
    /// Moves without samples: their stretch has no law.
    pub left_out: usize,
    /// Their time [s], in which there are no samples.
    pub left_out_time: f64,
    /// Places at which an axis is somewhere else than the move before left it: what is between could not be followed.
    pub jumps: usize,
}

/// Number of samples of a program of this time [s] at a cycle [s]: one at each multiple of the cycle, and one at the end.
pub fn sample_count(time: f64, cycle: f64) -> f64 {
    multiples(time, cycle) + 1.0
}

/// Hands the motion of a program to `sink`, in order: at each multiple of `cycle` [s], and at its end; then its time. `None`
/// if an axis that moves has no rapid speed or no acceleration.
///
/// The time is that of [`program_time`](super::program_time). Rests have samples too: before the first move
/// that was followed the axes stand where that begins. A spindle that changes its speed within moves without a stop is waited
/// for before the first of them.
///
/// # Errors
/// `KC0404` for a cycle that is not positive, `KC0009` when it was cancelled, those of `sink`.
pub fn program_samples(
    program: &Program,
    trace: &Trace,
    machine: &Machine,
    cycle: f64,
    progress: &dyn Progress,
    sink: &mut dyn FnMut(&MotionSample) -> Result<()>,
) -> Result<Option<(ProgramTime, SampledMotion)>> {
    samples_of((program, trace, machine), cycle, None, progress, sink)
}

/// Samples between those of the cycle, where the motion changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinerSamples {
    /// Largest time between two samples [s] of which one is in another segment, or is faster by more than `speed` or
    /// accelerated by more than `acceleration`.
    pub cycle: f64,
    /// Change of the path speed [mm/s].
    pub speed: f64,
    /// Change of the size of the acceleration of the linear axes [mm/s^2].
    pub acceleration: f64,
}

/// The same with more samples where the motion changes: at both ends of each motion from stop to stop, and between two
/// samples of the cycle that differ by more than is allowed, halved down to the finer cycle.
///
/// # Errors
/// As [`program_samples`].
pub fn program_samples_finer(
    program: &Program,
    trace: &Trace,
    machine: &Machine,
    (cycle, finer): (f64, FinerSamples),
    progress: &dyn Progress,
    sink: &mut dyn FnMut(&MotionSample) -> Result<()>,
) -> Result<Option<(ProgramTime, SampledMotion)>> {
    samples_of((program, trace, machine), cycle, Some(finer), progress, sink)
}

fn samples_of(
    (program, trace, machine): (&Program, &Trace, &Machine),
    cycle: f64,
    finer: Option<FinerSamples>,
    progress: &dyn Progress,
    sink: &mut dyn FnMut(&MotionSample) -> Result<()>,
) -> Result<Option<(ProgramTime, SampledMotion)>> {
    if !([Some(cycle), finer.map(|f| f.cycle)].into_iter().flatten().all(|c| c > 0.0 && c.is_finite())) {
        let what = "the cycle of samples must be positive and finite";
        return Err(Finding::error(Code::PLAN_VALUE, what)
            .value(cycle, "s")
            .bound(0.0, "s")
            .key("cycle")
            .into());
    }
    let setting = Setting { keeps_motion: true, ..Setting::new(machine, progress) };
    let stretches = stretches(program, trace, &setting);
    let task = task(&stretches, (program, trace), &setting)?;
    let waits = waits(program, trace, &machine.control);
    let mut waits = waits.iter().peekable();
    let mut sampler = Sampler::new(trace, (cycle, finer), progress, sink);
    let mut gathering = Gathering::new(program, trace, &setting);
    let mut left = &stretches[..];
    while !left.is_empty() {
        let mut moves = 0;
        let fits = |stretch: &&Stretch| {
            let before = moves;
            moves += stretch.segments.len();
            before < MOVES
        };
        let (batch, others) = left.split_at(left.iter().take_while(fits).count());
        left = others;
        for (stretch, solved) in batch.iter().zip(done(batch, (program, trace), &setting, task)?) {
            let last = stretch.segments.last().copied().unwrap_or(0);
            sampler.begin(stretch);
            while let Some(wait) = waits.next_if(|wait| wait.before <= last) {
                sampler.rest(wait)?;
            }
            if !gathering.add(stretch, &solved) {
                return Ok(None);
            }
            match solved {
                Ok(Some(solved)) => sampler.moves(&solved)?,
                _ => sampler.leave_out(stretch),
            }
        }
    }
    waits.try_for_each(|wait| sampler.rest(wait))?;
    Ok(Some((gathering.time(), sampler.end()?)))
}
