//! What nobody would write: broken files, huge numbers, mistaken programs.

mod fuzzed;
mod mutations;
mod numbers;
mod targets;
