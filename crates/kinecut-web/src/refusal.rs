//! A request that is refused: status, reason in one word, and a finding in words.

use axum::body::Body;
use axum::http::{Response, StatusCode, header};
use kinecut::base::Finding;
use serde::Serialize;

/// The reason why a request is refused.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    status: StatusCode,
    reason: &'static str,
    message: String,
    help: String,
}

/// The body of a refusal.
#[derive(Serialize)]
struct Refused<'a> {
    error: Said<'a>,
    exit: u8,
}

/// What an answer says of a refusal.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum Said<'a> {
    /// A refusal of the server.
    Words { severity: &'static str, message: &'a str, help: &'a str, reason: &'a str },
    /// One of the library.
    Finding(&'a Finding),
}

impl Refusal {
    pub(crate) fn new(status: StatusCode, reason: &'static str, message: impl Into<String>) -> Refusal {
        Refusal { status, reason, message: message.into(), help: String::new() }
    }

    #[must_use]
    pub(crate) fn help(mut self, help: impl Into<String>) -> Refusal {
        self.help = help.into();
        self
    }

    /// A request that cannot be understood.
    pub(crate) fn request(message: impl Into<String>) -> Refusal {
        Refusal::new(StatusCode::BAD_REQUEST, "request", message)
    }

    /// Something that is not there.
    pub(crate) fn not_found(message: impl Into<String>) -> Refusal {
        Refusal::new(StatusCode::NOT_FOUND, "not-found", message)
    }

    /// A defect of kinecut.
    pub(crate) fn defect() -> Refusal {
        let message = format!("this is a defect of kinecut {}", kinecut::VERSION);
        Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "defect", message)
            .help("please report it with the job file; the message of the panic is on the terminal")
    }

    /// A fault of the system or of a file, in the words of the library.
    pub(crate) fn finding(status: StatusCode, finding: &Finding) -> Response<Body> {
        json(status, &Refused { error: Said::Finding(finding), exit: 2 })
    }

    /// Its answer.
    pub(crate) fn into_answer(self) -> Response<Body> {
        let exit = if self.status == StatusCode::INTERNAL_SERVER_ERROR { 3 } else { 2 };
        json(self.status, &Refused { error: self.said(), exit })
    }

    /// What its answer says, for an answer that says more.
    pub(crate) fn said(&self) -> Said<'_> {
        Said::Words { severity: "error", message: &self.message, help: &self.help, reason: self.reason }
    }
}

impl axum::response::IntoResponse for Refusal {
    fn into_response(self) -> Response<Body> {
        self.into_answer()
    }
}

/// A JSON document as an answer.
pub(crate) fn json(status: StatusCode, value: &impl Serialize) -> Response<Body> {
    match serde_json::to_vec(value) {
        Ok(text) => bytes(status, "application/json", text),
        // Plain data always serialise.
        Err(_) => bytes(StatusCode::INTERNAL_SERVER_ERROR, "application/json", Vec::new()),
    }
}

/// Bytes as an answer.
pub(crate) fn bytes(status: StatusCode, kind: &'static str, body: impl Into<Body>) -> Response<Body> {
    let mut answer = Response::new(body.into());
    *answer.status_mut() = status;
    answer.headers_mut().insert(header::CONTENT_TYPE, header::HeaderValue::from_static(kind));
    answer
}
