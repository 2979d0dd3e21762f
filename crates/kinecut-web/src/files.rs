//! The files of the folder: listed, read, saved.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use axum::body::Body;
use axum::extract::{Path as InPath, State};
use axum::http::{Response, StatusCode};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use kinecut::base::{Error, FileKind, Finding, Result as Found};
use kinecut::job::{Outputs, sha256};
use serde::{Deserialize, Serialize};

use crate::app::{App, Json};
use crate::folder::{Files, Listed, id_of, split};
use crate::refusal::{Refusal, bytes, json};
use crate::texts::new_name;

#[derive(Serialize)]
struct Project {
    folder: String,
    version: &'static str,
    protocol: u32,
    cores: usize,
    open: Option<String>,
    truncated: bool,
    files: Vec<Listed>,
}

/// `GET /api/project`.
pub(crate) async fn project(State(app): State<Arc<App>>) -> Result<Response<Body>, Refusal> {
    let listed = on_disk(Arc::clone(&app), |app| app.folder.list()).await?;
    let Files { files, truncated } = listed;
    let open = app.open.as_deref().map(id_of).filter(|id| files.iter().any(|f| f.id == *id));
    Ok(json(
        StatusCode::OK,
        &Project {
            folder: app.folder.name(),
            version: kinecut::VERSION,
            protocol: 1,
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            open,
            truncated,
            files,
        },
    ))
}

#[derive(Serialize)]
struct FileText {
    #[serde(flatten)]
    listed: Listed,
    text: Option<String>,
    sha256: String,
}

/// `GET /api/file/ID`.
pub(crate) async fn read(
    State(app): State<Arc<App>>,
    InPath(id): InPath<String>,
) -> Result<Response<Body>, Refusal> {
    let listed = app.file(&id)?;
    let name = listed.name.clone();
    let read = on_disk(app, move |app| app.folder.read(&name, FileKind::Bytes)).await?;
    match read {
        Ok(content) => {
            let (sha256, length) = (sha256(&content), content.len() as u64);
            let text = String::from_utf8(content).ok().filter(|_| length <= FileKind::Text.limit());
            Ok(json(StatusCode::OK, &FileText { listed: Listed { bytes: length, ..listed }, text, sha256 }))
        }
        Err(e) => Ok(Refusal::finding(StatusCode::NOT_FOUND, &e.0)),
    }
}

/// `GET /api/bytes/ID`.
pub(crate) async fn content(
    State(app): State<Arc<App>>,
    InPath(id): InPath<String>,
) -> Result<Response<Body>, Refusal> {
    let name = app.file(&id)?.name;
    match on_disk(app, move |app| app.folder.read(&name, FileKind::Mesh)).await? {
        Ok(content) => Ok(bytes(StatusCode::OK, "application/octet-stream", content)),
        Err(e) => Ok(Refusal::finding(StatusCode::NOT_FOUND, &e.0)),
    }
}

/// A text to be saved, and the hash of what was read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SaveAsked {
    text: String,
    sha256: Option<String>,
}

/// The bytes that a file shall hold, and the hash of those that it holds before.
struct Content {
    bytes: Vec<u8>,
    before: Option<String>,
}

#[derive(Serialize)]
struct Saved {
    id: String,
    name: String,
    sha256: String,
}

#[derive(Serialize)]
struct Conflict<E> {
    error: E,
    exit: u8,
    disk: OnDisk,
    yours: Option<String>,
}

#[derive(Serialize)]
struct OnDisk {
    text: Option<String>,
    sha256: Option<String>,
}

/// The outcome of saving.
enum Outcome {
    Saved,
    Changed(OnDisk, Option<String>),
    Failed(Error),
}

/// `PUT /api/file/ID`: replaces a file that is still what was read.
pub(crate) async fn save(
    State(app): State<Arc<App>>,
    InPath(id): InPath<String>,
    Json(asked): Json<SaveAsked>,
) -> Result<Response<Body>, Refusal> {
    let name = app.file(&id)?.name;
    let content = Content { bytes: asked.text.into_bytes(), before: asked.sha256 };
    save_as(app, name, content, "changed", "the file was changed by another program").await
}

/// A new file: its text, or its bytes in base64.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NewAsked {
    new: String,
    beside: Option<String>,
    text: Option<String>,
    base64: Option<String>,
}

