//! `POST /api/guess`: a job about a program that comes alone, with stock and tools as they are guessed, to be corrected.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Response, StatusCode};
use serde::{Deserialize, Serialize};

use crate::app::{App, Json};
use crate::given::GivenWants;
use crate::lanes::Work;
use crate::refusal::{Refusal, json};
use crate::rest::Rest;
use crate::texts::About;
use crate::work::{Who, work};

/// A guess that is asked for.
#[derive(Deserialize)]
pub(crate) struct GuessAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    given: GivenWants,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Serialize)]
struct Guessed {
    state: &'static str,
    generation: u64,
    seconds: f64,
    /// The text of the job, for a file beside the program.
    job: String,
}

/// Guesses a job.
pub(crate) async fn guess(
    State(app): State<Arc<App>>,
    Json(asked): Json<GuessAsked>,
) -> Result<Response<Body>, Refusal> {
    asked.rest.is_empty()?;
    let texts = asked.about.texts(&app)?;
    let given = asked.given.files(&app)?;
    let id = texts.id();
    work(app, (asked.who, Work::Guess, id), move |app, watch| {
        let job = given.guessed_job(app, &texts)?;
        let (generation, seconds) = (watch.asked.generation, watch.seconds());
        Ok(json(StatusCode::OK, &Guessed { state: "done", generation, seconds, job }))
    })
    .await
}
