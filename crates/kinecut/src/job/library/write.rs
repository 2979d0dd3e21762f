//! Tools of a file written again: as TOML or JSON of kinecut, or as a tool table of LinuxCNC.

use std::fmt::Write as _;

use serde::Serialize;

use super::{Library, LibraryTool, Missing};
use crate::base::{Code, Finding, Result};
use crate::job::file::{ToolLibraryTable, ToolTable, ToolType};
use crate::job::json_text;
use crate::tool::Holder;

/// Keys that TOML does not need, but without which a tool would be another one.
pub(super) const NOT_NEEDED: [&str; 4] = ["unit", "point", "point_angle", "entering_angle"];
/// The value of a key that is to be filled in: no value of a key that may have it.
pub(super) const OPEN: &str = "?";

/// The tools as TOML. Keys that a tool lacks are comments there, to be filled in, or have a value that is refused; what was assumed
/// is a comment before the keys.
///
/// # Errors
/// `KC0706` for a number that TOML cannot hold.
pub fn library_toml(library: &Library) -> Result<String> {
    let mut out = String::new();
    for holder in &library.holders {
        #[derive(Serialize)]
        struct One<'a> {
            holder: [&'a Holder; 1],
        }
        out.push_str(&text(&One { holder: [holder] })?);
        out.push('\n');
    }
    for tool in &library.tools {
        #[derive(Serialize)]
        struct One<'a> {
            tool: [&'a ToolTable; 1],
        }
        let text = text(&One { tool: [&tool.table] })?;
        // Its own keys end at the header of the first table within it: a key behind that belongs to the other one.
        let mut lines = text.lines().peekable();
        if let Some(header) = lines.next() {
            _ = writeln!(out, "{header}");
        }
        for assumed in &tool.assumed {
            _ = writeln!(out, "# assumed: {}", plain(assumed));
        }
        let mut told: Vec<&str> = Vec::new();
        while let Some(line) = lines.next_if(|line| !line.starts_with('[')) {
            let key = line.split(" = ").next().unwrap_or_default();
            match tool.missing.iter().find(|missing| missing.key == key) {
                Some(missing) => {
                    told.push(missing.key);
                    out.push_str(&open(missing));
                }
                None if line.is_empty() => {}
                None => _ = writeln!(out, "{line}"),
            }
        }
        for missing in tool.missing.iter().filter(|missing| !told.contains(&missing.key)) {
            out.push_str(&open(missing));
        }
        if lines.peek().is_some() {
            out.push('\n');
        }
        lines.for_each(|line| _ = writeln!(out, "{line}"));
        out.push('\n');
    }
    out.truncate(out.trim_end().len());
    out.push('\n');
    Ok(out)
}

/// The line of a key that is to be filled in.
fn open(missing: &Missing) -> String {
    let why = plain(&missing.why);
    match missing.key {
        "unit" => format!("unit = \"{OPEN}\"  # {why}: write the lengths in mm, and take this line out\n"),
        key if NOT_NEEDED.contains(&key) => format!("{key} = \"{OPEN}\"  # {why}\n"),
        key => format!("# {key} = ?  # {why}\n"),
    }
}

/// A comment in one line.
fn plain(why: &str) -> String {
    why.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// A table as TOML: whole numbers without decimals, without what is usual anyway.
fn text(value: &impl Serialize) -> Result<String> {
    let written = toml::to_string(value).map_err(|e| {
        Finding::error(Code::TOOL_FILE, format!("the tools cannot be written as TOML: {e}"))
            .help("look at their numbers")
    })?;
    let mut out = String::new();
    for line in written.lines().filter(|line| *line != "hand = \"right\"") {
        let whole = line.strip_suffix(".0").filter(|_| !line.contains(['"', '\'']));
        out.push_str(whole.unwrap_or(line));
        out.push('\n');
    }
    Ok(out)
}

/// The tools as JSON: the tables of TOML, without those that lack something.
pub fn library_json(library: &Library) -> String {
    let whole = library.tools.iter().filter(|tool| tool.missing.is_empty());
    json_text(&ToolLibraryTable {
        units: None,
        holders: library.holders.clone(),
        tools: whole.map(|tool| tool.table.clone()).collect(),
    })
}

/// The tools as a tool table of LinuxCNC, lengths in mm; each is in the pocket of its number. Number, largest diameter, length and
/// name are all that it holds. Tools without a number, or whose lengths have no known unit, are not in it.
pub fn library_table(library: &Library) -> String {
    let mut out = String::from("; lengths in mm\n");
    let written = library.tools.iter().filter(|tool| tool.has("number") && tool.has("unit"));
    for tool in written {
        let table = &tool.table;
        let number = table.number;
        _ = write!(out, "T{number} P{number}");
        if let Some(length) = table.gauge_length {
            _ = write!(out, " Z{length}");
        }
        if let Some(diameter) = largest(tool) {
            _ = write!(out, " D{diameter}");
        }
        if let Some(name) = &table.name {
            _ = write!(out, " ;{name}");
        }
        out.push('\n');
    }
    out
}

/// The largest diameter of a tool, where it is known [mm].
pub(crate) fn largest(tool: &LibraryTool) -> Option<f64> {
    let table = &tool.table;
    let diameter = match table.kind {
        ToolType::Tapered if tool.has("type") => {
            let known = ["diameter", "flute_length", "half_angle", "unit"].iter().all(|key| tool.has(key));
            let half = table.half_angle.filter(|half| known && *half > 0.0 && *half < 90.0)?;
            let largest = table.diameter + 2.0 * table.flute_length * half.to_radians().tan();
            // 12 mm, not 11.999999999999998.
            (largest * 1e9).round() / 1e9
        }
        _ => table.diameter,
    };
    (tool.has("diameter") && tool.has("unit") && diameter > 0.0).then_some(diameter)
}
