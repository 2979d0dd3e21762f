//! Limits of the server.

use std::time::Duration;

/// Limits of the server; the defaults are those of the workbench.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest body of a request [bytes].
    pub body: usize,
    /// Largest head of a request [bytes].
    pub head: usize,
    /// Time within which a head, and then a body, must arrive.
    pub reading: Duration,
    /// Most connections.
    pub connections: usize,
    /// Most pieces of work that wait or run.
    pub waiting: usize,
    /// Simulations whose results are kept for questions about them.
    pub results: usize,
    /// Time between two looks at the files of the folder.
    pub looking: Duration,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            body: 64 << 20,
            head: 16 << 10,
            reading: Duration::from_secs(10),
            connections: 32,
            waiting: 32,
            results: 2,
            looking: Duration::from_secs(1),
        }
    }
}
