//! Tools of a file written again: as TOML or JSON of kinecut, or as a tool table of LinuxCNC.

use std::fmt::Write as _;

use serde::Serialize;

use super::{Library, LibraryTool};
use crate::base::{Code, Finding, Result};
use crate::job::file::{ToolLibraryTable, ToolTable};
use crate::job::json_text;
use crate::tool::Holder;

/// The tools as TOML. Keys that a tool lacks are comments there, to be filled in.
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
        let mut told: Vec<&str> = Vec::new();
        for line in text.lines() {
            let key = line.split(" = ").next().unwrap_or_default();
            match tool.missing.iter().find(|missing| missing.key == key) {
                Some(missing) => {
                    told.push(missing.key);
                    _ = writeln!(out, "# {key} = ?  # {}", plain(&missing.why));
                }
                None => _ = writeln!(out, "{line}"),
            }
        }
        for missing in tool.missing.iter().filter(|missing| !told.contains(&missing.key)) {
            _ = writeln!(out, "# {} = ?  # {}", missing.key, plain(&missing.why));
        }
        out.push('\n');
    }
    out.truncate(out.trim_end().len());
    out.push('\n');
    Ok(out)
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
        holders: library.holders.clone(),
        tools: whole.map(|tool| tool.table.clone()).collect(),
    })
}

/// The tools as a tool table of LinuxCNC, lengths in mm; each is in the pocket of its number. Number, diameter, length and name
/// are all that it holds.
pub fn library_table(library: &Library) -> String {
    let mut out = String::from("; lengths in mm\n");
    for LibraryTool { table, .. } in library.tools.iter().filter(|tool| tool.has("number")) {
        let number = table.number;
        _ = write!(out, "T{number} P{number}");
        if let Some(length) = table.gauge_length {
            _ = write!(out, " Z{length}");
        }
        if table.diameter > 0.0 {
            _ = write!(out, " D{}", table.diameter);
        }
        if let Some(name) = &table.name {
            _ = write!(out, " ;{name}");
        }
        out.push('\n');
    }
    out
}
