//! The job file, format 1, as written: mm, mm/min, degrees, rev/min. Checked values are made from it in
//! [`super::check`].
//!
//! The doc comments here are the manual: they reach editors through `kinecut schema job`.

mod body;
mod contour;
mod cutting;
mod fixture;
mod hole;
mod machine;
mod program;
mod tool;
mod tools;
mod units;

pub use body::*;
pub use contour::*;
pub use cutting::*;
pub use fixture::*;
pub use hole::*;
pub use machine::*;
pub use program::*;
pub use tool::*;
pub use tools::*;
pub use units::*;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cutting::TakenData;
use crate::operations::{FeedsName, OperationTable, OrientationName};
use crate::tool::Holder;

/// A kinecut job: stock, tools, machine and operations; lengths in mm, feeds in mm/min, angles in degrees, speeds
/// in rev/min.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JobFile {
    /// Version of this file's form: 1.
    #[schemars(example = 1)]
    pub format: u32,
    /// Unit of the job's lengths: "mm", or "in" for inches, with feeds in in/min and cutting speeds in ft/min; default mm. Its program
    /// is written in it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsName>,
    /// Title of the job in program and report.
    #[serde(default)]
    pub title: Option<String>,
    /// The material of the part: "C45", "1.0503", "AISI 1045". Operations without speed and feed take those of their tool's preset
    /// for it, else values to start with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Files of tools: "shop.toml", or a list of them. TOML with the tools and holders of a job, the tool table of LinuxCNC
    /// (.tbl), Fusion .json and .tools, FreeCAD .fctb and .fctl. A tool of the job is taken before one of the same number.
    #[serde(default, rename = "tools", skip_serializing_if = "Option::is_none")]
    pub libraries: Option<ToolFiles>,
    /// File of the shop's own cutting data, TOML with `[[cutting]]`: "cutting.toml". They go before values to start with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutting: Option<String>,
    /// The wanted part, to compare the cut part with.
    #[serde(default)]
    pub design: Option<DesignTable>,
    /// The raw stock, in part coordinates.
    pub stock: StockTable,
    /// Holes that the raw stock already has.
    #[serde(default, rename = "drilled")]
    pub drilled: Vec<DrilledTable>,
    /// The control and how to write for it.
    pub post: PostTable,
    /// Resolution and memory of the simulation.
    #[serde(default)]
    pub simulate: SimulateTable,
    /// The machine: a table, or the name of a file that holds one.
    #[serde(default)]
    pub machine: Option<MachineEntry>,
    /// Tool holders, named by tools.
    #[serde(default, rename = "holder")]
    pub holders: Vec<Holder>,
    /// The tools.
    #[serde(default, rename = "tool")]
    pub tools: Vec<ToolTable>,
    /// All files from which the tools of `libraries` were read.
    #[serde(skip)]
    pub tool_files: Vec<String>,
    /// Speeds and feeds that operations were given.
    #[serde(skip)]
    pub taken: Vec<TakenData>,
    /// Clamps, vises and what else stands around the part.
    #[serde(default, rename = "fixture", skip_serializing_if = "Vec::is_empty")]
    pub fixtures: Vec<FixtureTable>,
    /// The clampings of the part, in order.
    #[serde(rename = "setup")]
    pub setups: Vec<SetupTable>,
}

/// The wanted part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DesignTable {
    /// STL file, in part coordinates.
    #[schemars(example = &"part.stl")]
    pub mesh: String,
    /// Largest allowed distance between cut and wanted surface.
    #[schemars(example = 0.1)]
    pub tolerance: f64,
    /// Regions of its surface with limits of their own.
    #[serde(default, rename = "region", skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionTable>,
}

/// Faces of the design with limits of their own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegionTable {
    /// Name.
    #[schemars(example = &"pocket")]
    pub name: String,
    /// Points on its faces, one for each: a face goes on as far as its triangles do smoothly.
    #[schemars(example = vec![[20, 15, -5]])]
    pub at: Vec<[f64; 3]>,
    /// Angle of the normals on both sides of an edge up to which a face goes on, degrees; default 20.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Greatest depth to which it may be cut into; default: the tolerance of the design.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gouge: Option<f64>,
    /// Most stock that may be left on it; default: the tolerance of the design.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<f64>,
}

/// The raw stock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum StockTable {
    /// A block.
    Box(BoxTable),
    /// A round bar standing along Z.
    Cylinder(CylinderTable),
    /// A closed STL mesh.
    Mesh(#[schemars(example = &"part.stl")] String),
}

/// A block between two corners.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxTable {
    /// Least corner.
    #[schemars(example = vec![0, 0, -20])]
    pub min: [f64; 3],
    /// Greatest corner.
    #[schemars(example = vec![100, 60, 0])]
    pub max: [f64; 3],
}

