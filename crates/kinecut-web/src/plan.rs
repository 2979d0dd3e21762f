//! `POST /api/plan`: a job planned and posted, a program read and followed; nothing is cut.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Response, StatusCode};
use kinecut::job::report::of_draft;
use kinecut::job::{Draft, draft_json};
use kinecut::verbs::check::program_sheet;
use kinecut::verbs::json_document;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::answer::{Shown, coarse_step, raw};
use crate::app::{App, Json};
use crate::given::GivenWants;
use crate::kind::Kind;
use crate::lanes::Work;
use crate::operations::TextPlaces;
use crate::refusal::{Refusal, json};
use crate::rest::Rest;
use crate::texts::About;
use crate::work::{Who, work};

/// A plan that is asked for.
#[derive(Deserialize)]
pub(crate) struct PlanAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    given: GivenWants,
    /// Without the time under the limits of the machine, which takes longer than all else.
    #[serde(default)]
    quick: bool,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Serialize)]
struct Planned<'a> {
    state: &'static str,
    generation: u64,
    seconds: f64,
    /// Whether the times are those of the programmed feeds.
    quick: bool,
    step: f64,
    coarse_step: f64,
    #[serde(flatten)]
    shown: Shown<'a>,
    /// Of a program of others: as `kinecut check` prints it.
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<Box<RawValue>>,
}

/// Plans a job, or follows a program.
pub(crate) async fn plan(
    State(app): State<Arc<App>>,
    Json(asked): Json<PlanAsked>,
) -> Result<Response<Body>, Refusal> {
    asked.rest.is_empty()?;
    let texts = asked.about.texts(&app)?;
    let given = asked.given.files(&app)?;
    let (id, quick) = (texts.id(), asked.quick);
    work(app, (asked.who, Work::Plan, id), move |app, watch| {
        let (mut draft, check, places) = match texts.kind {
            Kind::Program => {
                let (of_check, _) = given.job(app, &texts, false)?;
                let sheet = program_sheet(&of_check)?;
                // Stock and tools that nobody gave are guessed, so that there is something to see.
                let (given, _) = given.job(app, &texts, true)?;
                (Draft::of_given(given, watch)?, Some(raw(json_document(&sheet))), None)
            }
            _ => {
                let disk = app.folder.beside(&texts.name);
                let loader = texts.over(&disk, &texts.name);
                let text = texts.text(app)?;
                let draft = Draft::of(&texts.name, &text, &loader, watch)?;
                (draft, None, Some(TextPlaces::read(&texts.name, &text, &loader)?))
            }
        };
        if !quick {
            draft.take_times(watch)?;
        }
        watch.still_wanted()?;
        let report = of_draft(&draft);
        let about = (&draft.job, &draft.setups[..], places.as_ref());
        let shown = Shown::of(&report, about, &report.findings, draft_json(&draft));
        Ok(json(
            StatusCode::OK,
            &Planned {
                state: "done",
                generation: watch.asked.generation,
                seconds: watch.seconds(),
                quick,
                step: draft.job.step,
                coarse_step: coarse_step(&draft.job),
                shown,
                check,
            },
        ))
    })
    .await
}
