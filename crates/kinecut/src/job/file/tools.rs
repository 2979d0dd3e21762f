//! Files of tools as a job names them, and tools in a file of their own.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ToolTable, UnitsName};
use crate::tool::Holder;

/// Tools and holders in a file of their own; lengths in mm, feeds in mm/min, angles in degrees, speeds in rev/min.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolLibraryTable {
    /// Unit of its lengths: "mm", or "in" for inches, with feeds in in/min and cutting speeds in ft/min; default mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsName>,
    /// Tool holders, named by tools.
    #[serde(default, rename = "holder", skip_serializing_if = "Vec::is_empty")]
    pub holders: Vec<Holder>,
    /// The tools.
    #[serde(default, rename = "tool")]
    pub tools: Vec<ToolTable>,
}

/// Files of tools.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "the name of a tool file, a table { file, inches, number }, or a list of these"
)]
pub enum ToolFiles {
    /// One file.
    One(ToolFileEntry),
    /// Several.
    Several(Vec<ToolFileEntry>),
}

/// A file of tools.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "the name of a tool file, or a table { file, inches, number }")]
pub enum ToolFileEntry {
    /// Its name.
    Name(String),
    /// Its name, and what it does not say itself.
    Table(ToolFileTable),
}

/// A file of tools, and what it does not say itself.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolFileTable {
    /// Its name.
    #[schemars(example = &"shop.toml")]
    pub file: String,
    /// Whether the lengths of a tool table of LinuxCNC are in inches; other files say their units. Default false.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub inches: bool,
    /// Number on the control of the tool of a FreeCAD .fctb file, which has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<u32>,
}

impl ToolFiles {
    /// The files, each as a table.
    pub(in crate::job) fn tables(&self) -> Vec<ToolFileTable> {
        let one = |entry: &ToolFileEntry| match entry {
            ToolFileEntry::Name(file) => ToolFileTable { file: file.clone(), ..ToolFileTable::default() },
            ToolFileEntry::Table(table) => table.clone(),
        };
        match self {
            ToolFiles::One(entry) => vec![one(entry)],
            ToolFiles::Several(entries) => entries.iter().map(one).collect(),
        }
    }
}
