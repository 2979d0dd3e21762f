//! Tools and holders as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::unit::Deg;
use crate::tool::{DrillPoint, Hand};

/// Kinds of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToolType {
    /// Flat end mill.
    EndMill,
    /// Face mill; `entering_angle` and `corner_radius` say what its edge is like.
    FaceMill,
    /// Ball-nose end mill.
    BallNose,
    /// End mill with a corner radius.
    BullNose,
    /// Conical cutter.
    Tapered,
    /// Drill, countersink, reamer: a tool that works along its axis; its shape is given by `point`.
    Drill,
}

/// A tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolTable {
    /// Number on the control.
    pub number: u32,
    /// What a person calls it.
    #[serde(default)]
    pub name: Option<String>,
    /// Kind.
    #[serde(rename = "type")]
    pub kind: ToolType,
    /// Diameter (of a tapered cutter: of its flat tip, 0 for a sharp one; of a face mill: at the finished plane).
    pub diameter: f64,
    /// Corner radius of a bull-nose end mill, or of a face mill with an entering angle of 90 degrees.
    #[serde(default)]
    pub corner_radius: Option<f64>,
    /// Entering angle of a face mill (KAPR, between the edge and the finished plane), degrees; default 90. The diameter
    /// grows with the height: diameter + 2 flute_length / tan(entering_angle) at most.
    #[serde(default)]
    pub entering_angle: Option<f64>,
    /// Angle between axis and edge of a tapered cutter, degrees.
    #[serde(default)]
    pub half_angle: Option<f64>,
    /// Full point angle of a twist drill, degrees; default 118. Other points: see `point`.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub point_angle: Option<f64>,
    /// Point of a drill that is no plain twist drill: "flat", { double-ground = { .. } }, { gun = { .. } }, ..
    #[serde(default)]
    pub point: Option<DrillPoint>,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
    /// Number of teeth; default 2.
    #[serde(default)]
    pub teeth: Option<u32>,
    /// Angle of each tooth about the axis, degrees, ascending from 0; default: evenly spaced.
    #[serde(default)]
    pub tooth_angles: Option<Vec<f64>>,
    /// By how much each tooth stands out of the nominal radius; default 0.
    #[serde(default)]
    pub runout: Option<Vec<f64>>,
    /// Height of the holder's face above the tip; default: the flute length.
    #[serde(default)]
    pub stickout: Option<f64>,
    /// Diameter of the shank; default: that of the cutter.
    #[serde(default)]
    pub shank_diameter: Option<f64>,
    /// Name of the holder.
    #[serde(default)]
    pub holder: Option<String>,
    /// Length from the spindle's gauge point to the tip.
    #[serde(default)]
    pub gauge_length: Option<f64>,
    /// Whether it cuts at its centre and may plunge; default: true for a drill, ball-nose and for end mills up to
    /// 20 mm, false for larger ones, which mostly carry indexable inserts.
    #[serde(default)]
    pub centre_cutting: Option<bool>,
    /// Steepest ramp it may follow, degrees.
    #[serde(default)]
    pub max_ramp_angle: Option<f64>,
    /// The sense in which it cuts: "right" turns with M3, "left" with M4; default "right".
    #[serde(default)]
    pub hand: Hand,
    /// Largest speed of the spindle with it, rev/min.
    #[serde(default)]
    pub max_speed: Option<f64>,
    /// Largest feed, mm/min.
    #[serde(default)]
    pub max_feed: Option<f64>,
}
