//! Milling operations as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PlaneTable;

/// Milling of an elliptic pocket: a spiral that grows from a circle into the ellipse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipseTable {
    /// A tilted plane in which to work: the tool stands along its Z. Without it the tool stands along the Z of the work
    /// offset. Needs a machine with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// Number of the tool.
    pub tool: u32,
    /// Centre, in coordinates of the work offset.
    pub at: [f64; 2],
    /// Height of the upper rim, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Half axes of the finished pocket.
    pub half_axes: [f64; 2],
    /// Direction of the first half axis from X, degrees; default 0.
    #[serde(default)]
    pub angle: f64,
    /// Depth below the rim.
    pub depth: f64,
    /// How far the tool goes below the depth, for a pocket that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default)]
    pub leave: f64,
    /// Stock to leave on the floor; default 0.
    #[serde(default)]
    pub leave_floor: f64,
    /// Largest allowed deviation of wall and floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Contact of the spiral with the wall; default G4.
    #[serde(default = "fourth")]
    pub contact: ContactName,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Direction,
    /// How the cutter gets to depth; default: a helix that leaves no core.
    #[serde(default)]
    pub entry: Option<EntryTable>,
    /// Spindle speed, rev/min.
    pub speed: f64,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: CoolantName,
    /// Roughing.
    pub rough: RoughTable,
    /// Finishing; left out, the allowance stays.
    #[serde(default)]
    pub finish: Option<EllipseFinishTable>,
}

fn fourth() -> ContactName {
    ContactName::G4
}

/// Finishing of an elliptic pocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipseFinishTable {
    /// Feed, mm/min.
    pub feed: f64,
    /// Further laps at the wall without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default)]
    pub axial_step: Option<f64>,
}

/// Milling of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoreTable {
    /// A tilted plane in which to work: the tool stands along its Z. Without it the tool stands along the Z of the work
    /// offset. Needs a machine with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// Number of the tool.
    pub tool: u32,
    /// Centre, in coordinates of the work offset.
    pub at: [f64; 2],
    /// Height of the upper rim, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Diameter of the finished bore; of a conical one at its rim.
    pub diameter: f64,
    /// Diameter at the depth, for a bore that narrows downwards; it is milled in steps, level by level.
    #[serde(default)]
    pub bottom_diameter: Option<f64>,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default)]
    pub leave: f64,
    /// Stock to leave on the floor of a blind bore; default 0.
    #[serde(default)]
    pub leave_floor: f64,
    /// Depth below the rim.
    pub depth: f64,
    /// How far the tool goes below the depth, for a bore that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Largest allowed deviation of the bore's radius and floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// How the cutter moves.
    pub strategy: BoreStrategy,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Direction,
    /// How the cutter gets to depth; default: a helix that leaves no core.
    #[serde(default)]
    pub entry: Option<EntryTable>,
    /// Spindle speed, rev/min.
    pub speed: f64,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: CoolantName,
    /// Roughing; left out, only the wall is finished.
    #[serde(default)]
    pub rough: Option<RoughTable>,
    /// Finishing; left out, the allowance stays.
    #[serde(default)]
    pub finish: Option<FinishTable>,
}

/// How the cutter moves in a bore.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BoreStrategy {
    /// Circle involutes: smooth in velocity and acceleration, a small step of jerk at the wall. After a helix or in a
    /// pre-drilled hole from that circle, else from the centre.
    Involute,
    /// Circle involutes between two circles: as `involute`, but never from the centre.
    Annular,
    /// Lens involutes of order 1: the same length, smooth to the second derivative of jerk (contact G4).
    #[serde(rename = "lens-1")]
    Lens1,
    /// Lens involutes of order 2: contact G6.
    #[serde(rename = "lens-2")]
    Lens2,
    /// Spiral that keeps the engagement angle `rough.engagement`, with `rough.step` as a cap; contact G4.
    ConstantEngagement,
    /// Semicircles about two poles: a step of acceleration in every joint.
    #[serde(rename = "arcs-2")]
    Arcs2,
    /// Quarter circles about four poles.
    #[serde(rename = "arcs-4")]
    Arcs4,
    /// Archimedean spiral: meets the wall with a kink.
    Archimedean,
    /// Concentric rings joined by radial lines: the machine stops at each corner.
    Rings,
    /// Concentric rings joined by tangent arcs.
    RingsTangent,
    /// Trochoidal loops along a ring.
    Trochoidal,
    /// Down along a spiral to the wall and back in its plane, level by level: no plunge.
    Ramping,
    /// One helix at the wall with a level foot, for bores smaller than two cutter diameters.
    Helix,
    /// One helix at the wall of a through bore of any size: the core falls out.
    OutlineHelix,
}

