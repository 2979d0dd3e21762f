//! Ends of a run.

/// State in which a run begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At rest.
    Rest,
    /// Evenly, as fast as the limits allow there: the run goes on at its feed.
    Even,
}
