//! `POST /api/simulate`: a job, or a program that others wrote, cut and judged.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Response, StatusCode};
use kinecut::base::{Loader, Result as Found, Sources};
use kinecut::job::report::of_job;
use kinecut::job::{
    JobText, Outcome, PartSurface, RunWants, StockWants, check, plan_json, run_with, simulate_given,
};
use kinecut::verbs::json_document;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::answer::{Shown, coarse_step, raw};
use crate::app::{App, Json};
use crate::given::{GivenFiles, GivenWants};
use crate::kind::Kind;
use crate::lanes::Work;
use crate::operations::TextPlaces;
use crate::refusal::{Refusal, json};
use crate::rest::Rest;
use crate::results::Kept;
use crate::texts::{About, Texts};
use crate::watch::Watch;
use crate::work::{Who, work};

/// A simulation that is asked for.
#[derive(Deserialize)]
pub(crate) struct SimulateAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    given: GivenWants,
    #[serde(flatten)]
    wants: Wants,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
struct Wants {
    step: Option<Step>,
    playback: Option<bool>,
    /// The surface of all lines, which sections and measures need; without it that of a picture.
    #[serde(default)]
    full: bool,
    #[serde(default)]
    compare: bool,
}

/// Distance of the lines of the stock model.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
enum Step {
    Word(StepWord),
    Length(f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum StepWord {
    Coarse,
    Job,
}

impl Wants {
    fn is_coarse(&self) -> bool {
        matches!(self.step, Some(Step::Word(StepWord::Coarse)))
    }

    /// Settings of the simulation; `coarse` is the step of a coarse one.
    fn settings(&self, coarse: impl FnOnce() -> Found<f64>) -> Found<StockWants> {
        let step = match self.step {
            Some(Step::Word(StepWord::Coarse)) => Some(coarse()?),
            Some(Step::Length(step)) => Some(step),
            Some(Step::Word(StepWord::Job)) | None => None,
        };
        Ok(StockWants {
            step,
            playback: self.playback.unwrap_or(!self.is_coarse()),
            engagement: self.is_coarse().then_some(false),
            surface: if self.full { PartSurface::Full } else { PartSurface::Picture },
            ..StockWants::default()
        })
    }
}

#[derive(Serialize)]
struct Simulated<'a> {
    state: &'static str,
    generation: u64,
    seconds: f64,
    step: f64,
    coarse: bool,
    result: &'a str,
    verdict: Box<RawValue>,
    guessed: &'a [String],
    #[serde(flatten)]
    shown: Shown<'a>,
}

/// Cuts a job or a program.
pub(crate) async fn simulate(
    State(app): State<Arc<App>>,
    Json(asked): Json<SimulateAsked>,
) -> Result<Response<Body>, Refusal> {
    asked.rest.is_empty()?;
    let texts = asked.about.texts(&app)?;
    let given = asked.given.files(&app)?;
    let wants = asked.wants;
    let id = texts.id();
    work(app, (asked.who, Work::Simulate, id), move |app, watch| {
        let (outcome, guessed, places) = match texts.kind {
            Kind::Program => {
                let (outcome, guessed) = of_program(app, (&texts, &given), &wants, watch)?;
                (outcome, guessed, None)
            }
            _ => {
                let (outcome, places) = of_job_text(app, &texts, &wants, watch)?;
                (outcome, Vec::new(), Some(places))
            }
        };
        watch.still_wanted()?;
        let report = of_job(&outcome);
        let kept = Kept { outcome, report };
        let answer = answer(app, kept, (&guessed, places.as_ref()), wants.is_coarse(), watch);
        watch.still_wanted()?;
        Ok(answer)
    })
    .await
}

/// The answer; what it shows is kept for questions about it.
fn answer(
    app: &App,
    kept: Kept,
    (guessed, places): (&[String], Option<&TextPlaces>),
    coarse: bool,
    watch: &Watch,
) -> Response<Body> {
    let of = (watch.asked.client.clone(), watch.asked.file.clone());
    let (result, kept) = app.results.keep(of, kept);
    let Kept { outcome, report } = &*kept;
    let about = (&outcome.job, &outcome.setups[..], places);
    let shown = Shown::of(report, about, &outcome.verdict.found, plan_json(outcome));
    json(
        StatusCode::OK,
        &Simulated {
            state: "done",
            generation: watch.asked.generation,
            seconds: watch.seconds(),
            step: outcome.job.step,
            coarse,
            result: &result,
            verdict: raw(json_document(&outcome.verdict)),
            guessed,
            shown,
        },
    )
}

fn of_job_text(app: &App, texts: &Texts, wants: &Wants, watch: &Watch) -> Found<(Outcome, TextPlaces)> {
    let disk = app.folder.beside(&texts.name);
    let loader = texts.over(&disk, &texts.name);
    let text = texts.text(app)?;
    let stock = wants.settings(|| coarse_of(&texts.name, &text, &loader))?;
    let wants = RunWants { compare: wants.compare, stock };
    let outcome = run_with(&texts.name, &text, &wants, &loader, watch)?;
    Ok((outcome, TextPlaces::read(&texts.name, &text, &loader)?))
}

/// The coarse step of a job's text.
fn coarse_of(name: &str, text: &str, loader: &dyn Loader) -> Found<f64> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    let job_text = JobText::read(&mut sources, id, loader)?;
    let job = check(&job_text.file, "program", loader).map_err(|e| job_text.locate(&sources, e))?;
    Ok(coarse_step(&job))
}

fn of_program(
    app: &App,
    (texts, given): (&Texts, &GivenFiles),
    wants: &Wants,
    watch: &Watch,
) -> Found<(Outcome, Vec<String>)> {
    let (mut job, guessed) = given.job(app, texts, true)?;
    let mut stock = wants.settings(|| Ok(coarse_step(job.job())))?;
    given.design(app, &mut stock)?;
    job.simulated(&stock)?;
    Ok((simulate_given(job, watch)?, guessed))
}
