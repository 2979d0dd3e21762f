//! Words that the tables of several operations share.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::program::RotarySolution;

/// A tilted plane, in part coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneTable {
    /// Its zero: what the coordinates and heights of the operation count from.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Direction of its X.
    #[schemars(example = vec![1, 0, 0])]
    pub x: [f64; 3],
    /// Direction of its Z, from the part to the spindle.
    #[schemars(example = vec![0, 0, 1])]
    pub z: [f64; 3],
    /// Position of the rotary axes, of the two possible: the axis next to the tool positive or negative; default:
    /// the nearer one, as the control chooses.
    #[serde(default)]
    pub branch: RotarySolution,
}

/// Feeds of a program where the axes cannot hold those of the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FeedsName {
    /// Lowered to what the axes can hold.
    WithinLimits,
    /// Those of the job.
    AsProgrammed,
}

/// Form of the directions of the tool in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OrientationName {
    /// As vectors, with control of the tool centre point.
    Vectors,
    /// As angles of the rotary axes, with control of the tool centre point.
    Angles,
    /// As positions of all axes, without it.
    Axes,
}
