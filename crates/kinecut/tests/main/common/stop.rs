//! Work that is cancelled.

use kinecut::base::Progress;

/// Cancelled from the beginning.
pub(crate) struct Stop;

impl Progress for Stop {
    fn stage(&self, _: &str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn cancelled(&self) -> bool {
        true
    }
}
