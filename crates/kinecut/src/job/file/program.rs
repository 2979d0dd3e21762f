//! A program that others wrote, as the job file names it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::nc::NumberInput;

/// A program in a file: it is read, simulated and judged as it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProgramTable {
    /// The file, in the folder of the job.
    #[schemars(example = &"O1234.nc")]
    pub file: String,
    /// The control that runs it; default: that of `post`.
    #[serde(default)]
    pub control: Option<String>,
    /// Coordinates without a decimal point on FANUC (parameter 3401): "calculator" (whole mm, inches, degrees),
    /// "least-increment" (0.001 mm or degrees, 0.0001 in); default "auto": whole units where no coordinate has a point.
    #[serde(default)]
    pub input: NumberInput,
    /// Most blocks that the program may run in loops and calls; default: 20 million.
    #[serde(default)]
    pub blocks: Option<u64>,
    /// Folders with subprograms that it calls, as seen from the folder of the program, which is looked through first.
    #[serde(default)]
    pub subprograms: Vec<String>,
    /// Place of the tip before the program moves it, in coordinates of the setup's work offset, mm; default: not known.
    #[serde(default)]
    pub start: Option<[f64; 3]>,
    /// Number of the tool that is in the spindle before the program calls one; default: none, or the only tool of the job
    /// if the program calls no tool at all.
    #[serde(default)]
    pub tool: Option<u32>,
    /// Whether M codes of the machine that move no axis by custom (clamps, gears, relays) are passed over with a warning;
    /// default: they are errors.
    #[serde(default)]
    pub tolerant: bool,
    /// The tool table of the machine (`tool.tbl` of LinuxCNC), as seen from the folder of the job: offsets of its tools. Tools
    /// themselves are those of the job.
    #[serde(default)]
    pub tool_table: Option<String>,
    /// The parameter file of the machine (`linuxcnc.var`), as seen from the folder of the job: work offsets, the places of G28 and
    /// G30, parameters that the program reads.
    #[serde(default)]
    pub parameters: Option<String>,
    /// Whether the machine counts in inches: the lengths in these two files; default: in mm.
    #[serde(default)]
    pub machine_in_inches: bool,
    /// Values of the control's registers that differ from those of the tools: lengths under `H`, radii under `D`
    /// (diameters on LinuxCNC, as in its tool table), in mm. `registers = { H5 = 120.3, D12 = 5.0 }`. A radius register
    /// that is not given holds the radius of the tool in the spindle.
    #[serde(default)]
    pub registers: BTreeMap<String, f64>,
}
