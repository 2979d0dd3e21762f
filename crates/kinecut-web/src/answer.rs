//! The parts of an answer that plans and simulations share.

use std::collections::BTreeMap;

use kinecut::base::Finding;
use kinecut::job::report::{Report, Scene, ShownSection, facts, scene, shown_sections};
use kinecut::job::{Job, SetupOutcome, sha256};
use kinecut::page::Fact;
use serde::Serialize;
use serde_json::value::RawValue;

use crate::operations::{Run, TextPlaces, ToolShown, runs, tools};

/// A program as the page shows it.
#[derive(Serialize)]
pub(crate) struct ProgramShown<'a> {
    file: &'a str,
    control: &'static str,
    /// Its first line among those of all programs.
    first: usize,
    lines: usize,
    text: &'a str,
    seconds: f64,
    sha256: String,
}

/// What there is to see of a plan or a simulation.
#[derive(Serialize)]
pub(crate) struct Shown<'a> {
    findings: &'a [Finding],
    programs: Vec<ProgramShown<'a>>,
    operations: Vec<Run>,
    tools: Vec<ToolShown<'a>>,
    /// `plan.json`, letter by letter.
    plan: Box<RawValue>,
    facts: Vec<Fact>,
    sections: Vec<ShownSection>,
    drawn_step: Option<f64>,
    scene: SceneShown,
}

/// What the viewer reads.
#[derive(Serialize)]
struct SceneShown {
    head: Box<RawValue>,
    streams: BTreeMap<&'static str, String>,
}

impl<'a> Shown<'a> {
    pub(crate) fn of(
        report: &Report,
        (job, setups, places): (&'a Job, &'a [SetupOutcome], Option<&TextPlaces>),
        findings: &'a [Finding],
        plan: String,
    ) -> Shown<'a> {
        let Scene { head, streams, .. } = scene(report);
        Shown {
            findings,
            programs: programs(job, setups),
            operations: runs(job, setups, places),
            tools: tools(job),
            plan: raw(plan),
            facts: facts(report),
            sections: shown_sections(report),
            drawn_step: report.drawn_step,
            scene: SceneShown { head: raw(head), streams: streams.into_iter().collect() },
        }
    }
}

/// JSON text that stays as it is; `null` for what is none.
pub(crate) fn raw(text: String) -> Box<RawValue> {
    RawValue::from_string(text).unwrap_or_else(|_| RawValue::NULL.to_owned())
}

fn programs<'a>(job: &Job, setups: &'a [SetupOutcome]) -> Vec<ProgramShown<'a>> {
    let mut first = 0;
    let one = setups.iter().map(|done| {
        let text: &str = &done.posted.text;
        let program = ProgramShown {
            file: &done.file,
            control: done.control(job).name(),
            first,
            lines: text.lines().count(),
            text,
            seconds: done.seconds(),
            sha256: sha256(text.as_bytes()),
        };
        first += program.lines;
        program
    });
    one.collect()
}

/// A step at which the stock of a job has few lines [mm]: never finer than that of the job.
pub(crate) fn coarse_step(job: &Job) -> f64 {
    /// Lines of the stock in all three directions.
    const LINES: f64 = 40_000.0;
    /// Lines along the thinnest side of the stock at least.
    const LEAST: f64 = 12.0;
    let size = job.stock.bounds().size();
    let area = size.x * size.y + size.y * size.z + size.z * size.x;
    let few = (area / LINES).sqrt().min(size.min_element() / LEAST);
    // Two digits: a step that a person can read.
    let scale = 10f64.powf(few.log10().floor() - 1.0);
    ((few / scale).round() * scale).max(job.step)
}