/// A round bar standing along Z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderTable {
    /// Centre of the lower face.
    #[schemars(example = vec![0, 0, -20])]
    pub base: [f64; 3],
    /// Diameter.
    #[schemars(example = 80)]
    pub diameter: f64,
    /// Height.
    #[schemars(example = 20)]
    pub height: f64,
}

/// A round hole that the raw stock already has, along Z of the part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrilledTable {
    /// Centre.
    #[schemars(example = vec![50, 30])]
    pub at: [f64; 2],
    /// Diameter.
    #[schemars(example = 10)]
    pub diameter: f64,
    /// Height of the hole's upper end.
    #[schemars(example = 0)]
    pub top: f64,
    /// Height of the hole's flat lower end.
    #[schemars(example = -20)]
    pub bottom: f64,
}

/// The control and how to write for it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PostTable {
    /// The control: "sinumerik-840d", "fanuc", "linuxcnc", "grbl" or "heidenhain".
    #[schemars(example = &"fanuc")]
    pub control: String,
    /// Unit of the program and of the lengths in this table: "mm" or "in"; default: that of the job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsName>,
    /// Decimals of coordinates, 3 to 6; default: as usual on the control (FANUC 3, others 4; one more in
    /// inches).
    #[serde(default)]
    pub decimals: Option<u8>,
    /// Least step of coordinates where it is coarser than the last decimal: 0.005; all coordinates are multiples of it.
    #[serde(default)]
    pub resolution: Option<f64>,
    /// Whether involutes are written as the control's own where it has them; default true.
    #[serde(default)]
    pub involute: Option<bool>,
    /// Whether arcs and helices keep their form; false: straight lines only. Default true.
    #[serde(default)]
    pub arcs: Option<bool>,
    /// Largest distance of those lines from the path; default 0.005.
    #[serde(default)]
    pub chord_tolerance: Option<f64>,
    /// Whether turned coordinates are written as the control's own rotation where it has one; false: the coordinates
    /// themselves are turned. Default true.
    #[serde(default)]
    pub rotation: Option<bool>,
    /// Form of tool directions and tilted planes in the program: "vectors" and "angles" with control of the tool centre
    /// point and the control's own tilted planes, "axes" as positions of all axes; default: as usual on the control
    /// (SINUMERIK vectors; FANUC, HEIDENHAIN angles; LinuxCNC axes).
    #[serde(default)]
    pub orientation: Option<OrientationName>,
    /// Feeds where the axes cannot hold those of the job: "within-limits" lowers them, "as-programmed" writes them as they
    /// are; default: within limits where the machine has a rapid speed and an acceleration.
    #[serde(default)]
    pub feeds: Option<FeedsName>,
    /// Whether blocks are numbered; default: as usual on the control.
    #[serde(default)]
    pub block_numbers: Option<bool>,
    /// Largest distance between an involute and the arcs that replace it if the control has no involute or
    /// cannot start this one; default 0.0005.
    #[serde(default)]
    pub arc_tolerance: Option<f64>,
    /// Whether spirals and involutes are written as cubics (`G5`, LinuxCNC only); default false.
    #[serde(default)]
    pub cubic: Option<bool>,
    /// Name of the program, and of its file; default: the name of the job file.
    #[serde(default)]
    pub program: Option<String>,
    /// Number of the program where the control has numbers (FANUC's O word); default 1.
    #[serde(default)]
    pub program_number: Option<u32>,
    /// File with the template of the blocks at the start, instead of the built-in ones.
    #[serde(default)]
    pub start: Option<String>,
    /// File with the template of the blocks at the end.
    #[serde(default)]
    pub end: Option<String>,
}

/// Resolution and memory of the simulation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SimulateTable {
    /// Distance of the lines of the stock model; default: that of about 2 million lines in the stock.
    #[serde(default)]
    pub step: Option<f64>,
    /// Largest memory of a run, MB: stock model, moves, surface and comparison; default 4000.
    #[serde(default)]
    pub memory: Option<f64>,
    /// Largest distance of the surface of the cut part, as files and report show it, from the ends of the lines; default: a
    /// fiftieth of their distance.
    #[serde(default)]
    pub mesh_tolerance: Option<f64>,
    /// Prove the cut stock against the moves by branch and bound.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub certified: bool,
    /// Measure how the tools are engaged in each block: arc, depth, width, removal rate, thickness of chips, in a pass of its own;
    /// default: for programs of less than 20 000 moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub engagement: Option<bool>,
    /// Distances by which zeros, tool lengths and the raw stock may be off when the programs run: contacts are looked for over the whole range;
    /// default: not at all. `uncertainty = { offset = 0.05, length = 0.02, stock = 0.5 }`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyTable>,
}

