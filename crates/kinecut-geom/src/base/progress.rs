//! Progress and cancellation, passed down to long work.

/// Receives the progress of long work and may ask it to stop.
pub trait Progress: Sync {
    /// A stage begins; `steps` is its amount of work in steps of its own size.
    fn stage(&self, name: &str, steps: u64);

    /// `steps` more steps of the present stage are done; may be called from any thread.
    fn advance(&self, steps: u64);

    /// A fact about the work that comes, for a person who waits: what it will cost.
    fn note(&self, _text: &str) {}

    /// True if the caller wants the work to stop; it then returns an error with code `KC0009`.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Progress that nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _name: &str, _steps: u64) {}
    fn advance(&self, _steps: u64) {}
}
