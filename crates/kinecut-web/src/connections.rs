//! Connections: no more than a number, and those that have shown the token go before those that have not.

use std::net::SocketAddr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::http::Request;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Notify;

use crate::limits::Limits;

/// Pause after a connection that the system could not make: it has run out of something.
const PAUSE: Duration = Duration::from_millis(50);

/// What a connection has shown of itself; each of its requests carries it.
#[derive(Clone, Default)]
pub(crate) struct Trust(Arc<AtomicBool>);

impl Trust {
    /// It has shown the token.
    pub(crate) fn earn(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

struct Open {
    number: u64,
    trust: Trust,
    end: Arc<Notify>,
}

/// The connections that are open, the oldest first.
#[derive(Default)]
pub(crate) struct Connections {
    open: Mutex<Vec<Open>>,
}

impl Connections {
    fn open(&self) -> MutexGuard<'_, Vec<Open>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Number of connections.
    pub(crate) fn count(&self) -> usize {
        self.open().len()
    }

    /// Takes one more in. Where there are too many, the oldest without a token makes place; where all have one, there is none.
    fn enter(&self, number: u64, most: usize) -> Option<(Trust, Arc<Notify>)> {
        let mut open = self.open();
        if open.len() >= most {
            let oldest = open.iter().position(|one| !one.trust.0.load(Ordering::Relaxed))?;
            open.remove(oldest).end.notify_one();
        }
        let (trust, end) = (Trust::default(), Arc::new(Notify::new()));
        open.push(Open { number, trust: trust.clone(), end: Arc::clone(&end) });
        Some((trust, end))
    }

    fn leave(&self, number: u64) {
        self.open().retain(|one| one.number != number);
    }
}

/// The place of a connection, which it leaves however it ends.
struct Place {
    connections: Arc<Connections>,
    number: u64,
}

impl Drop for Place {
    fn drop(&mut self) {
        self.connections.leave(self.number);
    }
}

/// Serves connections until the end of the server; `first` is added to the numbers of these, which are odd or even.
pub(crate) async fn serve(
    listener: TcpListener,
    (router, limits): (Router, Limits),
    connections: Arc<Connections>,
    first: u64,
) {
    let mut number = first;
    loop {
        match listener.accept().await {
            Ok((stream, _)) => {
                number += 2;
                match connections.enter(number, limits.connections) {
                    Some(entered) => {
                        let place = Place { connections: Arc::clone(&connections), number };
                        let router = router.clone();
                        tokio::spawn(async move {
                            let _place = place;
                            talk(stream, router, limits, entered).await;
                        });
                    }
                    None => refuse(&stream),
                }
            }
            Err(_) => tokio::time::sleep(PAUSE).await,
        }
    }
}

/// Answers the requests of one connection.
async fn talk(stream: TcpStream, router: Router, limits: Limits, (trust, end): (Trust, Arc<Notify>)) {
    // A small answer need not wait for more to send.
    let _ = stream.set_nodelay(true);
    let service = tower_service(router, trust);
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(limits.reading).max_buf_size(limits.head);
    let connection = http.serve_connection(TokioIo::new(stream), service);
    // Whatever ends it, a fault of the other side or that it makes place, it has ended.
    let ended = end.notified();
    first_of(connection, ended).await;
}

/// Waits for the first of two.
async fn first_of<A, B>(one: impl Future<Output = A>, other: impl Future<Output = B>) {
    let mut one = std::pin::pin!(one);
    let mut other = std::pin::pin!(other);
    std::future::poll_fn(|context| {
        let ended = one.as_mut().poll(context).is_ready() || other.as_mut().poll(context).is_ready();
        if ended { std::task::Poll::Ready(()) } else { std::task::Poll::Pending }
    })
    .await;
}

/// The router for requests that carry the trust of their connection.
fn tower_service(
    router: Router,
    trust: Trust,
) -> impl hyper::service::Service<
    Request<hyper::body::Incoming>,
    Response = axum::response::Response,
    Error = std::convert::Infallible,
    Future: Send,
> {
    let router = TowerToHyperService::new(router);
    hyper::service::service_fn(move |request: Request<hyper::body::Incoming>| {
        let mut request = request.map(Body::new);
        request.extensions_mut().insert(trust.clone());
        hyper::service::Service::call(&router, request)
    })
}

/// Says that there is no place, as far as that goes without waiting.
fn refuse(stream: &TcpStream) {
    const BODY: &str = r#"{"error":{"severity":"error","message":"there are too many connections","help":"","reason":"connections"},"exit":2}"#;
    let head = format!(
        "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        BODY.len()
    );
    // The connection closes either way.
    let _ = stream.try_write(format!("{head}{BODY}").as_bytes());
}

/// Listens on both loopback addresses where the machine has both; the port of the first one counts.
///
/// # Errors
/// The port is taken.
pub(crate) fn listen(port: u16) -> std::io::Result<Vec<std::net::TcpListener>> {
    let first = std::net::TcpListener::bind(SocketAddr::from(([127, 0, 0, 1], port)))?;
    let port = first.local_addr()?.port();
    let second = std::net::TcpListener::bind(SocketAddr::from((std::net::Ipv6Addr::LOCALHOST, port)));
    let all: Vec<_> = std::iter::once(first).chain(second.ok()).collect();
    for listener in &all {
        listener.set_nonblocking(true)?;
    }
    Ok(all)
}
