//! Milling of a bore as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::program::Coolant;

use crate::holes::Sense;
use crate::operations::PlaneTable;
use crate::operations::wall::{EntryTable, FinishTable, RoughTable};

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
    #[serde(default, alias = "leave")]
    pub stock_to_leave: f64,
    /// Stock to leave on the floor of a blind bore; default 0.
    #[serde(default, alias = "leave_floor")]
    pub stock_to_leave_floor: f64,
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
    pub direction: Sense,
    /// How the cutter gets to depth; default: a helix that leaves no core.
    #[serde(default)]
    pub entry: Option<EntryTable>,
    /// Spindle speed, rev/min.
    pub speed: f64,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
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
