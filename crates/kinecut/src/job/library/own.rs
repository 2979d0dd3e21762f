//! Tools as kinecut writes them: `[[tool]]` and `[[holder]]` in TOML, or the same tables in JSON.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::de::{DeTable, DeValue};

use super::read::json_error;
use super::write::{NOT_NEEDED, OPEN};
use super::{Library, LibraryFormat, LibraryTool, MOST_TOOLS};
use crate::base::{Code, FileId, Finding, Location, Result, Sources};
use crate::job::file::{ToolLibraryTable, UnitsName};
use crate::job::forms::InMm;
use crate::job::places::{Places, parse};
use crate::job::read::decode;

/// Reads TOML.
pub(super) fn toml(sources: &Sources, id: FileId, file: &str) -> Result<Library> {
    let mut root = parse(sources, id, sources.text(id))?;
    let places = Places::of(id, &root);
    if let Some(finding) = open_key(root.get_ref()) {
        return Err(places.locate(sources, finding.into()));
    }
    let in_mm = InMm::of::<ToolLibraryTable>(&mut root);
    in_mm.put_into::<ToolLibraryTable>(&mut root);
    let table: ToolLibraryTable = decode(sources, id, root)?;
    let mut library = library(file, table).map_err(|finding| places.locate(sources, finding.into()))?;
    library.places = Some(Arc::new(places));
    Ok(library)
}

/// The error of a tool with a key that is still to be filled in.
fn open_key(root: &DeTable<'_>) -> Option<Finding> {
    let tools = root.get("tool")?.get_ref().as_array()?;
    tools.iter().enumerate().find_map(|(i, tool)| {
        let tool = tool.get_ref().as_table()?;
        let value = |key: &str| tool.get(key).map(|value| value.get_ref());
        let is_open = |key: &&&str| value(key).and_then(DeValue::as_str) == Some(OPEN);
        let (key, what, help) = match value("unit") {
            Some(_) => (
                "unit",
                "a tool has no `unit`: its lengths are in mm",
                "write them in mm, and take `unit` out",
            ),
            None => {
                let key = NOT_NEEDED.iter().find(is_open)?;
                (*key, "a key of a tool is still to be filled in", "write its value in place of \"?\"")
            }
        };
        let finding = Finding::error(Code::JOB_SHAPE, what).help(help);
        Some(finding.key(format!("tool[{i}].{key}")))
    })
}

/// Reads JSON.
pub(super) fn json(sources: &Sources, id: FileId, file: &str) -> Result<Library> {
    let table: ToolLibraryTable =
        serde_json::from_str(sources.text(id)).map_err(|e| json_error(sources, id, &e))?;
    if table.units == Some(UnitsName::In) {
        let finding = Finding::error(Code::JOB_SHAPE, "a tool file in JSON is in mm, not in inches");
        let finding = finding.help("write it as TOML, or its lengths in mm").key("units");
        return Err(finding.at(Location::whole_file(file)).into());
    }
    library(file, table).map_err(|finding| finding.at(Location::whole_file(file)).into())
}

/// Numbers are unique.
fn library(file: &str, table: ToolLibraryTable) -> std::result::Result<Library, Finding> {
    if table.tools.len() > MOST_TOOLS {
        return Err(too_many(table.tools.len()).key("tool"));
    }
    let mut numbers = BTreeMap::new();
    for (i, tool) in table.tools.iter().enumerate() {
        if let Some(first) = numbers.insert(tool.number, i) {
            let message = format!("T{} is defined twice", tool.number);
            return Err(Finding::error(Code::JOB_VALUE, message)
                .help(format!("tools {} and {} of the file have this number", first + 1, i + 1))
                .key(format!("tool[{i}].number")));
        }
    }
    let tools = table.tools.into_iter().map(LibraryTool::of).collect();
    Ok(Library { tools, holders: table.holders, ..Library::of(file, LibraryFormat::Own) })
}

/// The error of a file with too many tools.
pub(super) fn too_many(count: usize) -> Finding {
    Finding::error(Code::TOOL_FILE, "a tool file has too many tools")
        .value(count as f64, "tools")
        .bound(MOST_TOOLS as f64, "tools")
        .help("keep the tools of one machine in a file")
}
