//! A hole as written in a text: one operation with its tool.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::DeTable;

use crate::base::{Code, FileId, Finding, Result, Sources};
use crate::job::file::{DynamicsTable, PostTable, ToolTable};
use crate::job::items::{self, TextItems};
use crate::job::places::span;
use crate::job::read::{decode, decode_operation};
use crate::operations::OperationTable;

/// A hole: one operation with its tool; lengths in mm, feeds in mm/min, angles in degrees, speeds in rev/min.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HoleTable {
    /// Name.
    #[serde(default)]
    pub title: Option<String>,
    /// The tool, as in a job; its holder is not looked at.
    pub tool: ToolTable,
    /// The operation, as in a job: `type = "bore"` for `kinecut hole`, `type = "drill"` for `kinecut
    /// drill`, `type = "face"` for `kinecut face`.
    pub operation: OperationTable,
    /// For drilling: a part as a mesh, with the place and direction of the hole on it.
    #[serde(default)]
    pub part: Option<PartTable>,
    /// The control; default sinumerik-840d.
    #[serde(default)]
    pub post: Option<PostTable>,
    /// Limits of the axes: rapid mm/min, acceleration m/s2, jerk m/s3; default 30000, 5, 100. For comparing.
    #[serde(default)]
    pub dynamics: Option<DynamicsTable>,
}

/// A part as a mesh, and where it is drilled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartTable {
    /// STL file.
    #[schemars(example = &"part.stl")]
    pub mesh: String,
    /// A point of the hole's axis, in coordinates of the mesh: the zero of the hole's Z.
    #[schemars(example = vec![0, 0, 0])]
    pub at: [f64; 3],
    /// Direction of the feed; default [0, 0, -1].
    #[serde(default)]
    pub direction: Option<[f64; 3]>,
}

/// A hole without its operation, which is decoded for itself.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct HoleHead {
    #[serde(default)]
    title: Option<String>,
    tool: ToolTable,
    #[serde(default)]
    part: Option<PartTable>,
    #[serde(default)]
    post: Option<PostTable>,
    #[serde(default)]
    dynamics: Option<DynamicsTable>,
}

/// Names that a list of operations may have.
const LISTS: [&str; 3] = ["hole", "drill", "face"];

/// The JSON Schema of the input of `kinecut hole`.
pub fn hole_schema() -> serde_json::Value {
    let what = "The input of `kinecut hole`, `drill` and `face`: one operation, a list, or a table with a list `hole`, \
                `drill` or `face`.";
    items::schema::<HoleTable>("HoleInput", what, &LISTS)
}

/// Reads what `kinecut hole`, `drill` and `face` read, TOML or JSON: one operation, a list, or a table with a list `hole`,
/// `drill` or `face`.
///
/// # Errors
/// `KC0101` for a text that is neither. What is wrong with one item stands in its place.
pub fn read_holes(name: &str, text: impl Into<String>) -> Result<TextItems<HoleTable>> {
    TextItems::read_named(name, text.into(), &LISTS, decode_hole)
}

/// A hole of a TOML table; its operation is decoded for itself, so that errors keep their place.
fn decode_hole(sources: &Sources, id: FileId, mut table: Spanned<DeTable<'_>>) -> Result<HoleTable> {
    let range = table.span();
    let Some(operation) = table.get_mut().remove("operation") else {
        return Err(Finding::error(Code::JOB_SHAPE, "there is no operation")
            .at(sources.locate(span(id, &range)))
            .help("add [operation] with type = \"bore\", \"drill\" or \"face\"")
            .into());
    };
    let operation = decode_operation(sources, id, operation)?;
    let HoleHead { title, tool, part, post, dynamics } = decode(sources, id, table)?;
    Ok(HoleTable { title, tool, operation, part, post, dynamics })
}
