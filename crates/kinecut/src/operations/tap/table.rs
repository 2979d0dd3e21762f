//! Tapping operations as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::operations::core_hole::CoreTable;
use crate::operations::places::PatternTable;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// Tapping of one or many core holes with one tap; its pitch is the tool's, its feed pitch times speed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TapTable {
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// The tool, a tap: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Places of the holes, in coordinates of the work offset.
    #[serde(default)]
    pub points: Option<Vec<[f64; 2]>>,
    /// Places of the holes as a pattern.
    #[serde(default)]
    pub pattern: Option<PatternTable>,
    /// Height at which the thread begins, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Depth of full thread below `top`; the lead of the tap goes deeper. Default: through the stock.
    #[serde(default)]
    pub depth: Option<f64>,
    /// The core holes, where neither an operation before nor `drilled` says them.
    #[serde(default)]
    pub core: Option<CoreTable>,
    /// Cutting speed at the nominal diameter, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Spindle speed, rev/min.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Height above `top` from which feed and spindle run together, at least three pitches; default three pitches.
    #[serde(default)]
    pub approach: Option<f64>,
    /// Height of the moves between holes, in coordinates of the work offset; default: the setup's safe height.
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
}
