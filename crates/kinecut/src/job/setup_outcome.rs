//! Result of a run for one setup.

use super::check::Job;
use super::external::ExternalProgram;
use super::plan::SetupPlan;
use super::read_back::ReadBack;
use super::simulate::Simulation;
use crate::motion::ProgramTime;
use crate::nc::{Control, Posted};
use crate::operations::known::Known;
use crate::operations::{Clamping, PostedPlan};
use crate::program::Program;
use crate::trace::{Segment, Trace};

/// The program of one setup.
#[derive(Debug)]
pub struct SetupOutcome {
    /// Name of the program file.
    pub file: String,
    /// The plan.
    pub planned: SetupPlan,
    /// The text.
    pub posted: Posted,
    /// The plan on the machine.
    pub plan_trace: Trace,
    /// The text as the control reads it.
    pub program: Program,
    /// The text on the machine.
    pub trace: Trace,
    /// Comparison of the text with the plan.
    pub read_back: ReadBack,
    /// For each item of `program` its line in the text, 0-based.
    pub lines: Vec<Option<u32>>,
    /// Its time under the limits of the machine, if the machine states them.
    pub time: Option<ProgramTime>,
    /// Result of reading a program of others. Its text is in `posted`, nothing is planned.
    pub external: Option<ExternalProgram>,
    /// Facts about it that were asked for already.
    pub(crate) known: Known,
}

impl SetupOutcome {
    /// Time of the program [s]: under the limits of the machine where these are known, else at programmed feeds.
    pub fn seconds(&self) -> f64 {
        self.time.as_ref().map_or_else(|| self.trace.duration().0, ProgramTime::total)
    }

    /// Time of each segment of the trace [s]; 0 where it is not known.
    pub(crate) fn segment_times(&self) -> impl Iterator<Item = f64> {
        let law = self.time.as_ref().map(|time| &time.segments);
        let programmed = |s: &Segment| s.duration.unwrap_or(0.0);
        self.trace
            .segments
            .iter()
            .enumerate()
            .map(move |(i, s)| law.map_or_else(|| programmed(s), |law| law[i]))
    }

    /// The control that runs the program.
    pub fn control(&self, job: &Job) -> Control {
        self.external.as_ref().map_or(job.post.control, |f| f.control)
    }

    /// The posted program with its plan, as operations see it; `index` is that of the setup.
    pub(crate) fn posted_plan<'a>(&'a self, index: usize, clamping: &'a Clamping) -> PostedPlan<'a> {
        PostedPlan {
            index,
            clamping,
            planned: &self.planned.program,
            plan_trace: &self.plan_trace,
            program: &self.program,
            trace: &self.trace,
            lines: &self.lines,
            written_for: &self.posted.lines,
            known: &self.known,
        }
    }

    /// The planned item for which an item of the text was written.
    pub fn planned_item(&self, item: u32) -> Option<u32> {
        let line = self.lines.get(item as usize).copied().flatten()?;
        self.posted.lines.get(line as usize).copied().flatten()
    }

    /// The first line of the text, 0-based, that was written for an item of the plan.
    pub fn line_of_planned(&self, item: u32) -> Option<u32> {
        self.known.line_of(&self.posted.lines, item)
    }
}

/// The setup and item that made a cut.
pub(super) fn block_of_cut(
    setups: &[SetupOutcome],
    simulation: &Simulation,
    cut: u32,
) -> Option<(usize, u32)> {
    let setup = simulation.first_cut.iter().rposition(|&first| cut > first)?;
    let segment = setups[setup].trace.segments.get((cut - simulation.first_cut[setup] - 1) as usize)?;
    Some((setup, segment.item))
}
