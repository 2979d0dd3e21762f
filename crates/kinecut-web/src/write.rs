//! `POST /api/write`: a job run as it is on disk, and its files written beside it.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Response, StatusCode};
use kinecut::base::{Code, DiskLoader, FilesRead, Finding, Loader as _};
use kinecut::job::RunWants;
use kinecut::verbs::json_document;
use kinecut::verbs::run::{ResultFiles, run_text};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::answer::raw;
use crate::app::{App, Json};
use crate::folder::split;
use crate::lanes::Work;
use crate::refusal::{Refusal, json};
use crate::rest::Rest;
use crate::work::{Who, work};

/// A run that is asked for.
#[derive(Deserialize)]
pub(crate) struct WriteAsked {
    #[serde(flatten)]
    who: Who,
    file: String,
    folder: Option<String>,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Serialize)]
struct Written<'a> {
    state: &'static str,
    generation: u64,
    seconds: f64,
    folder: String,
    files: Vec<&'a str>,
    verdict: Box<RawValue>,
}

/// Runs a job and writes its files.
pub(crate) async fn write(
    State(app): State<Arc<App>>,
    Json(asked): Json<WriteAsked>,
) -> Result<Response<Body>, Refusal> {
    asked.rest.is_empty()?;
    let file = app.file(&asked.file)?;
    let folder = asked.folder.unwrap_or_else(|| "out".to_owned());
    if !is_folder_name(&folder) {
        return Err(Refusal::request("`folder` is one name, for example out"));
    }
    work(app, (asked.who, Work::Write, file.id.clone()), move |app, watch| {
        let (above, name) = split(&file.name);
        let read = FilesRead::default();
        let place = app.folder.root().join(above);
        let loader = DiskLoader::new(&place).noting(&read);
        let text = loader.read_text(name)?;
        let mut done =
            run_text((&file.name, &text), &RunWants::default(), &ResultFiles::default(), &loader, watch)?;
        done.outputs.spare(&read);
        let out = place.join(&folder);
        // A link of that name may lead out of the opened folder.
        let outside = out.canonicalize().is_ok_and(|place| !place.starts_with(app.folder.root()));
        if outside || out.is_symlink() {
            let what = format!("`{folder}` leads out of the opened folder");
            return Err(Finding::error(Code::OUTPUT_NOT_WRITTEN, what).into());
        }
        done.outputs.write_with(&out, watch)?;
        let shown = if above.is_empty() { folder } else { format!("{above}/{folder}") };
        Ok(json(
            StatusCode::OK,
            &Written {
                state: "done",
                generation: watch.asked.generation,
                seconds: watch.seconds(),
                folder: shown,
                files: done.outputs.files().map(|(name, _)| name).collect(),
                verdict: raw(json_document(&done.verdict)),
            },
        ))
    })
    .await
}

/// One plain name of letters, digits, `-` and `_`.
fn is_folder_name(name: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    !name.is_empty() && name.len() <= 64 && name.chars().all(plain)
}
