//! The tests of the library, one executable; a folder says what is tested.
//!
//! One of them by its path: `cargo test -p kinecut --test main nc::round_trip`. Beside it, `every_number` needs a process of
//! its own.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

mod common;

// What a job is made of.
mod clearing;
mod contour;
mod contouring;
mod geom;
mod machine;

// Motion, and what it sweeps and cuts.
mod motion;
mod stock;
mod sweep;
mod trace;

// Text of the controls.
mod nc;

// What is planned.
mod cutting;
mod drilling;
mod facing;
mod holes;
mod threading;

// The whole, and what is told of it.
mod job;
mod report;

// What holds everywhere.
mod hostile;
mod layers;
