//! Tools of any form of revolution as written in files: a shape, and what carries it. Lengths in mm, angles in degrees.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::tool::{HolderSegment, ToolForm};

/// A tool of revolution: its shape, shank and holder. Heights are counted from the tip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourTable {
    /// Name to show.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Shape of the cutting part.
    pub shape: ToolForm,
    /// Diameter of the shank above it; default: that of its upper end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shank_diameter: Option<f64>,
    /// Height of the holder's face, and of the shank's end, above the tip; default: the end of the shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stickout: Option<f64>,
    /// Segments of the holder, from its face upwards.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holder: Vec<HolderSegment>,
}
