//! A tool path with directions of the tool, as the job file writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::operations::CalledTool;
use crate::program::Coolant;

/// A tool path that comes from elsewhere: points of the tool tip with directions of the tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathTable {
    /// The tool: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Spindle speed, rev/min.
    #[schemars(example = 8000)]
    pub speed: f64,
    /// Feed of the tip, mm/min; a file may give its own.
    #[schemars(example = 1500)]
    pub feed: f64,
    /// The points: `[x, y, z]`, or `[x, y, z, i, j, k]` with the direction from tip to holder; a point without direction
    /// keeps that of the point before. In coordinates of the work offset. Either this or `file`.
    #[serde(default)]
    pub points: Vec<Vec<f64>>,
    /// A file of cutter locations in the words of APT (`GOTO/`, `RAPID`, `FEDRAT/`, `MULTAX`).
    #[serde(default)]
    pub file: Option<String>,
    /// Distance along the tool from which the first point is reached at feed and to which the last is left; default: 10.
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Coolant.
    #[serde(default)]
    pub coolant: Coolant,
}
