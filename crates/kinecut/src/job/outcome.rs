//! Result of a run, as data.

use super::check::Job;
use super::measure::Measured;
use super::setup_outcome::SetupOutcome;
use super::shape::Deviation;
use super::simulate::Simulation;
use super::verdict::Verdict;
use crate::geom::Mesh;
use crate::operations::{OperationPlan, Shown};
use crate::stock::{CutId, Volume};

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
    /// Surface of the cut part; empty where none was wanted, see [`StockWants::surface`](super::StockWants::surface).
    pub part: Mesh,
    /// For each triangle of it the cut that made it, 0 for the raw stock; see [`Simulation::first_cut`].
    pub part_cuts: Vec<CutId>,
    /// Distance of the lines that the surface is made of, where these are not all of the stock model [mm]: then it is for pictures only.
    pub drawn_step: Option<f64>,
    /// Material removed from the stock, loose cores included.
    pub removed: Volume,
    /// The cut part against the wanted one.
    pub deviation: Deviation,
    /// Claims proven, findings, and items not checked.
    pub verdict: Verdict,
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
        let time = |setups: &[SetupOutcome]| setups.iter().map(SetupOutcome::seconds).sum::<f64>();
        let times = [time(&self.setups[..setup]), time(&self.setups)];
        let posted = self.setups[setup].posted_plan(setup, &self.job.setups[setup]);
        let measured = self.measured.iter().filter(|m| m.setup == setup);
        let one = |m: &'a Measured| {
            let operation = self.setups[setup].planned.operations.get(m.index)?;
            let number = operation.number;
            let shown = Shown {
                number,
                name: self.job.operation_name(number),
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
