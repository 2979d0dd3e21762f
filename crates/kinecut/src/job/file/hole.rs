//! Holes by their size as written in the job file.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de};

use crate::base::unit::Deg;
use crate::operations::CalledTool;
use crate::operations::drill::DrillTable;
use crate::operations::places::PatternTable;
use crate::program::Coolant;

/// Holes of one size. They become operations, each with a tool that is taken by its diameter: a spot drill, a drill, then a
/// reamer, a tap or a thread mill where the size asks for one. Of holes that follow one another in a setup all are spotted first,
/// then drilled, then brought to size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HoleTable {
    /// Size: a diameter, 6.6; a diameter with the fit that a reamer makes, "8H7"; a metric thread, "M8" with the coarse pitch
    /// of ISO 261 or "M8x1".
    #[schemars(example = &"M8")]
    pub size: HoleSize,
    /// Places of the holes, in coordinates of the work offset.
    #[serde(default)]
    pub points: Option<Vec<[f64; 2]>>,
    /// Places of the holes as a pattern.
    #[serde(default)]
    pub pattern: Option<PatternTable>,
    /// Height from which `depth` counts, in coordinates of the work offset; default: that of the face milled last before it
    /// in its setup, else 0.
    #[serde(default)]
    pub top: Option<f64>,
    /// Depth below `top` of the full diameter, or of full thread; default: through the stock.
    #[serde(default)]
    pub depth: Option<f64>,
    /// Width of the chamfer at the mouth that the spot drill leaves; default 0.2.
    #[serde(default)]
    pub chamfer: Option<f64>,
    /// Whether a spot drill goes before the drill; default true.
    #[serde(default = "yes")]
    pub spot: bool,
    /// Diameter of the drill before a reamer, a tap or a thread mill; default: of a fit 0.1 to 0.2 less than the size up to 10,
    /// 0.2 to 0.3 less up to 20, 0.3 to 0.5 less above; of a thread its diameter less its pitch.
    #[serde(default)]
    pub pilot: Option<f64>,
    /// The spot drill, where it is not to be chosen: its number, or its name.
    #[serde(default)]
    pub spot_drill: Option<CalledTool>,
    /// The drill, where it is not to be chosen.
    #[serde(default)]
    pub drill: Option<CalledTool>,
    /// The reamer, tap or thread mill, where it is not to be chosen.
    #[serde(default)]
    pub tool: Option<CalledTool>,
    /// A conical recess at the mouth, for a countersunk screw.
    #[serde(default)]
    pub countersink: Option<CountersinkTable>,
    /// A flat recess at the mouth, for the head of a screw.
    #[serde(default)]
    pub counterbore: Option<CounterboreTable>,
    /// Height of the moves between holes, in coordinates of the work offset; default: the setup's safe height.
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
}

/// A conical recess at the mouth of a hole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CountersinkTable {
    /// Diameter at the mouth.
    #[schemars(example = 12.6)]
    pub diameter: f64,
    /// Full angle of the cone; degrees in a file, default 90.
    #[serde(default = "right_angle", with = "Deg")]
    pub angle: f64,
    /// The countersink or spot drill, where it is not to be chosen: its number, or its name.
    #[serde(default)]
    pub tool: Option<CalledTool>,
}

/// A flat recess at the mouth of a hole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CounterboreTable {
    /// Diameter.
    #[schemars(example = 11)]
    pub diameter: f64,
    /// Depth of its floor below `top`.
    #[schemars(example = 6.8)]
    pub depth: f64,
    /// The counterbore, where it is not to be chosen: its number, or its name.
    #[serde(default)]
    pub tool: Option<CalledTool>,
}

fn right_angle() -> f64 {
    std::f64::consts::FRAC_PI_2
}

/// A hole in a setup: its place among the entries of `operation` in the text, and its table.
pub(crate) type ListedHole = (usize, HoleTable);

fn yes() -> bool {
    true
}

/// A size: a diameter, or a text.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum HoleSize {
    /// A diameter.
    Diameter(f64),
    /// A diameter, a diameter with a fit, a thread.
    Text(String),
}

impl fmt::Display for HoleSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            HoleSize::Diameter(diameter) => write!(f, "{diameter}"),
            HoleSize::Text(text) => write!(f, "{}", text.trim()),
        }
    }
}

impl<'de> Deserialize<'de> for HoleSize {
    // By hand, so that an error says what a size is.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<HoleSize, D::Error> {
        struct NumberOrText;

        impl de::Visitor<'_> for NumberOrText {
            type Value = HoleSize;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a diameter, or a size such as \"8H7\" or \"M8\"")
            }

            fn visit_f64<E: de::Error>(self, v: f64) -> Result<HoleSize, E> {
                Ok(HoleSize::Diameter(v))
            }

            fn visit_i64<E: de::Error>(self, v: i64) -> Result<HoleSize, E> {
                Ok(HoleSize::Diameter(v as f64))
            }

            fn visit_u64<E: de::Error>(self, v: u64) -> Result<HoleSize, E> {
                Ok(HoleSize::Diameter(v as f64))
            }

            fn visit_str<E: de::Error>(self, v: &str) -> Result<HoleSize, E> {
                Ok(HoleSize::Text(v.to_owned()))
            }
        }

        deserializer.deserialize_any(NumberOrText)
    }
}

/// A spot as an entry of a setup's operations.
#[derive(JsonSchema)]
#[serde(tag = "type")]
#[allow(dead_code, reason = "the schema of a job")]
pub(crate) enum SpotEntry {
    /// Spots for the drills that follow: `drill` with the method `centring`.
    #[serde(rename = "spot")]
    Spot(Box<DrillTable>),
}

/// A hole as an entry of a setup's operations.
#[derive(JsonSchema)]
#[serde(tag = "type")]
#[allow(dead_code, reason = "the schema of a job")]
pub(crate) enum HoleEntry {
    /// Holes by their size, with tools chosen by diameter.
    #[serde(rename = "hole")]
    Hole(Box<HoleTable>),
}

/// An entry of a setup's operations.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "the schema of a job")]
pub(crate) enum OperationEntry {
    /// An operation.
    Operation(crate::operations::OperationTable),
    /// Spots.
    Spot(SpotEntry),
    /// Holes, which become operations.
    Hole(HoleEntry),
}
