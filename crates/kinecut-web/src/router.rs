//! Routes, behind the gate.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::task::Poll;

use axum::Router;
use axum::body::Body;
use axum::extract::{DefaultBodyLimit, Path, RawQuery, Request, State};
use axum::http::{Response, StatusCode};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::IntoResponse as _;
use axum::routing::{get, post};
use kinecut::job::file;
use kinecut::verbs::envelope::envelope_schema;
use kinecut::verbs::grazing::grazing_schema;
use kinecut::verbs::hole::hole_schema;
use kinecut::verbs::{explain, json_document, schema::Schema};
use serde::{Deserialize, Serialize};

use crate::app::{App, Json};
use crate::connections::Trust;
use crate::gate::Passed;
use crate::lanes::Work;
use crate::refusal::{Refusal, bytes, json};
use crate::work::is_client;
use crate::{files, guess, inspect, kinematics, page, plan, simulate, verb, write};

/// The router of the server.
pub(crate) fn router(app: Arc<App>) -> Router {
    Router::new()
        .route("/", get(page::index))
        .route("/index.html", get(page::index))
        .route("/assets/{*path}", get(page::asset))
        .route("/api/project", get(files::project))
        .route("/api/file", post(files::make))
        .route("/api/file/{id}", get(files::read).put(files::save))
        .route("/api/bytes/{id}", get(files::content))
        .route("/api/schema/{name}", get(schema_of))
        .route("/api/explain/{code}", get(explained))
        .route("/api/events", get(events))
        .route("/api/plan", post(plan::plan))
        .route("/api/simulate", post(simulate::simulate))
        .route("/api/guess", post(guess::guess))
        .route("/api/stop", post(stop))
        .route("/api/inspect", post(inspect::inspect))
        .route("/api/report", post(inspect::report))
        .route("/api/write", post(write::write))
        .route("/api/verb/{name}", post(verb::verb))
        .route("/api/page/{name}", post(verb::page))
        .merge(kinematics::routes())
        .fallback(nothing)
        .method_not_allowed_fallback(wrong_method)
        // Bodies are bounded where they are read.
        .layer(DefaultBodyLimit::disable())
        .layer(from_fn_with_state(Arc::clone(&app), gate))
        .with_state(app)
}

/// Checks every request before it is routed, and gives every answer its headers. A panic of a handler is a defect, not the end.
async fn gate(State(app): State<Arc<App>>, request: Request, next: Next) -> Response<Body> {
    let (head, body) = request.into_parts();
    let mut answer = match app.gate.check(&head) {
        Ok(passed) => {
            if let (Passed::Api, Some(trust)) = (passed, head.extensions.get::<Trust>()) {
                trust.earn();
            }
            catch(next.run(Request::from_parts(head, body))).await
        }
        Err(refusal) => refusal.into_response(),
    };
    page::secure(answer.headers_mut());
    answer
}

/// An answer; where making it panics, that it is a defect.
async fn catch(answer: impl Future<Output = Response<Body>>) -> Response<Body> {
    let mut answer = std::pin::pin!(answer);
    std::future::poll_fn(|context| {
        let polled = catch_unwind(AssertUnwindSafe(|| answer.as_mut().poll(context)));
        polled.unwrap_or_else(|_| Poll::Ready(Refusal::defect().into_answer()))
    })
    .await
}

async fn nothing() -> Refusal {
    Refusal::not_found("there is nothing here")
}

async fn wrong_method() -> Refusal {
    Refusal::new(StatusCode::METHOD_NOT_ALLOWED, "method", "this is asked for in another way")
}

/// `GET /api/schema/NAME`: as `kinecut schema NAME`.
async fn schema_of(Path(name): Path<String>) -> Result<Response<Body>, Refusal> {
    use kinecut::verbs::Answer as _;
    let schema = Schema(match name.as_str() {
        "job" => file::schema(),
        "hole" | "drill" | "face" => hole_schema(),
        "outline" => file::outline_schema(),
        "envelope" => envelope_schema(),
        "grazing" => grazing_schema(),
        "machine" => file::machine_schema(),
        "tools" => file::tools_schema(),
        "cutting" => file::cutting_schema(),
        "surface" => file::surface_schema(),
        "contour" | "tool" => file::contour_schema(),
        _ => return Err(Refusal::not_found("no schema has this name")),
    });
    Ok(bytes(StatusCode::OK, "application/json", schema.data().into_owned()))
}

/// `GET /api/explain/CODE`: as `kinecut explain CODE --json`.
async fn explained(Path(code): Path<String>) -> Response<Body> {
    match explain::page(&code) {
        Ok(page) => bytes(StatusCode::OK, "application/json", json_document(&page)),
        Err(e) => Refusal::finding(StatusCode::NOT_FOUND, &e.0),
    }
}

/// `GET /api/events?client=…`.
async fn events(State(app): State<Arc<App>>, RawQuery(query): RawQuery) -> Result<Response<Body>, Refusal> {
    let client = query.as_deref().and_then(|q| q.strip_prefix("client=")).filter(|word| is_client(word));
    let Some(client) = client else { return Err(Refusal::request("say who listens: ?client=WORD")) };
    if app.events.listening() >= app.limits.connections / 2 {
        return Err(Refusal::new(StatusCode::TOO_MANY_REQUESTS, "busy", "too many pages listen"));
    }
    Ok(app.events.stream(client.to_owned()))
}

/// Work that is no longer wanted.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StopAsked {
    client: String,
    kind: Work,
    file: Option<String>,
}

#[derive(Serialize)]
struct Stopped {
    stopped: usize,
}

/// `POST /api/stop`.
async fn stop(State(app): State<Arc<App>>, Json(asked): Json<StopAsked>) -> Response<Body> {
    let stopped = app.lanes.stop(&asked.client, asked.kind, asked.file.as_deref());
    json(StatusCode::OK, &Stopped { stopped })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handler_that_panics_answers_that_it_is_a_defect() {
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        let answer = runtime.block_on(catch(async { panic!("a defect, on purpose") }));
        assert_eq!(answer.status(), StatusCode::INTERNAL_SERVER_ERROR);
        let body = runtime.block_on(axum::body::to_bytes(answer.into_body(), 1 << 16)).unwrap();
        let said: serde_json::Value = serde_json::from_slice(&body).unwrap();
        assert_eq!((&said["exit"], &said["error"]["reason"]), (&3.into(), &"defect".into()));
    }
}
