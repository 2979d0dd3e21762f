//! Milling of a pocket as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::clearing::PocketEntry;
use crate::geom::LengthUnit;
use crate::holes::{FeedAt, Sense};
use crate::operations::contour::ContourFinishTable;
use crate::operations::outlines::{OutlineCircle, OutlineEntry, OutlineRectangle};
use crate::operations::slot_outline::OutlineSlot;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// Milling of a pocket: a face of any outline is cleared, its holes stay as islands, and no pass cuts with a larger engagement
/// than is wanted. A pocket that reaches over the stock is open there; one over a hole that is wide enough enters by it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PocketTable {
    /// Name by which a chamfer refers to it: `of`, or a pocket with a smaller cutter: `rest`.
    #[serde(default)]
    pub name: Option<String>,
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// The tool, one with a cylindrical edge: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Name of a pocket before it in the setup with a larger cutter: only what that one has left is cleared, corners and places into
    /// which it does not go. The outline is that of the pocket before.
    #[serde(default)]
    pub rest: Option<String>,
    /// The pocket as a rectangle; or give `circle`, `polygon`, `slot` or `outline`.
    #[serde(default)]
    pub rectangle: Option<OutlineRectangle>,
    /// The pocket as a circle.
    #[serde(default)]
    pub circle: Option<OutlineCircle>,
    /// The pocket as a closed polygon: its corners, in coordinates of the work offset.
    #[serde(default)]
    pub polygon: Option<Vec<[f64; 2]>>,
    /// The pocket as a slot: a line or an arc of a width, with round ends.
    #[serde(default)]
    pub slot: Option<OutlineSlot>,
    /// The pocket as a drawing ("plate.dxf", .svg, .json, or the top face of an .stl), or a table with the loops themselves.
    #[serde(default)]
    pub outline: Option<OutlineEntry>,
    /// Unit of the drawing where it does not say: "mm", "cm", "m", "in".
    #[serde(default)]
    pub unit: Option<LengthUnit>,
    /// Layers of the drawing that hold it; default: all.
    #[serde(default)]
    pub layers: Option<Vec<String>>,
    /// Widest gap in a drawing that is closed; default 0.01.
    #[serde(default)]
    pub snap: Option<f64>,
    /// Height at which a mesh (.stl) is cut, in its own coordinates: the pocket is what the material just below it encloses; default: its highest horizontal face.
    #[serde(default)]
    pub section: Option<f64>,
    /// Point at a sharp level edge of a mesh (.stl), in its own coordinates, in place of `section`: the outline is the loop of that
    /// edge.
    #[serde(default)]
    #[schemars(example = vec![10.0, 0.0, 20.0])]
    pub edge_at: Option<[f64; 3]>,
    /// Zero of the drawing, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: [f64; 2],
    /// Angle by which the drawing is turned there, degrees, counter-clockwise; default 0.
    #[serde(default)]
    pub angle: f64,
    /// Height of the material's upper face, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Depth below it.
    #[schemars(example = 8)]
    pub depth: f64,
    /// Depth that the tool goes below `depth`, for a cut that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default, alias = "leave")]
    pub stock_to_leave: f64,
    /// Largest allowed deviation of the wall and the floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Sense,
    /// Largest angle of the cutter's circle that cuts in a pass, degrees, between 5 and 120; default 60: a quarter of the diameter beside
    /// a straight wall.
    #[serde(default)]
    pub engagement: Option<f64>,
    /// The way down where no side is open and no hole is there.
    #[serde(default)]
    pub entry: Option<PocketEntryTable>,
    /// Height of links over the floor; default 0.2.
    #[serde(default)]
    pub lift: Option<f64>,
    /// Radius of the arcs on which the wall is joined and left; default: half the cutter's radius, 1 at least, smaller where
    /// there is no room.
    #[serde(default)]
    pub lead_radius: Option<f64>,
    /// Spindle speed, rev/min; or give `cutting_speed`.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Cutting speed, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Feed of the passes and along the wall, mm/min; or give `feed_per_tooth`.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Feed per tooth.
    #[serde(default)]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Feed along the helix and the ramp, and down to what is cleared, mm/min; default: half the feed.
    #[serde(default)]
    pub plunge_feed: Option<f64>,
    /// Feed through what is cleared, mm/min; default: twice the feed.
    #[serde(default)]
    pub link_feed: Option<f64>,
    /// Whether the feeds along the wall are those of the cutter's centre or those of its edge at the wall; default centre.
    #[serde(default)]
    pub feed_at: FeedAt,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
    /// Finishing of the wall after all levels; left out, a lap along it on each level cuts it to size.
    #[serde(default)]
    pub finish: Option<ContourFinishTable>,
}

/// The way down into a pocket.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PocketEntryTable {
    /// "fitting": a helix where it has room, else a ramp to and fro along the line in the middle of the walls, else straight down with
    /// a cutter that cuts at its centre; "helix", "ramp" or "plunge": only that; default "fitting".
    #[serde(default)]
    pub way: Option<PocketEntry>,
    /// Angle of the helix or the ramp, degrees; default 3, or what the tool can.
    #[serde(default)]
    pub helix: Option<f64>,
    /// Radius of the helix of the cutter's centre; default 0.8 of the cutter's radius, less where there is no room.
    #[serde(default)]
    pub radius: Option<f64>,
}