/// Distances by which a person may be off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UncertaintyTable {
    /// The zero of a setup, in any direction; default 0.
    #[serde(default)]
    pub offset: f64,
    /// The length of each tool, up or down; default 0.
    #[serde(default)]
    pub length: f64,
    /// The raw stock, larger by so much on each side; default 0.
    #[serde(default)]
    pub stock: f64,
}

/// A clamping of the part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetupTable {
    /// Work offset.
    #[schemars(example = &"G54")]
    pub offset: String,
    /// The work zero, in part coordinates; default: the part's zero.
    #[serde(default)]
    pub zero: Option<[f64; 3]>,
    /// Orientation of the part: the directions of the work offset's X and Z, in part coordinates.
    #[serde(default)]
    pub orient: Option<OrientTable>,
    /// Machine position of the work zero (of the spindle's gauge point without tool). Without it travel limits can
    /// only be compared with the span of the motion.
    #[serde(default)]
    pub position: Option<[f64; 3]>,
    /// Height above the work zero to which the tool is lifted between operations; default: 50 above the stock.
    #[serde(default)]
    pub safe_height: Option<f64>,
    /// Height of the table, or of the parallels, under the part: above the work zero, along Z of the work offset, so mostly
    /// negative. No tool may go below it.
    #[serde(default)]
    pub table: Option<f64>,
    /// Depth to which a tool may go below the underside of the stock, besides the length of its point, if `table` is
    /// not given and its operation has no `breakthrough` of its own; default 3.
    #[serde(default)]
    pub breakthrough: Option<f64>,
    /// Work offsets other than `offset` that a program of others uses: their zeros, in part coordinates; directions as
    /// those of `offset`. `offsets = { G55 = [100, 0, 0] }`.
    #[serde(default)]
    pub offsets: BTreeMap<String, [f64; 3]>,
    /// The operations, in order.
    #[serde(default, rename = "operation")]
    #[schemars(with = "Vec<OperationEntry>")]
    pub operations: Vec<OperationTable>,
    /// The holes by size among them, until operations take their place.
    #[serde(skip)]
    pub(crate) holes: Vec<ListedHole>,
    /// A program that others wrote, in place of operations: `program = { file = "O1234.nc", control = "fanuc" }`.
    #[serde(default)]
    pub program: Option<ProgramTable>,
}

impl SetupTable {
    /// A clamping at the part's own zero with one operation.
    pub(crate) fn of(operation: OperationTable) -> SetupTable {
        SetupTable { operations: vec![operation], ..SetupTable::bare() }
    }

    /// A clamping at the part's own zero with a program that others wrote.
    pub(crate) fn of_program(program: ProgramTable) -> SetupTable {
        SetupTable { program: Some(program), ..SetupTable::bare() }
    }

    fn bare() -> SetupTable {
        SetupTable {
            offset: "G54".to_owned(),
            zero: None,
            orient: None,
            position: None,
            safe_height: None,
            table: None,
            breakthrough: None,
            offsets: BTreeMap::new(),
            operations: Vec::new(),
            holes: Vec::new(),
            program: None,
        }
    }
}

/// Orientation of the part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrientTable {
    /// Direction of the work offset's X in part coordinates.
    #[schemars(example = vec![1, 0, 0])]
    pub x: [f64; 3],
    /// Direction of the work offset's Z (towards the spindle) in part coordinates.
    #[schemars(example = vec![0, 0, 1])]
    pub z: [f64; 3],
}

/// The JSON Schema of an outline in a file of its own.
pub fn outline_schema() -> serde_json::Value {
    schemars::schema_for!(crate::geom::OutlineFile).to_value()
}

/// The JSON Schema of a machine in a file of its own.
pub fn machine_schema() -> serde_json::Value {
    schemars::schema_for!(MachineTable).to_value()
}

/// The JSON Schema of a surface in a file of its own.
pub fn surface_schema() -> serde_json::Value {
    schemars::schema_for!(crate::machine::surface::SurfaceFile).to_value()
}

/// The JSON Schema of tools in a file of their own.
pub fn tools_schema() -> serde_json::Value {
    schemars::schema_for!(ToolLibraryTable).to_value()
}

/// The JSON Schema of the cutting data of a shop in a file of their own.
pub fn cutting_schema() -> serde_json::Value {
    schemars::schema_for!(CuttingFileTable).to_value()
}

/// The JSON Schema of a tool of revolution in a file of its own.
pub fn contour_schema() -> serde_json::Value {
    schemars::schema_for!(ContourTable).to_value()
}

/// The JSON Schema of the job file.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(JobFile).to_value()
}
