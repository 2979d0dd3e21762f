//! Tool and move as written for `kinecut envelope`: lengths in mm, angles in degrees.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::job::file::ContourTable;
use crate::sweep::{ScrewMove, TipMove, TipPath};
use crate::verbs::program_line::ProgramLineTable;

/// A tool and its move: give exactly one of `move`, `joints`, `screw`, `of`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnvelopeTable {
    /// Its title.
    #[serde(default)]
    pub title: Option<String>,
    /// The tool, as in `kinecut schema contour`; a line of a program has that of the program when none is given.
    #[serde(default)]
    pub tool: Option<ContourTable>,
    /// A file with the tool instead: a table in TOML or JSON, its elements in JSON, half of its section as .dxf or .svg.
    #[serde(default)]
    pub tool_file: Option<String>,
    /// The way of the tip, and of the direction of the tool.
    #[serde(default, rename = "move")]
    pub way: Option<TipMove>,
    /// Positions of a machine's axes.
    #[serde(default)]
    pub joints: Option<JointsTable>,
    /// A pose and a constant twist.
    #[serde(default)]
    pub screw: Option<ScrewMove>,
    /// A line of a job's program.
    #[serde(default)]
    pub of: Option<ProgramLineTable>,
    /// Share of the move up to which it is swept, above 0 to 1; default 1.
    #[serde(default)]
    pub until: Option<f64>,
    /// Largest distance of the mesh from the envelope, mm; default 0.01.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Distance of the lines by which the mesh is trimmed, mm: what is thinner may be missing; default: that of about 400 000 lines.
    #[serde(default)]
    pub step: Option<f64>,
    /// Most sample points in JSON; default 400.
    #[serde(default)]
    pub points: Option<u32>,
}

/// A move of all axes of a machine, straight from position to position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointsTable {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows.
    #[schemars(example = &"mill.toml")]
    pub machine: String,
    /// Length of the tool from the gauge point, mm; default 0.
    #[serde(default)]
    pub length: Option<f64>,
    /// Positions at the start by letter: mm, degrees; axes that are not named are at zero.
    #[schemars(example = serde_json::json!({ "X": 0, "C": 0 }))]
    pub from: BTreeMap<String, f64>,
    /// Positions at the end by letter; axes that are not named stay.
    #[schemars(example = serde_json::json!({ "X": 50, "C": 90 }))]
    pub to: BTreeMap<String, f64>,
    /// Control of the tool centre point: the tip keeps to this curve in workpiece coordinates, and only the rotary axes go
    /// straight from position to position.
    #[serde(default)]
    pub tip: Option<TipPath>,
}
