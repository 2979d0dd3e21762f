//! Outlines of faces: closed loops of lines and arcs, several outer ones and holes.

mod contact;
mod crossing;
mod edge;
mod shape;

pub use edge::{OutlineEdge, Turn};
pub use shape::{Outline, OutlineLoop};
