//! Any tool file: its format is known by its content, and where that leaves it open, by its name.

use serde_json::Value;

use super::package::{is_package, package_text};
use super::{Library, LibraryFormat, freecad, fusion, own, table};
use crate::base::{Code, Error, FileId, FileKind, Finding, Loader, Location, Result, Sources, Span};
use crate::job::external::is_tool_table;
use crate::job::file::ToolFileTable;

/// Reads a tool file; it, and the files that it names, come through `loader`. Its text is added to `sources`.
///
/// ```
/// use kinecut::base::{MemoryLoader, Sources};
/// use kinecut::job::file::ToolFileTable;
/// use kinecut::job::library::read_library;
/// let loader = MemoryLoader::default().with("tool.tbl", "T3 P3 Z80 D6 ;end mill 6\n");
/// let file = ToolFileTable { file: "tool.tbl".to_owned(), ..ToolFileTable::default() };
/// let library = read_library(&mut Sources::default(), &file, &loader).unwrap();
/// assert_eq!((library.tools[0].table.number, library.tools[0].table.diameter), (3, 6.0));
/// assert!(!library.tools[0].has("flute_length"));
/// ```
///
/// # Errors
/// Those of the loader; `KC0101`, `KC0102`, `KC0103` for TOML, `KC0202` for a tool table, `KC0706` for other files that cannot be
/// read, each with its place in the tool file.
pub fn read_library(sources: &mut Sources, wants: &ToolFileTable, loader: &dyn Loader) -> Result<Library> {
    let name = wants.file.as_str();
    let bytes = loader.lend_as(name, FileKind::Text)?;
    let text = match is_package(&bytes) {
        true => package_text(&bytes).map_err(|e| e.0.at(Location::whole_file(name)))?,
        false => loader.read_text(name)?,
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned();
    let json = text.trim_start().starts_with(['{', '[']) && !text.trim_start().starts_with("[[");
    let json = json && (is_package(&bytes) || !ends_in(name, ".toml"));
    let table = is_tool_table(name);
    let id = sources.add(name, text);
    let mut library = match json {
        true => of_json(sources, id, name, loader)?,
        false if table => table::read(sources, id, name, if wants.inches { 25.4 } else { 1.0 })?,
        false => own::toml(sources, id, name)?,
    };
    if wants.inches && library.format != LibraryFormat::LinuxCnc {
        let message = format!("`{name}` says its units itself");
        return Err(Finding::error(Code::JOB_VALUE, message).help("leave `inches` out").into());
    }
    if let Some(number) = wants.number {
        let [tool] = &mut library.tools[..] else {
            let message = format!("`{name}` has several tools: one number is not for all");
            return Err(Finding::error(Code::JOB_VALUE, message).help("leave `number` out").into());
        };
        tool.table.number = number;
        tool.missing.retain(|missing| missing.key != "number");
    }
    Ok(library)
}

fn of_json(sources: &Sources, id: FileId, name: &str, loader: &dyn Loader) -> Result<Library> {
    let value: Value = serde_json::from_str(sources.text(id)).map_err(|e| json_error(sources, id, &e))?;
    let list = |key: &str| value.get(key).is_some_and(Value::is_array);
    if list("data") {
        return fusion::read(name, &value);
    }
    if list("tools") {
        return freecad::library(name, &value, loader);
    }
    if value.get("parameter").is_some_and(Value::is_object) {
        return freecad::bit_file(name, &value);
    }
    if list("tool") {
        return own::json(sources, id, name);
    }
    Err(Finding::error(Code::TOOL_FILE, format!("`{name}` is no tool file that kinecut knows"))
        .at(Location::whole_file(name))
        .help("a JSON file of tools has \"data\" (Fusion), \"parameter\" or \"tools\" (FreeCAD), or \"tool\" (kinecut)")
        .into())
}

/// An error of JSON with its place.
pub(super) fn json_error(sources: &Sources, id: FileId, error: &serde_json::Error) -> Error {
    let text = sources.text(id);
    let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    let at = (before + error.column().saturating_sub(1)).min(text.len()) as u32;
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or(&message);
    Finding::error(Code::TOOL_FILE, format!("the JSON of a tool file is broken: {message}"))
        .at(sources.locate(Span { file: id, start: at, end: at }))
        .help("export the file again")
        .into()
}

/// Whether a name ends so, in large or small letters.
fn ends_in(name: &str, ending: &str) -> bool {
    name.to_ascii_lowercase().ends_with(ending)
}