/// Climb or conventional milling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Climb: counter-clockwise in a bore.
    #[default]
    Climb,
    /// Conventional: clockwise in a bore.
    Conventional,
}

/// How the cutter gets to depth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum EntryTable {
    /// Straight down; needs a cutter that cuts at its centre.
    Plunge,
    /// Down a helix.
    Helix(HelixTable),
    /// Into a hole that is there.
    PreDrilled(PreDrilledTable),
}

/// A helix into the material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HelixTable {
    /// Radius of the tool centre's helix; below the cutter's radius no core is left.
    pub radius: f64,
    /// Depth of one turn.
    pub pitch: f64,
}

/// A hole that is there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PreDrilledTable {
    /// Diameter of the hole about the bore's centre.
    pub diameter: f64,
}

/// Coolant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CoolantName {
    /// None.
    Off,
    /// Mist.
    Mist,
    /// Flood.
    #[default]
    Flood,
}

/// Roughing of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoughTable {
    /// Largest distance of neighbouring turns.
    pub step: f64,
    /// Largest engagement angle of the cutter, degrees, for `constant-engagement`.
    #[serde(default)]
    pub engagement: Option<f64>,
    /// Largest descent of a turn, for `helix` and `outline-helix`; default: as steep as the cutter is known to follow.
    #[serde(default)]
    pub pitch: Option<f64>,
    /// Allowance left on the wall for finishing; default 0.
    #[serde(default)]
    pub allowance: f64,
    /// Feed, mm/min.
    pub feed: f64,
    /// Feed of plunge and helix, mm/min; default: a quarter of the feed.
    #[serde(default)]
    pub plunge_feed: Option<f64>,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default)]
    pub axial_step: Option<f64>,
    /// Point at which the spiral starts instead of the centre, in coordinates of the work offset.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
}

/// Finishing of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FinishTable {
    /// Turns that the lead-in's involute would have from the centre; default 2.
    #[serde(default)]
    pub turns: Option<u32>,
    /// Contact of the lead-in with the wall; default G2, with the shortest sliver.
    #[serde(default)]
    pub contact: ContactName,
    /// Feed, mm/min.
    pub feed: f64,
    /// Whether the feed is that of the cutter's centre or that of its edge at the wall; default centre.
    #[serde(default)]
    pub feed_at: FeedAt,
    /// Point at which the lead-in starts, in coordinates of the work offset; default: half a turn before the wall.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-in starts.
    #[serde(default)]
    pub start_radius: Option<f64>,
    /// Length of the lead-in.
    #[serde(default)]
    pub start_length: Option<f64>,
    /// Point at which the lead-out ends, in coordinates of the work offset; default: the mirror image of the lead-in's.
    #[serde(default)]
    pub end: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-out ends.
    #[serde(default)]
    pub end_radius: Option<f64>,
    /// Length of the lead-out.
    #[serde(default)]
    pub end_length: Option<f64>,
    /// Further circles at the wall without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Register of the control by whose value the wall is moved at the machine: "D2".
    #[serde(default)]
    pub wear_offset: Option<String>,
    /// Largest value, of either sign, that the register may get; default 0.1.
    #[serde(default)]
    pub wear_largest: Option<f64>,
    /// Value of the register with which the program is simulated; default 0.
    #[serde(default)]
    pub wear_value: Option<f64>,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default)]
    pub axial_step: Option<f64>,
}

/// Contact of a lead with the wall: how many derivatives agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactName {
    /// Curvature: a circle involute.
    #[default]
    G2,
    /// To the fourth derivative: a lens involute of order 1.
    G4,
    /// To the sixth: order 2.
    G6,
}

/// Where a feed is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FeedAt {
    /// At the cutter's centre.
    #[default]
    Centre,
    /// At the wall, where the edge's envelope runs on the larger circle.
    Wall,
}
