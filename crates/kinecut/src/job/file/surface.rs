//! A surface as written in a file: its generating lines as chains of motions with laws.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A surface by its generating lines; lengths in mm, angles in radians, because laws are formulas: `alpha = "20*pi/180"`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceTable {
    /// A surface of the catalogue of which the other keys change what they name: "cone"; `kinecut surface` lists them.
    #[serde(default)]
    pub like: Option<String>,
    /// Short name; default: that of the file.
    #[serde(default)]
    pub name: Option<String>,
    /// What it is.
    #[serde(default)]
    pub title: Option<String>,
    /// Parameters of the laws, numbers or formulas of numbers: `parameters = { R = 30, alpha = "20*pi/180" }`.
    #[serde(default)]
    pub parameters: BTreeMap<String, NumberEntry>,
    /// The two free variables with their domains: `variables = [["phi", 0, "2*pi"], ["z", 0, 50]]`. The normal is that of
    /// their order.
    #[serde(default)]
    pub variables: Vec<(String, NumberEntry, NumberEntry)>,
    /// Chain of the line along which the other one is carried: "6(phi) 1(R)", or [[6, "phi"], [1, "R"]].
    #[serde(default)]
    pub directrix: Option<ChainEntry>,
    /// Chain of the line that is carried. What the directrix ends with and it begins with is one motion.
    #[serde(default)]
    pub generatrix: Option<ChainEntry>,
    /// Whether the normal points into the material; default false.
    #[serde(default)]
    pub inward: Option<bool>,
    /// Directions of the motions 7, 8, 9: `inclined = { 7 = [0, 1, 1] }`.
    #[serde(default)]
    pub inclined: BTreeMap<String, [f64; 3]>,
    /// A formula in X, Y, Z and the parameters that vanishes on the surface and is positive outside of the material.
    #[serde(default)]
    pub implicit: Option<String>,
}

/// A number, or a formula of numbers: 30, "20*pi/180".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum NumberEntry {
    /// A number.
    Number(f64),
    /// A formula of numbers.
    Formula(String),
}

/// A chain of motions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ChainEntry {
    /// "6(phi) 1(R)".
    Text(String),
    /// [[6, "phi"], [1, "R"]]: digits with their laws.
    List(Vec<(u8, NumberEntry)>),
}

/// The JSON Schema of a surface in a file of its own.
pub fn surface_schema() -> serde_json::Value {
    schemars::schema_for!(SurfaceTable).to_value()
}
