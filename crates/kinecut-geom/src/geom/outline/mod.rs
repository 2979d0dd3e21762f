//! Outlines of faces: closed loops of lines and arcs, several outer ones and holes; and the files they come from.

mod chain;
mod contact;
mod crossing;
mod drawing;
mod dxf;
mod edge;
mod edge_bins;
mod finish;
mod freeform;
mod half_section;
mod json;
mod mesh_face;
mod nearest;
mod options;
mod read;
mod repeated;
mod shape;
mod source;
mod svg;
mod through;
mod unit;

pub use contact::meetings;
pub use crossing::loop_crossing;
pub use edge::{OutlineEdge, OutlineLoop, Turn};
pub(in crate::geom) use edge_bins::EdgeBins;
pub use json::{LoopEntry, LoopTable, OutlineFile, OutlinePoint, PointEntry};
pub use mesh_face::MeshEdge;
pub use nearest::{EdgeDistance, NearestEdge};
pub use options::{MeshOutline, OutlineOptions, OutlineRead, OutlineReads, SectionAxis};
pub use read::read_outline;
pub use shape::Outline;
pub use unit::LengthUnit;
