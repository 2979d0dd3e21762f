//! Milling along a contour as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contouring::{ContourLoops, ContourSide, TabShape};
use crate::geom::{LengthUnit, PointEntry};
use crate::holes::{FeedAt, Sense};
use crate::operations::outlines::{OutlineCircle, OutlineEntry, OutlineRectangle};
use crate::operations::slot_outline::OutlineSlot;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// Milling along the edges of an outline: outside of it, inside, or on it; or along an open line, on its left, its right, or on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourTable {
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// Name by which a chamfer refers to it: `of`.
    #[serde(default)]
    pub name: Option<String>,
    /// The tool, one with a cylindrical edge: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// The outline as a rectangle; or give `circle`, `polygon`, `slot` or `outline`.
    #[serde(default)]
    pub rectangle: Option<OutlineRectangle>,
    /// The outline as a circle.
    #[serde(default)]
    pub circle: Option<OutlineCircle>,
    /// The outline as a closed polygon: its corners, in coordinates of the work offset.
    #[serde(default)]
    pub polygon: Option<Vec<[f64; 2]>>,
    /// An open line by its points, in coordinates of the work offset; the third number of a point is the bulge of the edge that
    /// begins there, tan(sweep / 4), counter-clockwise positive.
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
    /// Side on which the cutter runs: "outside" keeps the face and cuts its holes from within, "inside" keeps what is around
    /// it, "on" runs on the line, "left" and "right" of the direction of an open line; default outside.
    #[serde(default)]
    pub side: ContourSide,
    /// Loops that are cut: "all", "outer", "inner"; default all.
    #[serde(default)]
    pub loops: ContourLoops,
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
    /// Distance of the loops of roughing from one another, where the stock beside the contour is wider than the cutter; the
    /// farthest from the wall is cut first. Default: one loop.
    #[serde(default)]
    #[schemars(example = 4)]
    pub stepover: Option<f64>,
    /// Number of these loops; default: as many as the stock outside of the contour needs.
    #[serde(default)]
    #[schemars(example = 2)]
    pub passes: Option<u32>,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default, alias = "leave")]
    pub stock_to_leave: f64,
    /// Largest allowed deviation of the wall and the floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Sense,
    /// The way down: "plunge", or { ramp = 3 } along the contour at an angle, degrees; default a ramp of 3 degrees, or of what
    /// the tool can.
    #[serde(default)]
    pub entry: Option<ContourEntry>,
    /// Radius of the arcs on which the contour is joined and left; default: half the cutter's radius, 1 at least, smaller where
    /// there is no room.
    #[serde(default)]
    pub lead_radius: Option<f64>,
    /// Point near which the contour begins, in coordinates of the work offset; default: the middle of its longest line.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
    /// Length by which the cutter goes along an open line before its begin and beyond its end, straight on; default: the
    /// cutter's radius and 1 mm, less where the line ends outside of the stock; 0 for side = "on".
    #[serde(default)]
    pub extend: Option<f64>,
    /// Way beyond the start that is cut twice; default: a quarter of the cutter's diameter, 2 at most.
    #[serde(default)]
    pub overlap: Option<f64>,
    /// Tabs that hold the part.
    #[serde(default)]
    pub tabs: Option<TabsTable>,
    /// Spindle speed, rev/min; or give `cutting_speed`.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Cutting speed, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Feed along the contour, mm/min; or give `feed_per_tooth`.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Feed per tooth.
    #[serde(default)]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Feed straight down and along ramps, mm/min; default: half the feed.
    #[serde(default)]
    pub plunge_feed: Option<f64>,
    /// Whether the feeds are those of the cutter's centre or those of its edge at the wall; default centre.
    #[serde(default)]
    pub feed_at: FeedAt,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
    /// Finishing of the wall after all levels; left out, the wall is cut to size level by level.
    #[serde(default)]
    pub finish: Option<ContourFinishTable>,
}

/// The way down to a level of a contour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ContourEntry {
    /// Straight down beside the contour; needs a cutter that cuts at its centre.
    Plunge,
    /// Down along the contour, at an angle, degrees.
    Ramp(#[schemars(example = 3)] f64),
}

/// Tabs that hold the part until it is taken out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TabsTable {
    /// Number of tabs of each loop; default: one for 150 mm, three at least. Not with `places`.
    #[serde(default)]
    pub count: Option<u32>,
    /// Points near which tabs are wanted, in coordinates of the work offset.
    #[serde(default)]
    pub places: Option<Vec<[f64; 2]>>,
    /// Width of what remains, at its thinnest.
    #[schemars(example = 6)]
    pub width: f64,
    /// Height over the depth of the contour.
    #[schemars(example = 2)]
    pub height: f64,
    /// Form: "flat", or "ramp" with ends that rise at 30 degrees beside the width; default flat.
    #[serde(default)]
    pub shape: TabShape,
    /// Whether finishing leaves them too; default true.
    #[serde(default = "yes")]
    pub finish: bool,
}

fn yes() -> bool {
    true
}

/// The path that is posted under compensation of the control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Compensation {
    /// The path of the cutter's centre: the register holds what the cutter is off.
    #[default]
    Wear,
    /// The contour itself: the register holds the cutter's radius.
    Full,
}

/// Finishing of a contour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourFinishTable {
    /// Stock that roughing leaves for it on the wall; default 0.2.
    #[serde(default = "fifth")]
    pub allowance: f64,
    /// Feed, mm/min; default that of the contour.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Further laps without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
    /// Whether the feed is reduced in inside corners, so that the chip is not thicker there than along a straight wall: to 0.3 of it
    /// at least; default false.
    #[serde(default)]
    pub corner_feed: bool,
    /// Register of the control by whose value the wall is moved at the machine: "D2".
    #[serde(default)]
    pub wear_offset: Option<String>,
    /// The path that is posted under this register: "wear", that of the cutter's centre, where the register holds what the cutter is
    /// off; or "full", the contour itself, where it holds the cutter's radius. Default wear.
    #[serde(default)]
    pub compensation: Compensation,
    /// Largest value, of either sign, that the register may get; default 0.05.
    #[serde(default)]
    pub wear_largest: Option<f64>,
    /// Value of the register with which the program is simulated; default 0.
    #[serde(default)]
    pub wear_value: Option<f64>,
}

fn fifth() -> f64 {
    0.2
}
