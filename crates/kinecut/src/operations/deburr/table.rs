//! Deburring as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contouring::ContourLoops;
use crate::geom::{LengthUnit, PointEntry};
use crate::holes::Sense;
use crate::operations::chamfer::ChamferSide;
use crate::operations::edge::EdgesName;
use crate::operations::outlines::{OutlineCircle, OutlineEntry, OutlineRectangle};
use crate::operations::slot_outline::OutlineSlot;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// Deburring: a small break along the edges on which the face milling before has left a burr, or along an outline, by a V cutter or a
/// ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeburrTable {
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// Name by which another operation refers to it: `of`.
    #[serde(default)]
    pub name: Option<String>,
    /// The tool, a tapered one or a ball-nose end mill: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Name of an operation along an outline before it in the setup, whose edge is deburred: its outline with its place, `side`, `loops`,
    /// `top` and `stock_to_leave`; here `top` may be another, and `loops` fewer; in place of an outline.
    #[serde(default)]
    pub of: Option<String>,
    /// Edges of the face that was milled before it in the setup, in place of an outline: "bad", those where teeth have left at a bad
    /// exit angle of that face.
    #[serde(default)]
    pub edges: Option<EdgesName>,
    /// Edges of that face with a burr higher than this by `burr`, in place of `edges`.
    #[serde(default)]
    pub above: Option<f64>,
    /// Heights of burrs as measured in the shop: [exit angle, height] each, degrees and mm, straight between them and constant beyond.
    #[serde(default)]
    pub burr: Option<Vec<[f64; 2]>>,
    /// The outline as a rectangle; or give `circle`, `polygon`, `slot` or `outline`.
    #[serde(default)]
    pub rectangle: Option<OutlineRectangle>,
    /// The outline as a circle.
    #[serde(default)]
    pub circle: Option<OutlineCircle>,
    /// The outline as a closed polygon: its corners, in coordinates of the work offset.
    #[serde(default)]
    pub polygon: Option<Vec<[f64; 2]>>,
    /// An open line by its points, in coordinates of the work offset, with a `side` of "left" or "right"; the third number of a point
    /// is the bulge of the edge that begins there, tan(sweep / 4), counter-clockwise positive.
    #[serde(default)]
    #[schemars(example = vec![[0, 0], [60, 0]])]
    pub polyline: Option<Vec<PointEntry>>,
    /// The outline as a slot: a line or an arc of a width, with round ends.
    #[serde(default)]
    pub slot: Option<OutlineSlot>,
    /// The outline as a drawing ("plate.dxf", .svg, .json, or the top face of an .stl), or a table with the loops themselves.
    #[serde(default)]
    pub outline: Option<OutlineEntry>,
    /// Unit of the drawing where it does not say: "mm", "cm", "m", "in".
    #[serde(default)]
    pub unit: Option<LengthUnit>,
    /// Layers of the drawing that hold the outline; default: all.
    #[serde(default)]
    pub layers: Option<Vec<String>>,
    /// Widest gap in a drawing that is closed; default 0.01.
    #[serde(default)]
    pub snap: Option<f64>,
    /// Height at which a mesh (.stl) is cut, in its own coordinates: the outline is that of the material just below it; default: its highest horizontal face.
    #[serde(default)]
    pub section: Option<f64>,
    /// Point at a sharp level edge of a mesh (.stl), in its own coordinates, in place of `section`: the outline is the loop of that
    /// edge. `side` and `top` follow from it.
    #[serde(default)]
    #[schemars(example = vec![10.0, 0.0, 20.0])]
    pub edge_at: Option<[f64; 3]>,
    /// Zero of the drawing, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: [f64; 2],
    /// Angle by which the drawing is turned there, degrees, counter-clockwise; default 0.
    #[serde(default)]
    pub angle: f64,
    /// Edge that is deburred: "outside" that of the face and of its holes, "inside" that of the pocket or hole which the
    /// outline is; default that of `of`, or outside.
    #[serde(default)]
    pub side: Option<ChamferSide>,
    /// Loops whose edges are deburred: "all", "outer", "inner"; default those of `of`, or all.
    #[serde(default)]
    pub loops: Option<ContourLoops>,
    /// Height of the edge, in coordinates of the work offset; default that of `of`, or 0.
    #[serde(default)]
    pub top: Option<f64>,
    /// Width of the break, seen from above; default 0.2.
    #[serde(default)]
    pub width: Option<f64>,
    /// Depth of a V cutter's tip below the break, 0.2 at least; default a tenth of the tool's diameter, 0.5 at most.
    #[serde(default)]
    pub tip_clearance: Option<f64>,
    /// Height of the wall below the edge, down to a floor beside it that the tip must not touch; default: no floor.
    #[serde(default)]
    pub wall_height: Option<f64>,
    /// Stock that was left on the wall: it lies so far before the outline; default that of `of`, or 0.
    #[serde(default, alias = "leave")]
    pub stock_to_leave: Option<f64>,
    /// Largest allowed deviation of the break's width; default 0.01.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Sense,
    /// Radius of the arcs on which the edge is joined and left; default 1, smaller where there is no room.
    #[serde(default)]
    pub lead_radius: Option<f64>,
    /// Point near which the cut begins, in coordinates of the work offset; default: the middle of its longest line.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
    /// Way beyond the start that is cut twice; default 1.
    #[serde(default)]
    pub overlap: Option<f64>,
    /// Spindle speed, rev/min; or give `cutting_speed`.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Cutting speed at the upper edge of the break, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Feed along the edge, mm/min; or give `feed_per_tooth`.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Feed per tooth.
    #[serde(default)]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Feed straight down, mm/min; default: half the feed.
    #[serde(default)]
    pub plunge_feed: Option<f64>,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
}
