//! All strategies on a hole, compared.

use std::f64::consts::TAU;

use serde::Serialize;

use super::HoleTable;
use super::compare;
use super::compare_page::compare_html;
use super::job::job;
use crate::base::{Code, Error, Finding, Result, Silent};
use crate::holes::compare::{Comparison, Limits, Terms, compare as compared};
use crate::holes::entry::chosen;
use crate::holes::{BoreSpec, Entry};
use crate::job::Outputs;
use crate::job::check::Job;
use crate::job::check::control::control;
use crate::job::check::joint::linear_axes;
use crate::job::plan::setting;
use crate::machine::Interpolator;
use crate::motion::Servo;
use crate::operations::Operation;
use crate::operations::bore::spec;
use crate::page::Section;
use crate::verbs::{Answer, page};

/// A compared hole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HoleComparison {
    /// Title.
    pub title: String,
    /// Diameter and depth [mm].
    pub diameter: f64,
    /// Depth [mm].
    pub depth: f64,
    /// All strategies in one plane.
    pub comparison: Comparison,
    /// Remarks for a person.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
}

impl Answer for HoleComparison {
    fn sections(&self) -> Vec<Section> {
        compare::words(self)
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn add_findings(&mut self, findings: Vec<Finding>) {
        self.findings.extend(findings);
    }

    fn files(answers: &[&HoleComparison]) -> Result<Outputs> {
        Ok(page("compare.html", compare_html(answers)))
    }
}

/// Compares all strategies on a hole, in the plane of its first level.
///
/// # Errors
/// As [`plan_hole`](super::plan_hole); `KC0102` when the hole is not roughed.
pub fn compare_hole(table: &HoleTable) -> Result<HoleComparison> {
    let job = job(table)?;
    let [setup] = &job.setups[..] else {
        return Err(Finding::error(Code::JOB_SHAPE, "a hole has one operation").into());
    };
    let Some(Operation::Bore(bore)) = setup.operations.first() else {
        return Err(Finding::error(Code::JOB_SHAPE, "strategies are compared for bores")
            .key("operation.type")
            .into());
    };
    let under = |e: Error| e.under("operation");
    let clamping = setup.at(&bore.milling);
    let spec = spec(&setting(&job, setup, &clamping, 0, &Silent), bore).map_err(under)?;
    spec.check().map_err(under)?;
    let terms = terms(&spec, &job, table)?;
    Ok(HoleComparison {
        title: job.title.clone(),
        diameter: spec.diameter,
        depth: spec.depth,
        comparison: compared(&terms).map_err(under)?,
        findings: Vec::new(),
    })
}

fn terms(spec: &BoreSpec, job: &Job, table: &HoleTable) -> Result<Terms> {
    let rough = spec.rough.as_ref().ok_or_else(|| {
        Finding::error(Code::JOB_SHAPE, "strategies are compared in roughing")
            .help("add rough = { stepover = .., feed = .. }")
            .key("operation.rough")
    })?;
    let step = rough.stepover.ok_or_else(|| {
        Finding::error(Code::JOB_SHAPE, "strategies are compared at one `stepover`")
            .bound_mm(spec.cutter.diameter)
            .help(format!("add stepover = .., up to the cutter's diameter of {} mm", spec.cutter.diameter))
            .key("operation.rough.stepover")
    })?;
    let cutter = spec.cutter_radius();
    let wall = spec.rough_radius(rough, spec.floor()).map_err(|e| e.under("operation.rough"))?;
    let (entry, drilled) = match chosen(spec, rough, wall) {
        Entry::PreDrilled { diameter } => {
            let room = 0.5 * diameter - cutter;
            (if room > 0.0 { room } else { 0.0 }, Some(0.5 * diameter))
        }
        Entry::Helix { radius, .. } => (radius, None),
        Entry::Plunge => (0.0, None),
    };
    machine_terms(
        table,
        Terms {
            entry,
            drilled,
            engagement: rough.engagement.unwrap_or(TAU / 6.0),
            allowance: rough.allowance,
            lead_turns: spec.finish.as_ref().map_or(2, |f| f.turns),
            decimals: job.post.decimals,
            control: job.post.control,
            ..Terms::new(wall, cutter, step, rough.feed)
        },
    )
}

/// Terms with the limits of the axes and the control of a table.
pub(super) fn machine_terms(table: &HoleTable, terms: Terms) -> Result<Terms> {
    let usual = Limits::usual(terms.limits.feed);
    let dynamics = table.dynamics.clone().unwrap_or_default();
    let given = linear_axes(&dynamics)?;
    let control = control(&dynamics)?;
    control.check()?;
    let limits = Limits {
        axis_velocity: given.rapid.unwrap_or(usual.axis_velocity),
        acceleration: given.acceleration.unwrap_or(usual.acceleration),
        jerk: given.jerk.unwrap_or(usual.jerk),
        ..usual
    };
    Ok(Terms {
        limits,
        interpolator: control.interpolator.unwrap_or(Interpolator::JerkLimited),
        tolerance: control.tolerance,
        junction_deviation: control.junction_deviation,
        servo: Servo::new(control.servo_bandwidth.unwrap_or(Terms::USUAL_BANDWIDTH))?,
        ..terms
    })
}