/// `POST /api/file`: makes a file that is not there.
pub(crate) async fn make(
    State(app): State<Arc<App>>,
    Json(asked): Json<NewAsked>,
) -> Result<Response<Body>, Refusal> {
    let name = new_name(&app, &asked.new, asked.beside.as_deref())?;
    let bytes = match (asked.text, asked.base64) {
        (Some(text), None) => text.into_bytes(),
        (None, Some(packed)) => STANDARD.decode(packed).map_err(|_| {
            Refusal::request("`base64` is no base64").help("write the bytes in base64, with padding")
        })?,
        _ => return Err(Refusal::request("give what the file holds: `text` or `base64`")),
    };
    let content = Content { bytes, before: None };
    save_as(app, name, content, "exists", "there is a file of this name").await
}

async fn save_as(
    app: Arc<App>,
    name: String,
    content: Content,
    reason: &'static str,
    message: &'static str,
) -> Result<Response<Body>, Refusal> {
    let sha256 = sha256(&content.bytes);
    let _turn = app.saving.lock().await;
    let path = name.clone();
    let done = on_disk(Arc::clone(&app), move |app| {
        let done = put(app, &path, content);
        // So that what was saved here is not told as a change by others.
        app.folder.list();
        done
    })
    .await?;
    Ok(match done {
        Outcome::Saved => json(StatusCode::OK, &Saved { id: id_of(&name), name, sha256 }),
        Outcome::Changed(disk, yours) => {
            let refusal = Refusal::new(StatusCode::CONFLICT, reason, message);
            json(StatusCode::CONFLICT, &Conflict { error: refusal.said(), exit: 2, disk, yours })
        }
        Outcome::Failed(e) => Refusal::finding(StatusCode::UNPROCESSABLE_ENTITY, &e.0),
    })
}

/// Replaces a file if it is what was read.
fn put(app: &App, name: &str, content: Content) -> Outcome {
    let place = match place(app, name) {
        Ok(place) => place,
        Err(e) => return Outcome::Failed(e),
    };
    let now = match place.exists() {
        true => match app.folder.read(name, FileKind::Bytes) {
            Ok(content) => Some(content),
            Err(e) => return Outcome::Failed(e),
        },
        false => None,
    };
    let hash = now.as_deref().map(sha256);
    if hash != content.before {
        let text = now.and_then(|content| String::from_utf8(content).ok());
        return Outcome::Changed(OnDisk { text, sha256: hash }, String::from_utf8(content.bytes).ok());
    }
    match replace(&place, &content.bytes) {
        Ok(()) => Outcome::Saved,
        Err(e) => Outcome::Failed(e),
    }
}

/// The place of a file below the folder: its own, or that to which its link leads; of a file that is not there its future one.
fn place(app: &App, name: &str) -> Found<PathBuf> {
    let (above, own) = split(name);
    let here = app.folder.root().join(name);
    let place = match here.is_symlink() || here.exists() {
        true => app.folder.place(name),
        false if above.is_empty() => Some(app.folder.root().join(own)),
        false => app.folder.place(above).map(|folder| folder.join(own)),
    };
    place.ok_or_else(|| {
        let what = format!("`{name}` lies outside of the opened folder");
        Finding::error(kinecut::base::Code::OUTPUT_NOT_WRITTEN, what).into()
    })
}

/// Puts bytes in the place of a file: whole or not at all, with the rights that the file had.
fn replace(place: &Path, bytes: &[u8]) -> Found<()> {
    let (Some(folder), Some(name)) = (place.parent(), place.file_name().and_then(|n| n.to_str())) else {
        let what = format!("`{}` is no name of a file", place.display());
        return Err(Finding::error(kinecut::base::Code::OUTPUT_NOT_WRITTEN, what).into());
    };
    if place.metadata().is_ok_and(|now| now.permissions().readonly()) {
        let what = format!("`{name}` is write-protected");
        return Err(Finding::error(kinecut::base::Code::OUTPUT_NOT_WRITTEN, what)
            .help("save it under another name, or allow writing")
            .into());
    }
    let mut outputs = Outputs::default();
    outputs.add(name, bytes);
    outputs.write(folder)
}

/// Work on the disk, beside the answers to others.
async fn on_disk<T: Send + 'static>(
    app: Arc<App>,
    done: impl FnOnce(&App) -> T + Send + 'static,
) -> Result<T, Refusal> {
    tokio::task::spawn_blocking(move || done(&app)).await.map_err(|_| Refusal::defect())
}
