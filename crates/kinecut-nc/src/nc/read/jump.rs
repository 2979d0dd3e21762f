//! Blocks that say which block is next.

use crate::nc::run::Level;

use super::place::Bytes;

/// A jump that a block of words asks for, once all else of it is done.
#[derive(Clone, Debug)]
pub(super) enum Jump {
    /// `M98`: a program is called.
    Program { number: u32, times: u32, bytes: Bytes },
    /// `G65`: a program with variables of its own.
    Macro { number: u32, times: u32, locals: Level, bytes: Bytes },
    /// `M97`: the block of a number is called.
    Block { number: u32, times: u32, bytes: Bytes },
    /// `M99`: back, or to a block number of the caller.
    Return { to: Option<u32>, bytes: Bytes },
}
