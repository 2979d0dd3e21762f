//! Face milling as written in the job file.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::facing::{BadPart, PassesChoice, PlacementChoice};
use crate::geom::LengthUnit;
use crate::operations::CalledTool;
use crate::operations::outlines::OutlineEntry;
use crate::program::Coolant;

/// Milling of a plane face: placed, and milled in passes, so that its edges keep the least burr.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FacingTable {
    /// The tool: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// The edges of the face: a drawing ("cover.dxf", .svg, .json, or the top face of an .stl), "top" for the stock's own
    /// edges at the finished plane, or a table with the loops themselves.
    #[schemars(example = &"top")]
    pub outline: OutlineEntry,
    /// Unit of the drawing where it does not say: "mm", "cm", "m", "in".
    #[serde(default)]
    pub unit: Option<LengthUnit>,
    /// Layers of the drawing that hold the outline; default: all.
    #[serde(default)]
    pub layers: Option<Vec<String>>,
    /// Widest gap in a drawing that is closed; default 0.01.
    #[serde(default)]
    pub snap: Option<f64>,
    /// Height at which a mesh (.stl) is cut, in its own coordinates: the edges are those of the material just below it; default: its highest horizontal face.
    #[serde(default)]
    pub section: Option<f64>,
    /// Zero of the outline, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: [f64; 2],
    /// Angle by which the outline is turned there, degrees, counter-clockwise; default 0.
    #[serde(default)]
    pub angle: f64,
    /// Height of the finished plane, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Thickness of what is milled off.
    #[schemars(example = 1)]
    pub depth: f64,
    /// Largest depth of one level; default: all at once.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
    /// Largest distance of the milled face from its plane; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Spindle speed, rev/min; or give `cutting_speed`.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Cutting speed, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Whether the spindle turns counter-clockwise (M4), for a left-hand cutter; default false.
    #[serde(default)]
    pub left_hand: bool,
    /// Feed per tooth; or give `feed`.
    #[serde(default)]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Feed, mm/min.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
    /// Exit angles below this leave a primary burr, degrees. Default: from `thresholds` by the depth of the last level.
    #[serde(default)]
    pub exit_angle_min: Option<f64>,
    /// Thresholds by depth of cut, mm and degrees: [depth, angle] each, straight between them and constant beyond; default
    /// [[0.5, 90], [1, 60]], as Kryzhanivskyi and Kryzhanivska 2011 read them from Chern.
    #[serde(default)]
    pub thresholds: Option<Vec<[f64; 2]>>,
    /// The bad exit angles as intervals, instead of a threshold.
    #[serde(default)]
    pub bad: Option<Vec<BadPart>>,
    /// Side of the velocity from which exit angles are given; default "paper".
    #[serde(default)]
    pub psi_side: PsiSide,
    /// Weight of a millimetre of edge, by its label (layer of the drawing, name in the file): 5 for a sealing edge, 0
    /// for one that is chamfered; default 1.
    #[serde(default)]
    pub weights: BTreeMap<String, f64>,
    /// Distance of the outline inside the cutter; default: 2 % of its radius.
    #[serde(default)]
    pub margin: Option<f64>,
    /// Exit angles this near to a bad one count as bad too, degrees: what set-up may err; default 2.
    #[serde(default)]
    pub guard: Option<f64>,
    /// Orientations that the fixture does not allow: intervals of the part's turn, degrees. Of straight passes and rows;
    /// frames run every way.
    #[serde(default)]
    pub forbidden: Vec<[f64; 2]>,
    /// The part of the cutter's front that may cut in one straight pass: polar angles from the direction of feed,
    /// degrees, within [-90, 90]; default all.
    #[serde(default)]
    pub engagement: Option<[f64; 2]>,
    /// Least distance of the line of the cutter's centre from the middle of the part, of one straight pass; default 0.
    #[serde(default)]
    pub off_centre: f64,
    /// Placement under the cutter: "least-burr", "as-drawn", or { angle = .., offset = .. }; default least-burr.
    #[serde(default)]
    pub placement: Option<PlacementChoice>,
    /// Passes that mill it: "one", "fewest", { rows = 3 }, { frames = 10 }, "least-burr" or "fastest" of all; default "fewest": one, or
    /// as few rows as cover a part that is too wide for it.
    #[serde(default)]
    pub passes: Option<PassesChoice>,
    /// Path, coordinates or part: the one turned to give the feed the planned direction; default the path.
    #[serde(default)]
    pub turn: TurnName,
    /// Distance between cutter and part where a pass begins and ends; default 5.
    #[serde(default)]
    pub clearance: Option<f64>,
}

/// Side of the velocity from which exit angles are given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PsiSide {
    /// From the edge's direction, material on its right, to the velocity: small where the tooth leaves along the edge.
    #[default]
    Paper,
    /// 180 degrees minus that.
    Supplement,
}

/// Path, coordinates or part: the one turned to give the feed the planned direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TurnName {
    /// The path: the part stays as it is clamped.
    #[default]
    Path,
    /// The coordinates, by the control's own rotation (ROT, G68, CYCL DEF 10): the program reads along X.
    Coordinates,
    /// The part, on the table: the program runs along X, and a person turns the part by the angle that it says.
    Part,
}
