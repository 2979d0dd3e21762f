//! Sketches of how a surface is made: the surface as a mesh, what the tool has of it, the motions with arrows (figure 1
//! and table 1 of Danilchenko et al. for any surface).
//!
//! Input is plain data in work coordinates, so that the sketch knows nothing of surfaces and splits.

mod motion;
mod sheet;
mod view;

pub use sheet::{split_drawing, split_figure, split_sheet};

/// One way to divide the generation of a surface between machine and tool, as sampled points [mm].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SplitSketch {
    /// Heading, such as "machine 61 | tool 53".
    pub title: String,
    /// Said below, such as the name of the process.
    pub about: String,
    /// Points of the wanted surface, in rows of equal length.
    pub surface: Vec<Vec<[f64; 3]>>,
    /// Part of the surface that the tool has.
    pub tool: SketchTool,
    /// Motions of the machine.
    pub motions: Vec<SketchMotion>,
}

/// Part of a surface that the tool has.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum SketchTool {
    /// Nothing is drawn.
    #[default]
    None,
    /// A point.
    Point([f64; 3]),
    /// An edge.
    Edge(Vec<[f64; 3]>),
    /// A surface, in rows of equal length.
    Patch(Vec<Vec<[f64; 3]>>),
}

/// A motion of the machine at the moment that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct SketchMotion {
    /// Its name beside the arrow, such as "C \u{3c6}" or "Z = 6 \u{3c6}/2\u{3c0}".
    pub name: String,
    /// Direction of the translation, or of the axis of the rotation.
    pub direction: [f64; 3],
    /// A point of the axis of a rotation [mm]; none for a translation.
    pub axis_point: Option<[f64; 3]>,
    /// Role of the motion.
    pub role: MotionRole,
}

/// Role of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MotionRole {
    /// It generates the surface.
    Forming,
    /// It generates the surface together with other ones, by a law.
    Linked,
    /// It is held at a constant.
    Setting,
    /// It brings the tool into its place.
    SetUp,
}

impl MotionRole {
    /// All of them.
    const ALL: [MotionRole; 4] =
        [MotionRole::Forming, MotionRole::Linked, MotionRole::Setting, MotionRole::SetUp];
}
