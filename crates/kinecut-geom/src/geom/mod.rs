//! Geometry: rigid motions, curves with exact derivatives, profiles of revolution, boxes, meshes.
//!
//! Points and vectors are `glam` `DVec3`/`DVec2` [mm]. Curves are parametrised by arc length [mm].

mod aabb;
mod arc;
mod arc_chain;
mod bezier;
mod biarc_fit;
mod chords;
mod convex_hull;
mod cubic_fit;
mod curve;
mod edge_profile;
mod ellipse;
mod involute;
mod involute_block;
mod jet;
mod joint;
mod line;
mod mesh;
mod mesh_3mf;
mod mesh_3mf_read;
mod mesh_closed;
mod mesh_distance;
mod mesh_faces;
mod mesh_glb;
mod mesh_line;
mod mesh_load;
mod mesh_ply;
mod mesh_section;
mod mesh_stl;
mod offset;
mod outline;
mod plane_curve;
mod profile;
mod rigid;
mod rise;
mod solid;
mod spiral;
mod spiral_law;

pub use aabb::Aabb;
pub use arc::Arc;
pub use arc_chain::{PlanarArc, arc_chain, arcs_needed};
pub use bezier::CubicSpan;
pub use biarc_fit::{arcs_along, arcs_near, helices_along};
pub use chords::{biarcs_needed, chord_points, chord_rolls, chords_needed};
pub use convex_hull::convex_hull;
pub use cubic_fit::cubics_along;
pub use curve::{Curve, CurveKind};
pub use edge_profile::{EdgeProfile, EdgeSegment};
pub use ellipse::ellipse_distance;
pub use involute::{InvoluteRecord, PlanarJet, on_circle};
pub use involute_block::InvoluteBlock;
pub use jet::Jet;
pub use joint::{ContactOrder, CurveJoint, joint};
pub use line::Line;
pub use mesh::Mesh;
pub use mesh_3mf::write_3mf;
pub use mesh_3mf_read::read_3mf;
pub use mesh_distance::{MeshDistance, NearestPoint};
pub use mesh_glb::write_glb;
pub use mesh_line::MeshCrossing;
pub use mesh_load::load_mesh;
pub use mesh_ply::write_ply;
pub use mesh_section::SectionOutline;
pub use mesh_stl::{read_stl, write_stl};
pub use offset::{Offset, OffsetLoop, offset, offset_direct};
pub use outline::{EdgeDistance, NearestEdge, loop_crossing, meetings};
pub use outline::{
    LengthUnit, LoopEntry, LoopTable, MeshEdge, MeshOutline, Outline, OutlineEdge, OutlineFile, OutlineLoop,
    OutlineOptions, OutlinePoint, OutlineRead, OutlineReads, PointEntry, SectionAxis, Turn, read_outline,
};
pub use plane_curve::PlaneCurve;
pub use profile::{Profile, ProfileElement};
pub use rigid::Rigid;
pub use rise::{Rise, RiseShape};
pub use solid::Solid;
pub use spiral::Spiral;
pub use spiral_law::{ConstantEngagement, LensOrder, SpiralLaw, Support};
