//! Whether the simulated point meets the stock where the zones say: each hole is measured in the stock as it is before
//! it is drilled.

use super::super::check::Job;
use super::super::outcome::SetupOutcome;
use super::super::simulate::{Probe, Simulation, is_along_axis};
use super::PlannedHole;
use crate::base::{Code, Finding, Severity, at_most};
use crate::drilling::Stage;
use crate::geom::Rigid;
use crate::stock::PointEngagement;

/// Most holes that are measured: a measure of a hole of 20 mm holds 80 kB at a grid of 0.25 mm, half a megabyte at 0.1 mm.
const MOST_PROBES: usize = 500;

/// A measured hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProbedHole {
    /// Index of the setup.
    pub setup: usize,
    /// Number of the operation over all setups.
    pub operation: u32,
    /// Number of the hole in the operation.
    pub hole: usize,
    /// First item of the text that drills it.
    pub item: u32,
}

/// Maps coordinates of an operation's work offset or plane into those of the part.
fn to_part(job: &Job, operation: u32) -> Option<Rigid> {
    let mut all = job.setups.iter().flat_map(|s| s.operations.iter().map(move |o| (s, o)));
    all.nth(operation as usize).map(|(setup, operation)| setup.to_operation(operation).inverse())
}

/// The holes to measure, with the probes that do it.
pub(in crate::job) fn probes(job: &Job, setups: &[SetupOutcome]) -> (Vec<Probe>, Vec<ProbedHole>) {
    let (mut probes, mut probed) = (Vec::new(), Vec::new());
    for (s, done) in setups.iter().enumerate() {
        let items = done.program.items.len() as u32;
        let mut item = 0;
        for drilling in &done.planned.drillings {
            let Some(to_part) = to_part(job, drilling.operation) else { continue };
            if !is_along_axis(to_part.vector(glam::DVec3::Z)) {
                continue;
            }
            for hole in drilling.holes.iter().take(MOST_PROBES) {
                // Items of the text follow those of the plan.
                while item < items && done.planned_item(item).is_none_or(|p| p < hole.first_item) {
                    item += 1;
                }
                if item == items || probes.len() == MOST_PROBES {
                    break;
                }
                let at = to_part.point(glam::DVec3::new(hole.at[0], hole.at[1], hole.zero));
                let out = to_part.vector(glam::DVec3::Z);
                probes.push(Probe { setup: s, item, at, out, edge: hole.plan.edge });
                let (operation, hole) = (drilling.operation, hole.number);
                probed.push(ProbedHole { setup: s, operation, hole, item });
            }
        }
    }
    (probes, probed)
}

/// Height of the reference point along the measured axis where the plan's Z is 0 [mm].
pub(in crate::job) fn zero_height(
    job: &Job,
    probed: &ProbedHole,
    hole: &PlannedHole,
    measured: &PointEngagement,
) -> f64 {
    measured.height(
        to_part(job, probed.operation)
            .unwrap_or(Rigid::IDENTITY)
            .point(glam::DVec3::new(hole.at[0], hole.at[1], hole.zero)),
    )
}

/// What measuring the holes has shown.
#[derive(Clone, Debug, Default)]
pub(in crate::job) struct ZonesProof {
    /// Findings, each with the setup and the item of the text.
    pub(in crate::job) findings: Vec<(Finding, usize, u32)>,
    /// What was proven, with its bound.
    pub(in crate::job) proven: Option<(String, String)>,
    /// Holes that were not measured.
    pub(in crate::job) unmeasured: usize,
}

