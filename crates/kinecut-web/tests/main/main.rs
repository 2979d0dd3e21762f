//! The server, as a browser, a person at another program and an attacker meet it.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

mod attack;
mod common;
mod events;
mod files;
mod kinematics;
mod work;
