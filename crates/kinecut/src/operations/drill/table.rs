//! Drilling operations as written in the job file.

use std::fmt;

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use crate::drilling::{DrillMethod, FeedChoice};
use crate::operations::places::PatternTable;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// Drilling and its kin: one or many holes with one tool, each with feed zones of its own.
///
/// The surfaces are those of the part if `entry` is left out: of the stock, or of `body`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrillTable {
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// The tool, a drill: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Kind of drilling; default drilling.
    #[serde(default)]
    pub method: DrillMethod,
    /// Places of the holes, in coordinates of the work offset.
    #[serde(default)]
    pub points: Option<Vec<[f64; 2]>>,
    /// Places of the holes as a pattern.
    #[serde(default)]
    pub pattern: Option<PatternTable>,
    /// The surface that the drill enters; default: that of the body.
    #[serde(default)]
    pub entry: Option<FaceTable>,
    /// The surface that it leaves: "same" for the other side of the same shaft, or a surface.
    #[serde(default)]
    pub exit: Option<ExitTable>,
    /// Mesh (STL, part coordinates) whose surfaces the drill meets, instead of the stock.
    #[serde(default)]
    pub body: Option<String>,
    /// Height of the entry's frame (a point of the plane, the axis of the cylinder), in coordinates of the work offset;
    /// default 0.
    #[serde(default)]
    pub top: f64,
    /// Distance of the exit's frame below that of the entry; default 0.
    #[serde(default)]
    pub length: Option<f64>,
    /// For a blind hole: how deep below the entry's frame the full diameter reaches everywhere. Where that is out of the stock, the
    /// hole goes through, as deep.
    #[serde(default)]
    pub depth: Option<f64>,
    /// For a blind hole: Z of the tip, in coordinates of the work offset.
    #[serde(default)]
    pub tip: Option<f64>,
    /// For a centre hole or countersink: the diameter that is reached all round.
    #[serde(default)]
    pub reach_diameter: Option<f64>,
    /// A hole that is there.
    #[serde(default)]
    pub pre_hole: Option<PreHoleTable>,
    /// Bores that the drill meets on its way.
    #[serde(default, rename = "cross_bore")]
    pub cross_bores: Vec<CrossBoreTable>,
    /// Way at feed before the first contact; default 2.
    #[serde(default = "two")]
    pub approach: f64,
    /// Way beyond the last of the edge; default 2, for reaming a quarter of the diameter.
    #[serde(default)]
    pub overrun: Option<f64>,
    /// Largest distance of the surfaces from their drawn places, to either side; default 0.
    #[serde(default)]
    pub surface_tolerance: f64,
    /// Cutting speed at the largest diameter that cuts, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Spindle speed, rev/min.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Feeds, mm per revolution; default: that of the tool's preset for the material.
    #[serde(default)]
    pub feed_per_rev: Option<FeedChoice>,
    /// Steps of the steady stretch.
    #[serde(default)]
    pub peck: Option<PeckTable>,
    /// Steps that it takes where it turns out deeper than a length [mm], for a hole of a size that goes through.
    #[serde(skip)]
    pub peck_deep: Option<(f64, PeckTable)>,
    /// Wait at the bottom, seconds; default 0.
    #[serde(default)]
    pub dwell: f64,
    /// Whether a bush or pilot guides the drill, so that its corner may touch first; default false.
    #[serde(default)]
    pub guided: bool,
    /// Height of the moves between holes, in coordinates of the work offset; default: the setup's safe height.
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Whether one-feed holes and pecked stretches become the control's own cycles where it has them; default true.
    #[serde(default = "yes")]
    pub cycles: bool,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
    /// Largest allowed deviation of the wall; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
}

impl DrillTable {
    /// One in which all that has a usual value has it.
    pub(crate) fn usual() -> DrillTable {
        DrillTable { approach: two(), cycles: yes(), ..DrillTable::default() }
    }
}

fn two() -> f64 {
    2.0
}

fn yes() -> bool {
    true
}

/// Kinds of surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceName {
    /// A plane, square to the tool or inclined.
    Plane,
    /// The outside of a cylinder across the tool: a shaft.
    OuterCylinder,
    /// The inside of a cylinder across the tool: a bore.
    InnerCylinder,
}

/// A surface that a drill enters or leaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaceTable {
    /// Its kind.
    pub surface: SurfaceName,
    /// Radius of a cylinder.
    #[serde(default)]
    pub radius: Option<f64>,
    /// Angle of a plane to the plane square to the tool, degrees; positive rises along `direction`. Default 0.
    #[serde(default)]
    pub inclination: Option<f64>,
    /// Distance of the tool axis from the origin of the surface's frame: up the plane, or across the cylinder's axis.
    /// Default: from `at` and `direction`.
    #[serde(default)]
    pub offset: Option<f64>,
    /// The origin of the surface's frame, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: Option<[f64; 2]>,
    /// Direction in which a plane rises, or of a cylinder's axis, degrees from X; default 0.
    #[serde(default)]
    pub direction: Option<f64>,
}

/// The surface that a drill leaves.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ExitTable {
    /// The other side of the same shaft, or a plane parallel to the entry.
    Same,
    /// A surface.
    #[serde(untagged)]
    Face(FaceTable),
}

impl<'de> Deserialize<'de> for ExitTable {
    // By hand, so that an error tells what is wrong with the word or the surface.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<ExitTable, D::Error> {
        struct WordOrFace;

        impl<'de> Visitor<'de> for WordOrFace {
            type Value = ExitTable;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"same\" or a surface")
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<ExitTable, E> {
                match word {
                    "same" => Ok(ExitTable::Same),
                    other => Err(E::unknown_variant(other, &["same"])),
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ExitTable, A::Error> {
                FaceTable::deserialize(MapAccessDeserializer::new(map)).map(ExitTable::Face)
            }
        }

        deserializer.deserialize_any(WordOrFace)
    }
}

/// A hole that is there, along the tool axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PreHoleTable {
    /// Diameter.
    #[schemars(example = 8)]
    pub diameter: f64,
    /// Its centre, from that of the new hole; default [0, 0].
    #[serde(default)]
    pub offset: Option<[f64; 2]>,
    /// Z of its lower end, in coordinates of the work offset, if it is blind; the tip of a conical end.
    #[serde(default)]
    pub bottom: Option<f64>,
    /// Full angle of a conical lower end, degrees; default 180: flat.
    #[serde(default)]
    pub bottom_angle: Option<f64>,
}

/// A bore across the drill's way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CrossBoreTable {
    /// Diameter.
    #[schemars(example = 12)]
    pub diameter: f64,
    /// Z of its axis, in coordinates of the work offset.
    #[schemars(example = -15)]
    pub z: f64,
    /// Distance of the tool axis from its axis; default: from `at` and `direction`.
    #[serde(default)]
    pub offset: Option<f64>,
    /// A point of its axis, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub at: Option<[f64; 2]>,
    /// Direction of its axis, degrees from X; default 0.
    #[serde(default)]
    pub direction: Option<f64>,
}

/// Steps of the steady stretch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeckTable {
    /// Depth of a step.
    #[schemars(example = 3)]
    pub step: f64,
    /// Motion after each step; default: the chip is broken.
    #[serde(default)]
    pub after: PeckName,
}

/// Motion after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PeckName {
    /// A small lift breaks the chip.
    #[default]
    BreakChip,
    /// The drill comes out of the hole.
    Clear,
}
