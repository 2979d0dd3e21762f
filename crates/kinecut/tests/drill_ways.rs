//! What a drill meets on its way, against brute force, other forms of the same body, and published numbers.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

#[path = "drill_ways/golden.rs"]
mod golden;
#[path = "drill_ways/mesh.rs"]
mod mesh;
#[path = "drill_ways/pre_holes.rs"]
mod pre_holes;
#[path = "drill_ways/random_ways.rs"]
mod random_ways;
