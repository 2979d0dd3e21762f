//! What a drill meets on its way, against brute force, other forms of the same body, and published numbers.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

#[path = "drill_ways/mesh.rs"]
mod mesh;
