//! Tool and motion as written for `kinecut grazing`: lengths in mm, speeds in mm/min, turning in degrees/min.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::job::file::ContourTable;
use crate::sweep::GivenTwist;
use crate::verbs::program_line::ProgramLineTable;

/// A tool and its motion at one moment: give exactly one of `twist`, `pose` with `rate`, `moment`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrazingTable {
    /// Its title.
    #[serde(default)]
    pub title: Option<String>,
    /// The tool, as in `kinecut schema contour`; a moment of a program has that of the program when none is given.
    #[serde(default)]
    pub tool: Option<ContourTable>,
    /// A file with the tool instead: a table in TOML or JSON, its elements in JSON, half of its section as .dxf or .svg.
    #[serde(default)]
    pub tool_file: Option<String>,
    /// The motion as a twist in coordinates of the tool.
    #[serde(default)]
    pub twist: Option<GivenTwist>,
    /// The motion as a pose, tool to workpiece: rows of the matrix [R p], or of [R p; 0 1].
    #[serde(default)]
    pub pose: Option<Vec<Vec<f64>>>,
    /// With `pose`: its derivative per second, rows of [R' p'], or of [R' p'; 0 0]. Another unit than the second scales the
    /// speeds and leaves the curve as it is.
    #[serde(default)]
    pub rate: Option<Vec<Vec<f64>>>,
    /// The motion as a moment of a move of a job's program.
    #[serde(default)]
    pub moment: Option<MomentTable>,
    /// Largest distance of chords of the points in JSON from the curve, mm; default 0.01.
    #[serde(default)]
    pub tolerance: Option<f64>,
}

/// A moment of a move.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MomentTable {
    /// The job file: machine, control, tools, set-ups.
    #[schemars(example = &"job.toml")]
    pub job: String,
    /// A program of this job's control; default: the one that the job posts.
    #[serde(default)]
    pub program: Option<String>,
    /// Number of the set-up, from 1; default 1.
    #[serde(default)]
    pub setup: Option<u32>,
    /// Line of the program, from 1.
    #[schemars(example = 12)]
    pub line: u32,
    /// Share of the way of its move, from 0 to 1; default 0.5.
    #[serde(default)]
    pub part: Option<f64>,
}

impl MomentTable {
    /// The line whose move it is.
    pub(crate) fn program_line(&self) -> ProgramLineTable {
        let MomentTable { job, program, setup, line, .. } = self;
        ProgramLineTable { job: job.clone(), program: program.clone(), setup: *setup, line: *line }
    }
}
