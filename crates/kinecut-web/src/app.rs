//! What the server holds: the folder, the work, and the newest results. Nothing grows with the number of requests.

use std::io;
use std::path::Path;
use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::FromRequest;
use axum::http::{Request, StatusCode};
use serde::de::DeserializeOwned;

use crate::events::Events;
use crate::folder::{Folder, Listed};
use crate::gate::Gate;
use crate::lanes::Lanes;
use crate::limits::Limits;
use crate::pools::Pools;
use crate::refusal::Refusal;
use crate::results::Results;
use crate::token::Token;

/// The state of the server.
pub(crate) struct App {
    pub(crate) folder: Folder,
    /// The file to open first.
    pub(crate) open: Option<String>,
    pub(crate) gate: Gate,
    pub(crate) limits: Limits,
    pub(crate) events: Arc<Events>,
    pub(crate) lanes: Arc<Lanes>,
    pub(crate) pools: Pools,
    pub(crate) results: Results,
    /// One save at a time: what was read is what is replaced.
    pub(crate) saving: tokio::sync::Mutex<()>,
}

impl App {
    /// The state for a folder.
    ///
    /// # Errors
    /// The folder is not there, or the system has no threads.
    pub(crate) fn new(
        (folder, open): (&Path, Option<String>),
        (port, token): (u16, Token),
        limits: Limits,
    ) -> io::Result<App> {
        let folder = Folder::open(folder)?;
        folder.list();
        Ok(App {
            folder,
            open,
            gate: Gate::new(port, token),
            limits,
            events: Arc::new(Events::new()),
            lanes: Arc::default(),
            pools: Pools::new(limits.waiting)?,
            results: Results::new(limits.results),
            saving: tokio::sync::Mutex::default(),
        })
    }

    /// The file of an identifier.
    ///
    /// # Errors
    /// There is none.
    pub(crate) fn file(&self, id: &str) -> Result<Listed, Refusal> {
        self.folder.file(id).ok_or_else(|| Refusal::not_found("there is no file of this identifier"))
    }
}

/// The JSON body of a request, as long and as late as the limits allow.
pub(crate) struct Json<T>(pub(crate) T);

impl<T: DeserializeOwned> FromRequest<Arc<App>> for Json<T> {
    type Rejection = Refusal;

    async fn from_request(request: Request<Body>, app: &Arc<App>) -> Result<Json<T>, Refusal> {
        let bytes = body(request, &app.limits).await?;
        serde_json::from_slice(&bytes)
            .map(Json)
            .map_err(|e| Refusal::request(format!("the body is not what this asks for: {e}")))
    }
}

/// The whole body of a request.
async fn body(request: Request<Body>, limits: &Limits) -> Result<Bytes, Refusal> {
    let too_long = || {
        let message = format!("the body is over {} bytes", limits.body);
        Refusal::new(StatusCode::PAYLOAD_TOO_LARGE, "size", message)
    };
    let declared = hyper::body::Body::size_hint(request.body()).lower();
    if declared > limits.body as u64 {
        return Err(too_long());
    }
    let read = axum::body::to_bytes(request.into_body(), limits.body);
    match tokio::time::timeout(limits.reading, read).await {
        Ok(Ok(bytes)) => Ok(bytes),
        // Either more came than is taken, or the sender has gone and reads no answer.
        Ok(Err(_)) => Err(too_long()),
        Err(_) => {
            Err(Refusal::new(StatusCode::REQUEST_TIMEOUT, "slow", "the request did not arrive in time"))
        }
    }
}
