//! Tool and move as written for `kinecut envelope`: lengths in mm, angles in degrees.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::job::file::ContourTable;

/// A tool and its move: give exactly one of `move`, `joints`, `screw`, `of`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnvelopeTable {
    /// What it is called.
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
    pub way: Option<WayTable>,
    /// Positions of a machine's axes.
    #[serde(default)]
    pub joints: Option<JointsTable>,
    /// A pose and a constant twist.
    #[serde(default)]
    pub screw: Option<ScrewTable>,
    /// A line of a job's program.
    #[serde(default)]
    pub of: Option<ProgramLineTable>,
    /// How far the mesh may leave the envelope, mm; default 0.01.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// How many sample points JSON has, at most; default 400.
    #[serde(default)]
    pub points: Option<u32>,
}

/// A curve of the tip: a straight line (`from`, `to`), or an arc or helix (`from`, `centre`, `turn`, `rise`, `about`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TipTable {
    /// Where the tip starts, mm.
    pub from: [f64; 3],
    /// End of a straight line, mm.
    #[serde(default)]
    pub to: Option<[f64; 3]>,
    /// A point of the axis of an arc, mm.
    #[serde(default)]
    pub centre: Option<[f64; 3]>,
    /// Angle of an arc, degrees, right-handed about `about`; two turns of a helix are 720.
    #[serde(default)]
    pub turn: Option<f64>,
    /// Movement along the axis of an arc over the whole of it, mm; default 0.
    #[serde(default)]
    pub rise: Option<f64>,
    /// Direction of the axis of an arc; default [0, 0, 1].
    #[serde(default)]
    pub about: Option<[f64; 3]>,
}

/// A move of the tip: a curve as of `tip`, and the direction of the tool along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WayTable {
    /// Where the tip starts, mm.
    pub from: [f64; 3],
    /// End of a straight line, mm.
    #[serde(default)]
    pub to: Option<[f64; 3]>,
    /// A point of the axis of an arc, mm.
    #[serde(default)]
    pub centre: Option<[f64; 3]>,
    /// Angle of an arc, degrees, right-handed about `about`; two turns of a helix are 720.
    #[serde(default)]
    pub turn: Option<f64>,
    /// Movement along the axis of an arc over the whole of it, mm; default 0.
    #[serde(default)]
    pub rise: Option<f64>,
    /// Direction of the axis of an arc; default [0, 0, 1].
    #[serde(default)]
    pub about: Option<[f64; 3]>,
    /// From the tip to the holder; of any length but zero; default [0, 0, 1].
    #[serde(default)]
    pub axis: Option<[f64; 3]>,
    /// The same at the end: the tool turns from one to the other in their plane, at a constant rate. Default: it does not
    /// turn.
    #[serde(default)]
    pub axis_to: Option<[f64; 3]>,
}

impl WayTable {
    /// The curve of the tip.
    pub fn tip(&self) -> TipTable {
        let WayTable { from, to, centre, turn, rise, about, .. } = *self;
        TipTable { from, to, centre, turn, rise, about }
    }
}

/// A move of all axes of a machine, straight from position to position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointsTable {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows.
    pub machine: String,
    /// Length of the tool from the gauge point, mm; default 0.
    #[serde(default)]
    pub length: Option<f64>,
    /// Positions at the start by letter: mm, degrees; axes that are not named stand at zero.
    pub from: BTreeMap<String, f64>,
    /// Positions at the end by letter; axes that are not named stay.
    pub to: BTreeMap<String, f64>,
    /// Control of the tool centre point: the tip keeps to this curve in workpiece coordinates, and only the rotary axes go
    /// straight from position to position.
    #[serde(default)]
    pub tip: Option<TipTable>,
}

/// A constant twist in coordinates of the tool, from a pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScrewTable {
    /// The pose at the start, tool to workpiece: rows of the matrix [R p], or of [R p; 0 1]; default: the tip at the zero,
    /// the tool upright.
    #[serde(default)]
    pub pose: Option<Vec<Vec<f64>>>,
    /// Velocity of the point `at` in coordinates of the tool, mm over the whole move.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Turning about X, Y, Z of the tool, degrees over the whole move.
    #[serde(default)]
    pub turn: [f64; 3],
    /// The point whose velocity is given, mm; default: the origin.
    #[serde(default)]
    pub at: [f64; 3],
}

/// A line of a job's program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProgramLineTable {
    /// The job file: machine, control, tools, set-ups.
    pub job: String,
    /// A program of this job's control; default: the one that the job posts.
    #[serde(default)]
    pub program: Option<String>,
    /// Number of the set-up, from 1; default 1.
    #[serde(default)]
    pub setup: Option<u32>,
    /// Line of the program, from 1. Where it makes several moves, each has its own envelope.
    pub line: u32,
}
