//! Bodies of a machine as written in its file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BoxTable;

/// A body of a machine: what carries it, and one form, in the frame of the machine with all axes at zero.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyTable {
    /// Its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The link that carries it: an axis by its letter (inclined ones by the digit of the code), "bed", "work" (the
    /// holder of the workpiece) or "spindle" (the holder of the tool).
    #[schemars(example = &"Z")]
    pub link: String,
    /// A box along the axes of the machine.
    #[serde(default, rename = "box", skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<BoxTable>,
    /// A cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<BodyCylinderTable>,
    /// A closed STL mesh: a file in the folder of the machine file, in the frame of the machine with all axes at zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<String>,
    /// Least distance that other bodies are to keep from it; nearer is a warning, 0 asks for none. Default 0.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near: Option<f64>,
}

/// A cylinder along any direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyCylinderTable {
    /// Centre of one end.
    #[schemars(example = vec![0, 0, 100])]
    pub base: [f64; 3],
    /// Direction from there to the other end; default [0, 0, 1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// Diameter.
    #[schemars(example = 80)]
    pub diameter: f64,
    /// Length along the axis.
    #[schemars(example = 200)]
    pub height: f64,
}
