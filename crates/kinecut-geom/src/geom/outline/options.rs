//! Options of the readers of outlines, and their result.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LengthUnit, MeshEdge, Outline};
use crate::base::{Code, Finding, Result};

/// An axis of a drawing about which a half section is turned; it passes the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SectionAxis {
    /// The drawing's X axis.
    X,
    /// The drawing's Y axis.
    Y,
}

/// Parts of a drawing that are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OutlineReads {
    /// Closed loops: the outline of a face. Open lines are an error.
    #[default]
    Loops,
    /// Open lines; closed loops are passed over. Not of meshes.
    Lines,
    /// All that is drawn, as lines: closed loops too, and what branches or crosses. Not of meshes.
    Drawn,
}

/// The part of a mesh that is read as an outline, in the coordinates of the mesh [mm].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum MeshOutline {
    /// Its highest horizontal face.
    #[default]
    Top,
    /// The material just below a height.
    Section(f64),
    /// The loop of the sharp level edge that passes a point, no farther than 1 mm from it.
    Edge(DVec3),
}

/// Options for reading a file into an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlineOptions {
    /// Unit of the file's numbers, whatever the file says; `None`: as the file says.
    pub unit: Option<LengthUnit>,
    /// Ends of lines and arcs no farther apart than this are joined [mm].
    pub snap: f64,
    /// Layers (DXF) or layers and groups (SVG) that are read; empty: all.
    pub layers: Vec<String>,
    /// Largest distance of arcs from the curve that they replace: ellipses, splines, Bezier curves [mm].
    pub curve_tolerance: f64,
    /// Distance from a circle at which vertices of a mesh count as lying on it, so that their chords become one arc [mm];
    /// 0: chords stay chords.
    pub arc_tolerance: f64,
    /// The part of a mesh that is read.
    pub mesh: MeshOutline,
    /// The drawing is half a section about this axis: what is drawn along the axis is left out, and what is open there
    /// closed along it. Not for meshes.
    pub half_section: Option<SectionAxis>,
    /// Whether loops or open lines are read.
    pub reads: OutlineReads,
}

impl Default for OutlineOptions {
    /// Unit of the file, 0.01 mm, all layers, 0.005 mm, 0.001 mm, highest face.
    fn default() -> OutlineOptions {
        OutlineOptions {
            unit: None,
            snap: 0.01,
            layers: Vec::new(),
            curve_tolerance: 0.005,
            arc_tolerance: 1e-3,
            mesh: MeshOutline::Top,
            half_section: None,
            reads: OutlineReads::Loops,
        }
    }
}

impl OutlineOptions {
    pub(super) fn check(&self) -> Result<()> {
        let lengths = [
            ("snap", self.snap),
            ("curve tolerance", self.curve_tolerance),
            ("arc tolerance", self.arc_tolerance),
        ];
        for (what, value) in lengths {
            let zero_is_fine = what != "curve tolerance";
            if !(value > 0.0 && value.is_finite() || zero_is_fine && value == 0.0) {
                let what = format!("the {what} of an outline must be positive");
                return Err(Finding::error(Code::OUTLINE_FILE, what).value_mm(value).bound_mm(0.0).into());
            }
        }
        Ok(())
    }
}

/// Result of reading a file.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlineRead {
    /// The outline [mm], or open lines as [`Outline::of_lines`]; labels are layers, names, identifiers of the file.
    pub outline: Outline,
    /// Weight of each edge as the file says; 1 where it says nothing.
    pub weights: Vec<f64>,
    /// Parts that were passed over, joined, left out or converted, one sentence each.
    pub notes: Vec<String>,
    /// The edge of a mesh whose loop the outline is.
    pub edge: Option<MeshEdge>,
}
