//! The tests of the command line, one executable: each command as a shell runs it, and the documents against what is run.
//!
//! One of them by its path: `cargo test -p kinecut-cli --test main surface`.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

mod shell;

mod cli;
mod drill;
mod envelope;
mod face;
#[cfg(unix)]
mod files;
mod grazing;
mod letters;
mod machine;
mod open;
mod program;
mod shown;
mod surface;
mod time;
mod tools;