/// Compares the measured engagement with the zones.
pub(in crate::job) fn judge(
    job: &Job,
    setups: &[SetupOutcome],
    probed: &[ProbedHole],
    simulation: &Simulation,
) -> ZonesProof {
    let mut proof = ZonesProof::default();
    let (mut good, mut worst) = (0usize, 0.0f64);
    for (probe, measured) in probed.iter().zip(&simulation.engagements) {
        let drillings = &setups[probe.setup].planned.drillings;
        let of = drillings.iter().filter(|d| d.operation == probe.operation).flat_map(|d| &d.holes);
        let Some(hole) = of.into_iter().find(|h| h.number == probe.hole) else { continue };
        let zero = zero_height(job, probe, hole, measured);
        match mismatch(hole, measured, zero, job.step) {
            Some(finding) => {
                let [x, y] = hole.at;
                let finding = Finding {
                    message: format!("hole {} at X{x} Y{y}: {}", hole.number + 1, finding.message),
                    ..finding
                };
                proof.findings.push((finding, probe.setup, probe.item));
            }
            None => {
                good += 1;
                let exact = hole.plan.entry.first - hole.spec.tolerance;
                let late = measured.first().map_or(0.0, |z| exact - (z - zero));
                worst = worst.max(late.abs());
            }
        }
    }
    if good > 0 && proof.findings.is_empty() {
        let holes = if good == 1 { "1 drilled hole".to_owned() } else { format!("{good} drilled holes") };
        proof.proven = Some((
            format!(
                "{holes}: nothing of the point enters material outside of its entry zones or leaves it outside of its exit zones, and through holes end in air"
            ),
            format!(
                "columns of the stock, {} mm between them; first contact found {} mm from the computed Z",
                job.step,
                at_most(worst, 3)
            ),
        ));
    }
    let planned: usize = setups.iter().flat_map(|s| &s.planned.drillings).map(|d| d.holes.len()).sum();
    proof.unmeasured = planned - probed.len();
    proof
}

/// What is wrong with a hole's zones: the point meets or leaves material where the plan says that nothing changes.
fn mismatch(hole: &PlannedHole, measured: &PointEngagement, zero: f64, step: f64) -> Option<Finding> {
    let finding = |z: f64, what: &str| {
        let f = Finding::error(Code::DRILL_ZONES, what.to_owned()).value(z + hole.zero, "mm (Z)");
        f.cure("give the surfaces of the stock as it is then, or change the order of the operations")
    };
    let Some(first) = measured.first() else {
        return (measured.columns() > 0)
            .then(|| finding(hole.plan.entry.first, "the point meets no material"));
    };
    let start = hole.plan.travel.start;
    if first - zero > start {
        return Some(finding(first - zero, "material begins above the start of the hole"));
    }
    for zone in &hole.plan.zones {
        // Where the stock is a mesh or a grid of columns, borders are known to a step.
        let (from, to) = (zone.from - step + zero, zone.to + step + zero);
        if from <= to {
            continue;
        }
        let (begins, ends) = (measured.first_start(from, to), measured.first_end(from, to));
        let (begins, ends) = match zone.stage {
            Stage::Entry => (None, ends),
            Stage::Exit => (begins, None),
            Stage::Mixed => continue,
            Stage::Steady | Stage::Partial | Stage::Air => (begins, ends),
        };
        if let Some(z) = begins {
            let late = finding(
                z - zero,
                "a part of the point meets material later than planned, at the feed of a later zone",
            );
            // Into a recess that was not described; a danger for the edge, not for the machine.
            let severity = if zone.stage == Stage::Steady { Severity::Warning } else { Severity::Error };
            return Some(Finding { severity, ..late });
        }
        if let Some(z) = ends {
            return Some(finding(z - zero, "material ends where the plan goes on in it"));
        }
        let engaged = measured.share(0.5 * (from + to)) > 0.0;
        match (zone.stage, engaged) {
            (Stage::Air, true) => {
                return Some(finding(0.5 * (from + to) - zero, "there is material where the plan has air"));
            }
            (Stage::Steady | Stage::Partial, false) => {
                return Some(finding(0.5 * (from + to) - zero, "there is no material in a steady zone"));
            }
            _ => {}
        }
    }
    let end = hole.plan.travel.end;
    if hole.plan.exit.is_some() && measured.engaged(end + zero) > 0 {
        return Some(finding(end, "the hole does not go through: there is material at its end"));
    }
    None
}
