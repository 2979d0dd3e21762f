//! The motion of all programs, one after the other.

use super::Timed;
use super::moving::MovingProgram;
use crate::base::{Progress, Result};
use crate::motion::{MotionSample, SampledMotion, program_samples};
use crate::page;

/// A sample of one of several programs.
pub(super) struct InOrder<'a> {
    pub(super) program: &'a MovingProgram,
    /// Number of the program, from 1.
    pub(super) number: usize,
    /// Line of the program, from 1.
    pub(super) line: Option<u32>,
    /// Time of the programs before it [s].
    pub(super) before: f64,
    pub(super) sample: &'a MotionSample,
}

impl Timed {
    /// Hands the motion at a cycle [s] to `sink`; the extent of all programs together.
    ///
    /// # Errors
    /// `KC0404` for a cycle that is not positive, `KC0009` when it was cancelled, those of `sink`.
    pub(super) fn in_order(
        &self,
        cycle: f64,
        stage: &str,
        progress: &dyn Progress,
        sink: &mut dyn FnMut(&InOrder) -> Result<()>,
    ) -> Result<SampledMotion> {
        let moves: usize = self.programs.iter().map(|(program, _)| program.trace.segments.len()).sum();
        progress.stage(stage, moves as u64);
        let mut all = SampledMotion::default();
        for (i, (program, _)) in self.programs.iter().enumerate() {
            let before = all.time;
            let mut one = |sample: &MotionSample| {
                let line = program.line(sample.item).map(|line| line + 1);
                sink(&InOrder { program, number: i + 1, line, before, sample })
            };
            let (text, trace) = (&program.program, &program.trace);
            let own = program_samples(text, trace, &self.machine, cycle, progress, &mut one)?;
            let own = own.map_or_else(SampledMotion::default, |(_, own)| own);
            all.count += own.count;
            all.time += own.time;
            all.left_out += own.left_out;
            all.left_out_time += own.left_out_time;
            all.jumps += own.jumps;
        }
        Ok(all)
    }

    /// Whether accelerations jump somewhere: jerk is not limited, or not on all moves.
    pub(super) fn accelerations_jump(&self) -> bool {
        self.programs.iter().any(|(_, time)| !time.limits_jerk || time.jerk_left_out > 0)
    }
}

/// Parts of the motion that samples do not show, in words.
pub(super) fn gaps(moves_left_out: usize, time_left_out: f64, jumps: usize) -> Vec<String> {
    let mut gaps = Vec::new();
    if moves_left_out > 0 {
        let (are, time) = (if moves_left_out == 1 { "move" } else { "moves" }, page::duration(time_left_out));
        gaps.push(format!("{moves_left_out} {are} of {time} have no samples: no law was found for them"));
    }
    if jumps > 0 {
        let places = if jumps == 1 { "place" } else { "places" };
        gaps.push(format!("the axes jump at {jumps} {places}: what is between could not be followed"));
    }
    gaps
}
