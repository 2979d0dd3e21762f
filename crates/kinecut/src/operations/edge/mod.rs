//! Edges that a cutter breaks: what `chamfer` and `deburr` share, from the keys of their tables to moves, walls and section. Along
//! whole loops of an outline, or along the pieces of a face's edges on which its milling has left a burr.

mod burrs;
mod check;
mod cutter;
mod json;
mod keys;
mod milled;
mod plan;
mod section;
mod show;
mod webs;

pub use burrs::{EdgesName, WantedEdges};
pub use check::EdgeOperation;
pub(crate) use check::{named_outline, operation};
pub(crate) use cutter::{ball, v_cutter};
pub(crate) use json::EdgeJson;
pub(crate) use keys::{EdgeKeys, edge_keys};
pub(crate) use milled::FaceEdges;
pub use plan::PlannedEdge;
pub(crate) use plan::planned;
pub(crate) use section::section;
