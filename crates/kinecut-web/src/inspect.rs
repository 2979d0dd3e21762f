//! `POST /api/inspect`, `POST /api/report`: questions about a simulation that is kept.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Response, StatusCode};
use kinecut::job::{InspectWants, Inspection, SectionPlane, report};
use serde::Deserialize;

use crate::app::{App, Json};
use crate::lanes::Work;
use crate::pools::NoResult;
use crate::refusal::{Refusal, bytes};
use crate::results::Kept;

/// Sections, points and distances that are asked for.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InspectAsked {
    result: String,
    #[serde(default)]
    sections: Vec<String>,
    #[serde(default)]
    points: Vec<[f64; 3]>,
    #[serde(default)]
    measures: Vec<[f64; 6]>,
}

/// Most sections, points and distances of a request.
const MOST: usize = 1000;

/// `inspection.json` of a kept result.
pub(crate) async fn inspect(
    State(app): State<Arc<App>>,
    Json(asked): Json<InspectAsked>,
) -> Result<Response<Body>, Refusal> {
    let kept = kept(&app, &asked.result)?;
    let most = asked.sections.len().max(asked.points.len()).max(asked.measures.len());
    let numbers = asked.points.iter().flatten().chain(asked.measures.iter().flatten());
    if most > MOST || !numbers.copied().all(|v: f64| v.abs() <= kinecut::base::MAX_LENGTH) {
        return Err(Refusal::request(format!("at most {MOST} of each, with bounded numbers")));
    }
    let planes = asked.sections.iter().map(|text| text.parse::<SectionPlane>());
    let sections = match planes.collect::<Result<Vec<_>, _>>() {
        Ok(sections) => sections,
        Err(e) => return Ok(Refusal::finding(StatusCode::BAD_REQUEST, &e.0)),
    };
    let wants = InspectWants {
        sections,
        points: asked.points.iter().map(|p| (*p).into()).collect(),
        measures: asked
            .measures
            .iter()
            .map(|[a, b, c, u, v, w]| [[*a, *b, *c].into(), [*u, *v, *w].into()])
            .collect(),
    };
    let made = move || Inspection::of(&kept.outcome, &wants).map(|i| i.map(|i| i.to_json()));
    match done(app.pools.run(Work::Verb, made).await)? {
        Ok(text) => {
            Ok(bytes(StatusCode::OK, "application/json", text.unwrap_or_else(|| "null\n".to_owned())))
        }
        Err(e) => Ok(Refusal::finding(StatusCode::BAD_REQUEST, &e.0)),
    }
}

/// A report that is asked for.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReportAsked {
    result: String,
}

/// `report.html` of a kept result.
pub(crate) async fn report(
    State(app): State<Arc<App>>,
    Json(asked): Json<ReportAsked>,
) -> Result<Response<Body>, Refusal> {
    let kept = kept(&app, &asked.result)?;
    let page = done(app.pools.run(Work::Verb, move || report::html(&kept.report)).await)?;
    Ok(bytes(StatusCode::OK, "text/html; charset=utf-8", page))
}

fn kept(app: &App, name: &str) -> Result<Arc<Kept>, Refusal> {
    let gone = || {
        Refusal::new(StatusCode::NOT_FOUND, "gone", "this result is no longer kept").help("simulate again")
    };
    app.results.get(name).ok_or_else(gone)
}

fn done<T>(made: Result<T, NoResult>) -> Result<T, Refusal> {
    made.map_err(|no| match no {
        NoResult::Busy => Refusal::new(StatusCode::TOO_MANY_REQUESTS, "busy", "too many requests wait"),
        NoResult::Defect => Refusal::defect(),
    })
}
