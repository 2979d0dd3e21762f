//! A request of work: its place in a lane, its turn, and its answer.

use std::sync::Arc;

use axum::body::Body;
use axum::http::{Response, StatusCode};
use kinecut::base::{Code, Error, Finding};
use serde::{Deserialize, Serialize};

use crate::app::App;
use crate::lanes::{Lane, Work};
use crate::pools::NoResult;
use crate::refusal::{Refusal, bytes, json};
use crate::watch::{Asked, Watch};

/// Longest word by which a page names itself.
const CLIENT: usize = 64;

/// Who asks.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Who {
    /// A word of the page.
    client: String,
    /// The page's own counter, which comes back.
    #[serde(default)]
    generation: u64,
}

/// The end of a piece of work that has no result.
#[derive(Serialize)]
struct Ended<'a> {
    state: &'static str,
    generation: u64,
    seconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a Finding>,
    #[serde(skip_serializing_if = "Option::is_none")]
    findings: Option<[(); 0]>,
}

/// Whether a word may name a page.
pub(crate) fn is_client(word: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    !word.is_empty() && word.len() <= CLIENT && word.chars().all(plain)
}

/// A finished piece of work: its answer, and whether it came to what was asked for.
pub(crate) type Made = Result<Response<Body>, Error>;

/// Does a piece of work about a file; `made` makes its answer on another thread. Its error is an answer too: the text is wrong.
///
/// # Errors
/// Too much waits, it panicked, or nobody asks.
pub(crate) async fn work(
    app: Arc<App>,
    (who, work, file): (Who, Work, String),
    made: impl FnOnce(&App, &Watch) -> Made + Send + 'static,
) -> Result<Response<Body>, Refusal> {
    if !is_client(&who.client) {
        return Err(Refusal::request("`client` is a word of at most 64 letters and digits"));
    }
    let Who { client, generation } = who;
    let ticket = app.lanes.begin(Lane { client: client.clone(), work, file: file.clone() });
    let cancel = Arc::clone(&ticket.cancel);
    let asked = Asked { client, kind: work, file, generation };
    let watch = Arc::new(Watch::new(asked, Arc::clone(&cancel), Arc::clone(&app.events)));
    let doing = {
        let (app, watch) = (Arc::clone(&app), Arc::clone(&watch));
        move || watch.still_wanted().and_then(|()| made(&app, &watch))
    };
    let done = first(app.pools.run(work, doing), cancel.cancelled()).await;
    let (state, answer) = match done {
        None => ("cancelled", Ok(cancelled(&watch))),
        Some(Ok(Ok(answer))) => ("done", Ok(answer)),
        Some(Ok(Err(error))) if error.code() == Code::CANCELLED => ("cancelled", Ok(cancelled(&watch))),
        Some(Ok(Err(error))) => ("wrong", Ok(wrong(&watch, &error))),
        Some(Err(NoResult::Defect)) => ("defect", Err(Refusal::defect())),
        Some(Err(NoResult::Busy)) => {
            let refusal = Refusal::new(StatusCode::TOO_MANY_REQUESTS, "busy", "too many requests wait");
            ("busy", Err(refusal))
        }
    };
    watch.end(state);
    drop(ticket);
    answer
}

/// The first of two: the result of one, or nothing where the other ends before it.
async fn first<T>(one: impl Future<Output = T>, other: impl Future<Output = ()>) -> Option<T> {
    let mut one = std::pin::pin!(one);
    let mut other = std::pin::pin!(other);
    std::future::poll_fn(|context| {
        if let std::task::Poll::Ready(done) = one.as_mut().poll(context) {
            return std::task::Poll::Ready(Some(done));
        }
        other.as_mut().poll(context).map(|()| None)
    })
    .await
}

fn cancelled(watch: &Watch) -> Response<Body> {
    let (generation, seconds) = (watch.asked.generation, watch.seconds());
    if watch.asked.kind == Work::Verb {
        let finding = Finding::error(Code::CANCELLED, "the work was cancelled");
        return verb_answer(kinecut::verbs::json_document(&finding), 2);
    }
    json(StatusCode::OK, &Ended { state: "cancelled", generation, seconds, error: None, findings: None })
}

fn wrong(watch: &Watch, error: &Error) -> Response<Body> {
    let (generation, seconds) = (watch.asked.generation, watch.seconds());
    if watch.asked.kind == Work::Verb {
        return verb_answer(kinecut::verbs::json_document(&*error.0), 2);
    }
    let ended = Ended { state: "wrong", generation, seconds, error: Some(&error.0), findings: Some([]) };
    json(StatusCode::OK, &ended)
}

/// What a verb prints, with its exit code.
pub(crate) fn verb_answer(text: String, exit: u8) -> Response<Body> {
    let mut answer = bytes(StatusCode::OK, "application/json", text);
    answer.headers_mut().insert("kinecut-exit", u16::from(exit).into());
    answer
}
