//! Outlines of faces: closed loops of lines and arcs, several outer ones and holes.

mod edge;
mod shape;

pub use edge::{OutlineEdge, Turn};
pub use shape::{Outline, OutlineLoop};
