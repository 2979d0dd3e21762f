//! The server: bound, then run until it is told to stop.

use std::io;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;
use tokio::net::TcpListener;
use tokio::sync::Notify;

use crate::app::App;
use crate::connections::{self, Connections};
use crate::limits::Limits;
use crate::token::Token;
use crate::{look, router};

/// Time that a save or a last event has when the server ends.
const LAST: Duration = Duration::from_secs(2);
/// Time in which the last events go out.
const BYE: Duration = Duration::from_millis(50);

/// Settings of a server.
#[derive(Clone, Debug, Default)]
pub struct ServerWants {
    /// The file to open first: its path below the folder, with `/`.
    pub open: Option<String>,
    /// The port; 0 is any that is free.
    pub port: u16,
    /// Limits.
    pub limits: Limits,
}

/// A server that listens on loopback.
pub struct Server {
    app: Arc<App>,
    token: Token,
    port: u16,
    listeners: Vec<std::net::TcpListener>,
    stop: Arc<Notify>,
    connections: Arc<Connections>,
}

/// Stops a server, from wherever.
#[derive(Clone)]
pub struct Stop(Arc<Notify>);

impl Stop {
    /// Stops it in order.
    pub fn now(&self) {
        self.0.notify_one();
    }
}

/// Numbers of what a server holds: none grows with the number of requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held {
    /// Simulations whose results are kept.
    pub results: usize,
    /// Lanes in which there is work.
    pub lanes: usize,
    /// Pieces of work that wait or run.
    pub waiting: usize,
    /// Streams of events.
    pub listening: usize,
    /// Connections.
    pub connections: usize,
}

/// Looks at what a server holds.
#[derive(Clone)]
pub struct Look(Arc<App>, Arc<Connections>);

impl Look {
    /// The numbers as they are now.
    pub fn held(&self) -> Held {
        Held {
            results: self.0.results.count(),
            lanes: self.0.lanes.count(),
            waiting: self.0.pools.waiting(),
            listening: self.0.events.listening(),
            connections: self.1.count(),
        }
    }
}

#[derive(Serialize)]
struct Nothing {}

impl Server {
    /// Binds a server for a folder.
    ///
    /// # Errors
    /// The folder is not there, the port is taken, or the system lacks threads or random numbers.
    pub fn bind(folder: &Path, wants: &ServerWants) -> io::Result<Server> {
        let listeners = connections::listen(wants.port)?;
        let port = match listeners.first() {
            Some(first) => first.local_addr()?.port(),
            None => return Err(io::ErrorKind::AddrNotAvailable.into()),
        };
        let token = Token::random()?;
        let app = App::new((folder, wants.open.clone()), (port, token.clone()), wants.limits)?;
        let (stop, connections) = (Arc::default(), Arc::default());
        Ok(Server { app: Arc::new(app), token, port, listeners, stop, connections })
    }

    /// The address to open: with the token in the fragment, which no browser sends.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/#token={}", self.port, self.token.as_str())
    }

    /// The port.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The secret.
    pub fn token(&self) -> &Token {
        &self.token
    }

    /// What stops it.
    pub fn stop(&self) -> Stop {
        Stop(Arc::clone(&self.stop))
    }

    /// What looks at it.
    pub fn look(&self) -> Look {
        Look(Arc::clone(&self.app), Arc::clone(&self.connections))
    }

    /// Serves until it is stopped: work is cancelled, a save that has begun is finished.
    ///
    /// # Errors
    /// The system has no sockets or timers.
    pub fn run(self) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().enable_time().build()?;
        let Server { app, listeners, stop, connections, .. } = self;
        let served: io::Result<()> = runtime.block_on(async {
            let router = router::router(Arc::clone(&app));
            for (first, listener) in (0..).zip(listeners) {
                let listener = TcpListener::from_std(listener)?;
                let all = (router.clone(), app.limits);
                tokio::spawn(connections::serve(listener, all, Arc::clone(&connections), first));
            }
            tokio::spawn(look::look(Arc::clone(&app)));
            stop.notified().await;
            app.lanes.stop_all();
            app.events.send(None, "bye", &Nothing {});
            // A save that has begun holds its turn.
            drop(tokio::time::timeout(LAST, app.saving.lock()).await);
            tokio::time::sleep(BYE).await;
            Ok(())
        });
        runtime.shutdown_timeout(LAST);
        served
    }
}
