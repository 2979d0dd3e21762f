//! What the server tells without being asked: progress, files that changed. Server-sent events over `fetch`, because only so the
//! token can come along.

use std::convert::Infallible;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::http::{Response, StatusCode};
use hyper::body::Frame;
use serde::Serialize;
use tokio::sync::{broadcast, mpsc};

use crate::refusal::bytes;

/// Events that a slow reader may be behind.
const BEHIND: usize = 256;
/// Time after which a quiet stream says that it is there.
const QUIET: Duration = Duration::from_secs(5);

/// An event: for one client, or for all.
#[derive(Clone)]
struct Event {
    client: Option<Arc<str>>,
    text: Arc<str>,
}

/// The place from which events go to all who listen.
pub(crate) struct Events {
    sender: broadcast::Sender<Event>,
    listening: Arc<AtomicUsize>,
}

impl Events {
    pub(crate) fn new() -> Events {
        Events { sender: broadcast::channel(BEHIND).0, listening: Arc::default() }
    }

    /// Number of streams.
    pub(crate) fn listening(&self) -> usize {
        self.listening.load(Ordering::Relaxed)
    }

    /// Sends an event to one client, or to all.
    pub(crate) fn send(&self, client: Option<&str>, name: &str, data: &impl Serialize) {
        if self.listening() == 0 {
            return;
        }
        // Plain data always serialise.
        let Ok(data) = serde_json::to_string(data) else { return };
        let text = format!("event: {name}\ndata: {data}\n\n").into();
        // Nobody may be listening any more.
        let _ = self.sender.send(Event { client: client.map(Into::into), text });
    }

    /// The stream of a client.
    pub(crate) fn stream(&self, client: String) -> Response<Body> {
        let (into, from) = mpsc::channel(16);
        let mut events = self.sender.subscribe();
        let here = Here::one_more(&self.listening);
        tokio::spawn(async move {
            let _here = here;
            let mut line: Bytes = Bytes::from_static(b": here\n\n");
            loop {
                // The reader has gone.
                if into.send(line).await.is_err() {
                    return;
                }
                line = loop {
                    match tokio::time::timeout(QUIET, events.recv()).await {
                        Err(_) => break Bytes::from_static(b": here\n\n"),
                        Ok(Ok(event)) if event.client.as_deref().is_none_or(|c| c == client) => {
                            break Bytes::copy_from_slice(event.text.as_bytes());
                        }
                        // Those of others; and of progress the newest is enough.
                        Ok(Ok(_) | Err(broadcast::error::RecvError::Lagged(_))) => {}
                        Ok(Err(broadcast::error::RecvError::Closed)) => return,
                    }
                };
            }
        });
        bytes(StatusCode::OK, "text/event-stream", Body::new(Lines(from)))
    }
}

/// A stream that is counted.
struct Here(Arc<AtomicUsize>);

impl Here {
    fn one_more(count: &Arc<AtomicUsize>) -> Here {
        count.fetch_add(1, Ordering::Relaxed);
        Here(Arc::clone(count))
    }
}

impl Drop for Here {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// The body of a stream.
struct Lines(mpsc::Receiver<Bytes>);

impl hyper::body::Body for Lines {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        self.0.poll_recv(context).map(|line| line.map(|line| Ok(Frame::data(line))))
    }
}
