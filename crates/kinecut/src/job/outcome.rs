//! What a run has found out, as data.

use super::Foreign;
use super::check::Job;
use super::measure::Measured;
use super::plan::Planned;
use super::read_back::ReadBack;
use super::shape::Deviation;
use super::simulate::Simulation;
use super::verdict::Verdict;
use crate::geom::Mesh;
use crate::nc::{Control, Posted};
use crate::operations::known::Known;
use crate::operations::{Clamping, Operation, OperationPlan, PostedPlan, Shown};
use crate::program::Program;
use crate::stock::Volume;
use crate::trace::Trace;

/// All that a run has found out.
#[derive(Debug)]
pub struct Outcome {
    /// Name of the job file as the user gave it.
    pub job_file: String,
    /// The checked job.
    pub job: Job,
    /// For each setup its program.
    pub setups: Vec<SetupOutcome>,
    /// The cut stock.
    pub simulation: Simulation,
    /// The operations in their order, with what was measured for each.
    pub measured: Vec<Measured>,
    /// Surface of the cut part.
    pub part: Mesh,
    /// What has been removed from the stock, loose cores included.
    pub removed: Volume,
    /// The cut part against the wanted one.
    pub deviation: Deviation,
    /// What was proven, found and not checked.
    pub verdict: Verdict,
}

/// The program of one setup.
#[derive(Debug)]
pub struct SetupOutcome {
    /// Name of the program file.
    pub file: String,
    /// The plan.
    pub planned: Planned,
    /// The text.
    pub posted: Posted,
    /// The plan on the machine.
    pub plan_trace: Trace,
    /// The text as the control reads it.
    pub program: Program,
    /// The text on the machine.
    pub trace: Trace,
    /// How far the text lies from the plan.
    pub read_back: ReadBack,
    /// For each item of `program` its line in the text, 0-based.
    pub lines: Vec<Option<u32>>,
    /// Of a program that others wrote: what reading it has shown. Its text stands in `posted`, nothing is planned.
    pub foreign: Option<Foreign>,
    /// Facts about it that were asked for already.
    pub(crate) known: Known,
}

impl Outcome {
    /// The planned operations of a setup with all that their sections may show; `begins`: for each line of all programs the
    /// time at which it begins [s], and last the time of all; `first_line`: where those of the setup begin.
    pub(crate) fn shown<'a>(
        &'a self,
        setup: usize,
        begins: &'a [f64],
        first_line: u32,
    ) -> Vec<(&'a OperationPlan, Shown<'a>)> {
        let time = |setups: &[SetupOutcome]| setups.iter().map(|s| s.trace.duration().0).sum::<f64>();
        let times = [time(&self.setups[..setup]), time(&self.setups)];
        let posted = self.setups[setup].posted_plan(setup, &self.job.setups[setup]);
        let measured = self.measured.iter().filter(|m| m.setup == setup);
        let one = |m: &'a Measured| {
            let operation = self.setups[setup].planned.operations.get(m.index)?;
            let number = operation.number;
            let shown = Shown {
                number,
                name: self.job.operation(number).map(Operation::name).unwrap_or_default(),
                posted,
                first_line,
                begins,
                time: times,
                rapid: self.job.machine.as_ref().and_then(|m| m.dynamics.rapid),
                points: m.points(&self.simulation),
                walls: self.deviation.bores.iter().filter(|b| b.operation == number).collect(),
                plane: self.deviation.faces.iter().find(|f| f.operation == number),
            };
            Some((&operation.plan, shown))
        };
        measured.filter_map(one).collect()
    }
}

impl SetupOutcome {
    /// The control that runs the program.
    pub fn control(&self, job: &Job) -> Control {
        self.foreign.as_ref().map_or(job.post.control, |f| f.control)
    }

    /// The posted program beside its plan, as operations see it; `index` is that of the setup.
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
