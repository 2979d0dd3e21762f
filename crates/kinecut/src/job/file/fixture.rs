//! Clamps and fixtures of a job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{BoxTable, CylinderTable};

/// A body that holds the part or stands beside it, in the coordinates of the work offset: no tool, shank or holder may touch it. It has
/// one form: `box`, `cylinder`, `mesh`, `vise` or `clamp`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixtureTable {
    /// Name, as findings say it.
    #[schemars(example = &"vise")]
    pub name: String,
    /// Numbers of the setups in which it is there, from 1; default: all.
    #[serde(default)]
    pub setups: Option<Vec<u32>>,
    /// Place of its own zero in the coordinates of the work offset; default: the work zero.
    #[serde(default)]
    pub at: Option<[f64; 3]>,
    /// Turn about Z through its own zero, degrees, against the clock seen from above; default 0.
    #[serde(default)]
    pub turn: Option<f64>,
    /// Least distance that tools keep from it: nearer is a warning, 0 asks for none. Default 0.5.
    #[serde(default)]
    pub near: Option<f64>,
    /// A block.
    #[serde(default, rename = "box")]
    pub block: Option<BoxTable>,
    /// A round body along Z.
    #[serde(default)]
    pub cylinder: Option<CylinderTable>,
    /// File of a closed STL mesh.
    #[serde(default)]
    pub mesh: Option<String>,
    /// A vise.
    #[serde(default)]
    pub vise: Option<ViseTable>,
    /// A clamping strap with its bolt.
    #[serde(default)]
    pub clamp: Option<ClampTable>,
}

/// A vise: two jaws along X that close along Y, and a bed. Its own zero is in the middle between the jaws, at the height on which
/// the part lies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViseTable {
    /// Width of the jaws, along X.
    #[schemars(example = 150)]
    pub jaw_width: f64,
    /// Distance of the jaws as the part is held.
    #[schemars(example = 60)]
    pub opening: f64,
    /// Height of the jaws above the part's seat.
    #[schemars(example = 40)]
    pub jaw_height: f64,
    /// Thickness of a jaw, along Y.
    #[schemars(example = 30)]
    pub jaw_thickness: f64,
    /// Height of the parallels on which the part lies: so far below its seat is the top of the bed. Default 0.
    #[serde(default)]
    pub parallels: Option<f64>,
    /// Height of the bed below its top; default 40.
    #[serde(default)]
    pub bed: Option<f64>,
}

/// A strap along X with a bolt through it. Its own zero is in the middle of the lower edge of its tip, from which it goes to X+.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClampTable {
    /// Length of the strap, along X.
    #[schemars(example = 80)]
    pub length: f64,
    /// Width of the strap, along Y.
    #[schemars(example = 30)]
    pub width: f64,
    /// Thickness of the strap.
    #[schemars(example = 15)]
    pub thickness: f64,
    /// Distance of the bolt from the tip; default: half of the length.
    #[serde(default)]
    pub bolt_at: Option<f64>,
    /// Diameter of nut and bolt above the strap; default: half of the width.
    #[serde(default)]
    pub bolt_diameter: Option<f64>,
    /// Height of nut and bolt above the strap; default: as the strap is thick.
    #[serde(default)]
    pub bolt_height: Option<f64>,
}
