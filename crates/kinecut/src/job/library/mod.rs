//! Tools in files of their own: TOML, the tool table of LinuxCNC, Fusion, FreeCAD. Each reader takes what it is sure of, and
//! names the rest.
//!
//! A tool of a foreign file may lack what a tool of a job has: a tool table has no flutes. What is missing is an error where the
//! tool is used, not where the file is read.
//!
//! Sources of the field names: tool tables as `nc::tool_table` reads them; FreeCAD's own `Tools/Bit`, `Tools/Library` and its
//! migration of older bits; Fusion libraries as public readers and writers of them have them (nothing is published of the format).

mod cone;
mod fields;
mod freecad;
mod fusion;
mod own;
mod package;
mod program;
mod quantity;
mod read;
mod shelf;
mod shop;
mod table;
mod write;

pub use read::read_library;
pub(in crate::job) use shop::Shop;
pub(crate) use write::largest;
pub use write::{library_json, library_table, library_toml};

use std::sync::Arc;

use super::file::{ToolTable, holders, kind_name, tool};
use super::places::Places;
use crate::base::{Code, Error, Finding, Location};
use crate::tool::{Holder, Tool};

/// Most tools of a file: more than a shop has.
const MOST_TOOLS: usize = 10_000;

/// A format of tool files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LibraryFormat {
    /// Tables `[[tool]]` and `[[holder]]`, in TOML or JSON.
    Own,
    /// The tool table of LinuxCNC.
    LinuxCnc,
    /// A library of Fusion.
    Fusion,
    /// A tool bit of FreeCAD.
    FreeCadBit,
    /// A tool library of FreeCAD: numbers and names of bits.
    FreeCadLibrary,
}

impl LibraryFormat {
    /// Its name for a person.
    pub fn title(self) -> &'static str {
        match self {
            LibraryFormat::Own => "kinecut tools",
            LibraryFormat::LinuxCnc => "LinuxCNC tool table",
            LibraryFormat::Fusion => "Fusion tool library",
            LibraryFormat::FreeCadBit => "FreeCAD tool bit",
            LibraryFormat::FreeCadLibrary => "FreeCAD tool library",
        }
    }
}

/// The tools of a file.
#[derive(Clone, Debug)]
pub struct Library {
    /// Name of the file.
    pub file: String,
    /// Its format.
    pub format: LibraryFormat,
    /// Tools, in the order of the file.
    pub tools: Vec<LibraryTool>,
    /// Holders, by the names that the tools call.
    pub holders: Vec<Holder>,
    /// All files that were read: its own, and those that it names.
    pub files: Vec<String>,
    /// Parts of the file that are no tools, and were not taken.
    pub dropped: Vec<String>,
    /// Places of its values, where it is TOML.
    places: Option<Arc<Places>>,
}

/// A tool of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryTool {
    /// Its table. The keys of `missing` have no meaning in it.
    pub table: ToolTable,
    /// Keys without which it cannot be used, with the reason.
    pub missing: Vec<Missing>,
    /// Fields of the file that were not taken.
    pub dropped: Vec<String>,
    /// Meanings that the file leaves open, in words.
    pub assumed: Vec<String>,
}

/// A key that the file of a tool does not tell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// The key of the tool's table; "unit" where it is not known what its lengths are counted in.
    pub key: &'static str,
    /// The reason.
    pub why: String,
}

impl Library {
    fn of(file: &str, format: LibraryFormat) -> Library {
        Library {
            file: file.to_owned(),
            format,
            tools: Vec::new(),
            holders: Vec::new(),
            files: vec![file.to_owned()],
            dropped: Vec::new(),
            places: None,
        }
    }

    /// Findings about its tools: one for each tool that a job could not use.
    pub fn faults(&self) -> Vec<Finding> {
        let holders = match holders(&self.holders) {
            Ok(holders) => holders,
            Err(error) => return vec![self.named(error)],
        };
        let fault = |own: &LibraryTool| match own.missing.is_empty() {
            true => tool(&own.table, &holders).err().map(|e| self.of_tool(own, e)),
            false => {
                Some(Finding::warning(Code::TOOL_FILE, own.lack()).at(Location::whole_file(&*self.file)))
            }
        };
        self.tools.iter().filter_map(fault).collect()
    }

    /// An error of one of its tools.
    fn of_tool(&self, own: &LibraryTool, error: Error) -> Finding {
        let mut finding = *error.0;
        finding.message = format!("{}: {}", own.title(), finding.message);
        self.named(finding.into())
    }

    fn named(&self, error: Error) -> Finding {
        error.0.at(Location::whole_file(&*self.file))
    }

    /// Its tools as they are simulated, where they can be.
    pub fn checked(&self) -> Vec<Option<Tool>> {
        let holders = holders(&self.holders).unwrap_or_default();
        let one =
            |own: &LibraryTool| own.missing.is_empty().then(|| tool(&own.table, &holders).ok()).flatten();
        self.tools.iter().map(one).collect()
    }
}

impl LibraryTool {
    fn of(table: ToolTable) -> LibraryTool {
        LibraryTool { table, missing: Vec::new(), dropped: Vec::new(), assumed: Vec::new() }
    }

    /// Whether the file tells a key.
    pub fn has(&self, key: &str) -> bool {
        self.missing.iter().all(|missing| missing.key != key)
    }

    fn lacks(&mut self, key: &'static str, why: impl Into<String>) {
        if self.has(key) {
            self.missing.push(Missing { key, why: why.into() });
        }
    }

    /// Number, and name or kind.
    pub fn title(&self) -> String {
        let name = match &self.table.name {
            Some(name) => format!("`{}`", name.escape_debug()),
            None if self.has("type") => kind_name(self.table.kind).to_owned(),
            None => String::new(),
        };
        let number = if self.has("number") { format!("T{} ", self.table.number) } else { String::new() };
        format!("{number}{name}").trim_end().to_owned()
    }

    /// The missing keys in words.
    fn lack(&self) -> String {
        let all: Vec<String> = self.missing.iter().map(|m| format!("{} ({})", m.key, m.why)).collect();
        format!("{} lacks {}", self.title(), all.join(", "))
    }
}
