//! Outlines of faces: closed loops of lines and arcs, several outer ones and holes; and the files they come from.

mod chain;
mod contact;
mod crossing;
mod drawing;
mod dxf;
mod edge;
mod freeform;
mod half_section;
mod json;
mod mesh_face;
mod read;
mod repeated;
mod shape;
mod source;
mod svg;
mod through;
mod unit;

pub use contact::meetings;
pub use crossing::loop_crossing;
pub use edge::{OutlineEdge, Turn};
pub use json::{LoopEntry, LoopTable, OutlineFile, PointEntry, PointTable};
pub use read::{OutlineOptions, OutlineRead, SectionAxis, read_outline};
pub use shape::{Outline, OutlineLoop};
pub use unit::LengthUnit;
