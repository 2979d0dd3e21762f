//! The verbs about surfaces, layouts and machines: `surface`, `layouts`, `machine`, `fk`, `ik`.
//!
//! Flags are keys of the request. Machines and surfaces are files of the folder by their identifiers, or those that
//! kinecut knows by name: no request names a path.

mod layouts;
mod machine;
mod poses;
mod surface;

use std::sync::Arc;

use axum::Router;
use axum::body::Body;
use axum::extract::State;
use axum::http::{Response, StatusCode};
use axum::routing::post;
use kinecut::base::{Code, Finding, Result as Found, Severity};
use kinecut::job::machine::{LoadOptions, Loaded, load};
use kinecut::machine::Machine;
use kinecut::verbs::{Answer, Answers};
use serde::Deserialize;

use self::poses::Chain;
use crate::app::{App, Json};
use crate::folder::split;
use crate::refusal::{Refusal, bytes};
use crate::texts::Texts;
use crate::work::{Made, verb_answer};

/// Form of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// As `--json` prints it.
    Json,
    /// The page that `--out` writes.
    Page,
    /// The drawing that `--svg` writes.
    Drawing,
}

type Answered = Result<Response<Body>, Refusal>;

/// The routes of these verbs.
pub(crate) fn routes() -> Router<Arc<App>> {
    let mut router = Router::new()
        .route("/api/verb/fk", post(|State(app), Json(asked)| poses::poses(app, asked, Chain::Forward)))
        .route("/api/verb/ik", post(|State(app), Json(asked)| poses::poses(app, asked, Chain::Inverse)))
        .route("/api/verb/machinefile", post(|State(app), Json(asked)| machine::machine_file(app, asked)));
    for (path, form) in [("verb", Form::Json), ("page", Form::Page), ("drawing", Form::Drawing)] {
        let surface = move |State(app), Json(asked)| surface::surface(app, asked, form);
        let layouts = move |State(app), Json(asked)| layouts::layouts(app, asked, form);
        let machine = move |State(app), Json(asked)| machine::machine(app, asked, form);
        router = router
            .route(&format!("/api/{path}/surface"), post(surface))
            .route(&format!("/api/{path}/layouts"), post(layouts));
        // A machine has no page.
        if form != Form::Page {
            router = router.route(&format!("/api/{path}/machine"), post(machine));
        }
    }
    router
}

/// Answers of one form about one name follow one another.
fn lane(form: Form, parts: &[&str]) -> String {
    let form = match form {
        Form::Json => "verb",
        Form::Page => "page",
        Form::Drawing => "drawing",
    };
    let mut lane = format!("{form} {}", parts.join(" "));
    // Long enough to tell questions apart, short enough to be kept.
    lane.truncate((0..=200).rev().find(|&n| lane.is_char_boundary(n)).unwrap_or(0));
    lane
}

/// One answer in its form.
fn answered<A: Answer>(form: Form, one: Found<A>) -> Made {
    match form {
        Form::Json => {
            let mut answers = Answers::new(false, Severity::Doubt);
            let text = answers.json(one.as_ref());
            Ok(verb_answer(text + answers.json_end(), answers.exit_code()))
        }
        Form::Drawing => Ok(bytes(StatusCode::OK, "image/svg+xml", one?.svg()?)),
        Form::Page => {
            let files = A::files(&[&one?])?;
            let page = files.files().find(|(name, _)| name.ends_with(".html"));
            let none = || Finding::error(Code::JOB_SHAPE, "there is no page of this");
            Ok(bytes(StatusCode::OK, "text/html; charset=utf-8", page.ok_or_else(none)?.1.to_vec()))
        }
    }
}

/// A machine by the identifier of its file or by its name, and what a configuration does not tell of it.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
struct MachineNamed {
    machine: Option<String>,
    code: Option<String>,
}

/// Longest name of a surface, a machine, a code [bytes]: errors quote it.
const LONGEST_NAME: usize = 200;

/// Refuses a name that is longer than any.
fn short(key: &str, name: Option<&String>) -> Result<(), Refusal> {
    match name {
        Some(name) if name.len() > LONGEST_NAME => {
            Err(Refusal::request(format!("`{key}` is longer than {LONGEST_NAME} bytes")))
        }
        _ => Ok(()),
    }
}

impl MachineNamed {
    fn is_short(&self) -> Result<(), Refusal> {
        short("machine", self.machine.as_ref())?;
        short("code", self.code.as_ref())
    }

    /// The machine of a file of the folder, as it is edited; or a known one.
    ///
    /// # Errors
    /// `KC1117` for a name that is neither; those of reading it.
    fn load(&self, app: &App, texts: &Texts) -> Found<Loaded> {
        let id = self.machine.as_deref().unwrap_or_default();
        let Ok(file) = app.file(id) else {
            return Ok(Loaded { machine: Machine::preset(id)?, import: None });
        };
        let disk = app.folder.beside(&file.name);
        let options = LoadOptions { code: self.code.clone(), ..LoadOptions::default() };
        load(split(&file.name).1, &file.name, &options, &texts.over(&disk, &file.name))
    }
}
