//! The work that a program may ask for.

use crate::base::{Code, Finding};

/// Blocks that a program runs again, and the depth of its calls: what its own length does not bound.
#[derive(Clone, Copy, Debug)]
pub(in crate::nc) struct Budget {
    /// Most blocks run after the first jump backwards or call.
    pub(in crate::nc) blocks: u64,
    /// Deepest calls.
    pub(in crate::nc) depth: usize,
    /// Blocks run so far.
    run: u64,
}

impl Budget {
    pub(in crate::nc) const fn new(blocks: u64, depth: usize) -> Budget {
        Budget { blocks, depth, run: 0 }
    }

    /// Counts a block.
    #[inline]
    pub(in crate::nc) fn block(&mut self) -> Result<(), Finding> {
        self.run += 1;
        if self.run <= self.blocks {
            return Ok(());
        }
        let message = "the program has not ended after this number of blocks run in loops and calls";
        Err(Finding::error(Code::NC_STATE, message)
            .value(self.run as f64, "blocks")
            .bound(self.blocks as f64, "blocks")
            .help("end the loop, or allow more: --blocks, in a job `blocks`"))
    }

    /// Checks the depth of a further call.
    pub(in crate::nc) fn call(&self, depth: usize) -> Result<(), Finding> {
        if depth < self.depth {
            return Ok(());
        }
        Err(Finding::error(Code::NC_STATE, "the calls are nested deeper than the control allows")
            .value(depth as f64 + 1.0, "levels")
            .bound(self.depth as f64, "levels")
            .help("call fewer subprograms within one another"))
    }
}
