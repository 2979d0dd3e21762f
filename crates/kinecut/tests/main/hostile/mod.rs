//! What nobody would write: broken files, huge numbers, mistaken programs.

mod fuzzed;
mod limits;
mod mutations;
mod numbers;
mod targets;
