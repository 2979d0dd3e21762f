//! What a run has found out, as data.

use super::check::Job;
use super::drill::zero_height;
use super::known::{Firsts, Known};
use super::plan::Planned;
use super::read_back::ReadBack;
use super::shape::Deviation;
use super::simulate::Simulation;
use super::verdict::Verdict;
use super::{Foreign, PlannedHole, ProbedHole, SimulatedFace};
use crate::geom::Mesh;
use crate::nc::{Control, Posted};
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
    /// The drilled holes that were measured, in the order of the simulation's engagements.
    pub probed: Vec<ProbedHole>,
    /// The exits of milled faces as simulated.
    pub faces: Vec<SimulatedFace>,
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
    pub(super) known: Known,
}

impl Outcome {
    /// A planned hole with what was measured of it, if it was: share of the point in material over the plan's Z [mm],
    /// falling, at this many places.
    pub fn engagement(&self, operation: u32, hole: &PlannedHole, places: u32) -> Vec<[f64; 2]> {
        let found = self.probed.iter().position(|p| p.operation == operation && p.hole == hole.number);
        let Some((probe, measured)) =
            found.and_then(|i| Some((&self.probed[i], self.simulation.engagements.get(i)?)))
        else {
            return Vec::new();
        };
        let zero = zero_height(&self.job, probe, hole, measured);
        let (from, to) = (hole.plan.travel.start, hole.plan.travel.end);
        (0..=places)
            .map(|i| {
                let z = from + (to - from) * f64::from(i) / f64::from(places);
                [z, measured.share(z + zero)]
            })
            .collect()
    }
}

impl SetupOutcome {
    /// The control that runs the program.
    pub fn control(&self, job: &Job) -> Control {
        self.foreign.as_ref().map_or(job.post.control, |f| f.control)
    }

    /// The planned item for which an item of the text was written.
    pub fn planned_item(&self, item: u32) -> Option<u32> {
        let line = self.lines.get(item as usize).copied().flatten()?;
        self.posted.lines.get(line as usize).copied().flatten()
    }

    /// The first line of the text, 0-based, that was written for an item of the plan.
    pub fn line_of_planned(&self, item: u32) -> Option<u32> {
        // Items are written in their order, so their lines ascend; lines without an item count as the item before.
        let lines = self.known.lines.get_or_init(|| Firsts::of(self.posted.lines.iter().copied()));
        let (line, first) = lines.reaching(item)?;
        (first == item).then_some(line)
    }

    /// The first item of the text that was written for this item of the plan or a later one.
    pub(super) fn item_after_planned(&self, item: u32) -> Option<u32> {
        let all = || (0..self.program.items.len() as u32).map(|i| self.planned_item(i));
        let items = self.known.items.get_or_init(|| Firsts::of(all()));
        items.reaching(item).map(|(of_text, _)| of_text)
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
