//! The verb `kinecut tools`: the tools of a file, what of it was not taken, and the file in another format.

use std::borrow::Cow;

use serde::Serialize;

use super::Answer;
use crate::base::{Finding, Loader, Result, Sources};
use crate::job::file::{ToolFileTable, ToolTable, ToolType};
use crate::job::library::{
    Library, LibraryTool, largest, library_json, library_table, library_toml, read_library,
};
use crate::page::{Block, Cell, Fact, Row, Section, Table};

/// A tool of a file.
#[derive(Clone, Debug, Serialize)]
pub struct ToolRow {
    /// Number on the control, where the file has it.
    pub number: Option<u32>,
    /// Name.
    pub name: Option<String>,
    /// Kind as a job names it, where it is known.
    #[serde(rename = "type")]
    pub kind: Option<ToolType>,
    /// Largest diameter of its cutting part, where it is known [mm].
    pub diameter: Option<f64>,
    /// Corner radius [mm].
    pub corner_radius: Option<f64>,
    /// Height of the cutting part, where it is known [mm].
    pub flute_length: Option<f64>,
    /// Number of teeth, where the file has it.
    pub teeth: Option<u32>,
    /// Height of the holder's face above the tip, where the file has it [mm].
    pub stickout: Option<f64>,
    /// Name of the holder.
    pub holder: Option<String>,
    /// Materials for which it has cutting data.
    pub presets: Vec<String>,
    /// Keys that a job needs and the file lacks.
    pub missing: Vec<String>,
    /// Fields of the file that were not taken.
    pub dropped: Vec<String>,
    /// Meanings that the file leaves open, in words.
    pub assumed: Vec<String>,
}

/// The tools of a file.
#[derive(Clone, Debug, Serialize)]
pub struct ToolFileSheet {
    /// Name of the file.
    pub file: String,
    /// Its format in words.
    pub format: &'static str,
    /// Its tools, in its order.
    pub tools: Vec<ToolRow>,
    /// Parts of the file that are no tools, and were not taken.
    pub dropped: Vec<String>,
    /// Findings: one for each tool that a job could not use.
    pub findings: Vec<Finding>,
}

/// A format in which tools are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolsTo {
    /// TOML of kinecut.
    Toml,
    /// The same tables in JSON.
    Json,
    /// A tool table of LinuxCNC.
    Table,
}

/// Tools in another format.
#[derive(Clone, Debug, Serialize)]
pub struct ConvertedTools {
    /// The text.
    pub text: String,
    /// Fields of the file that are not in the text, in words.
    pub lost: Vec<String>,
    /// Keys that the text lacks, in words.
    pub missing: Vec<String>,
    /// Meanings that the file leaves open and the text has as values, in words.
    pub assumed: Vec<String>,
}

/// Reads a tool file.
///
/// # Errors
/// Those of [`read_library`].
pub fn read_tools(wants: &ToolFileTable, loader: &dyn Loader) -> Result<Library> {
    read_library(&mut Sources::default(), wants, loader)
}

/// The tools of a file, to be shown.
///
/// ```
/// use kinecut::base::MemoryLoader;
/// use kinecut::job::file::ToolFileTable;
/// use kinecut::verbs::Answer;
/// use kinecut::verbs::tools::{read_tools, tools_sheet};
/// let loader = MemoryLoader::default().with("tool.tbl", "T3 P3 Z80 D6 ;end mill 6\n");
/// let file = ToolFileTable { file: "tool.tbl".to_owned(), ..ToolFileTable::default() };
/// let sheet = tools_sheet(&read_tools(&file, &loader).unwrap());
/// assert_eq!(sheet.tools[0].missing, ["flute_length: not in a tool table"]);
/// assert!(sheet.text().contains("end mill 6"));
/// ```
pub fn tools_sheet(library: &Library) -> ToolFileSheet {
    let rows = library.tools.iter().zip(library.checked()).map(|(tool, checked)| {
        let table = &tool.table;
        let of_body = checked.map(|c| c.cutter.diameter(c.flute_length));
        // Lengths of which nobody knows the unit are not shown.
        let length = |length: Option<f64>| length.filter(|_| tool.has("unit"));
        ToolRow {
            number: tool.has("number").then_some(table.number),
            name: table.name.clone(),
            kind: tool.has("type").then_some(table.kind),
            diameter: of_body.or_else(|| largest(tool)),
            corner_radius: length(table.corner_radius),
            flute_length: length(tool.has("flute_length").then_some(table.flute_length)),
            teeth: table.teeth,
            stickout: length(table.stickout),
            holder: table.holder.clone(),
            presets: table.presets.iter().map(|preset| preset.material.clone()).collect(),
            missing: lacks(tool),
            dropped: tool.dropped.clone(),
            assumed: tool.assumed.clone(),
        }
    });
    ToolFileSheet {
        file: library.file.clone(),
        format: library.format.title(),
        tools: rows.collect(),
        dropped: library.dropped.clone(),
        findings: library.faults(),
    }
}

/// The missing keys of a tool with their reasons.
fn lacks(tool: &LibraryTool) -> Vec<String> {
    tool.missing.iter().map(|m| format!("{}: {}", m.key, m.why)).collect()
}

/// The tools of a file in another format.
///
/// # Errors
/// Those of [`library_toml`].
pub fn convert_tools(library: &Library, to: ToolsTo) -> Result<ConvertedTools> {
    let mut lost = library.dropped.clone();
    let (mut missing, mut assumed) = (Vec::new(), Vec::new());
    for tool in &library.tools {
        let named = |what: &[String]| format!("{}: {}", tool.title(), what.join(", "));
        let mut fields = tool.dropped.clone();
        match to {
            ToolsTo::Table if !tool.has("number") => fields.push("all, as it has no number".to_owned()),
            ToolsTo::Table if !tool.has("unit") => {
                fields.push("all, as the unit of its lengths is not known".to_owned());
            }
            ToolsTo::Table => fields.extend(beyond_table(tool)),
            ToolsTo::Json if !tool.missing.is_empty() => {
                fields.push("all, as JSON has no place for what is missing".to_owned());
            }
            ToolsTo::Toml | ToolsTo::Json => {}
        }
        if !fields.is_empty() {
            lost.push(named(&fields));
        }
        if to == ToolsTo::Toml && !tool.missing.is_empty() {
            missing.push(named(&lacks(tool)));
        }
        let is_written = match to {
            ToolsTo::Toml => true,
            ToolsTo::Json => tool.missing.is_empty(),
            ToolsTo::Table => tool.has("number") && tool.has("unit"),
        };
        if is_written && !tool.assumed.is_empty() {
            assumed.push(named(&tool.assumed));
        }
    }
    if to == ToolsTo::Table {
        lost.extend(library.holders.iter().map(|holder| format!("holder `{}`", holder.name.escape_debug())));
    }
    let text = match to {
        ToolsTo::Toml => library_toml(library)?,
        ToolsTo::Json => library_json(library),
        ToolsTo::Table => library_table(library),
    };
    Ok(ConvertedTools { text, lost, missing, assumed })
}

/// Keys of a tool that a tool table does not hold.
fn beyond_table(tool: &LibraryTool) -> Vec<String> {
    const HELD: [&str; 4] = ["number", "name", "diameter", "gauge_length"];
    let usual = serde_json::to_value(ToolTable::bare(0));
    let Ok(serde_json::Value::Object(table)) = serde_json::to_value(&tool.table) else { return Vec::new() };
    let usual = usual.unwrap_or_default();
    let is_cone = tool.has("type") && tool.table.kind == ToolType::Tapered;
    let says = |key: &str, value: &serde_json::Value| {
        let told = matches!(key, "type" | "flute_length" | "diameter") || usual.get(key) != Some(value);
        // D is the largest diameter: that of the tip of a cone has no place.
        let held = HELD.contains(&key) && !(key == "diameter" && is_cone);
        told && tool.has(key) && !held
    };
    table.iter().filter(|(key, value)| says(key, value)).map(|(key, _)| key.clone()).collect()
}

/// A number as a person reads it.
fn shown(value: Option<f64>) -> Cell {
    value.map_or_else(|| Cell::new(""), |v| Cell::new(format!("{}", (v * 1e4).round() / 1e4)))
}

impl Answer for ToolFileSheet {
    fn sections(&self) -> Vec<Section> {
        let row = |tool: &ToolRow| {
            let word = tool.kind.and_then(|kind| serde_json::to_value(kind).ok());
            Row::new(vec![
                Cell::new(tool.number.map(|n| n.to_string()).unwrap_or_default()),
                Cell::new(tool.name.clone().unwrap_or_default()),
                Cell::new(word.as_ref().and_then(|word| word.as_str()).unwrap_or_default()),
                shown(tool.diameter),
                shown(tool.corner_radius),
                shown(tool.flute_length),
                Cell::new(tool.teeth.map(|n| n.to_string()).unwrap_or_default()),
                shown(tool.stickout),
                Cell::new(tool.holder.clone().unwrap_or_default()),
                Cell::new(tool.presets.join(", ")),
            ])
        };
        let columns = "T []; Name; Type; Diameter [mm]; Corner [mm]; Flutes [mm]; Teeth []; Stickout [mm]; Holder; Presets";
        let mut sections = vec![
            Section::new(format!("Tools of {}", self.file))
                .with(Block::Facts(vec![
                    Fact::new("Format", self.format),
                    Fact::new("Tools", self.tools.len().to_string()),
                ]))
                .with(Table::new("", columns).rows(self.tools.iter().map(row))),
        ];
        let of = |tool: &ToolRow| {
            let number = tool.number.map(|n| format!("T{n} ")).unwrap_or_default();
            format!("{number}{}", tool.name.as_deref().unwrap_or_default()).trim_end().to_owned()
        };
        let mut rows = Vec::new();
        for tool in &self.tools {
            for (what, list) in
                [("missing", &tool.missing), ("assumed", &tool.assumed), ("not taken", &tool.dropped)]
            {
                if !list.is_empty() {
                    rows.push(Row::new(vec![of(tool).into(), what.into(), list.join(", ").into()]));
                }
            }
        }
        for part in &self.dropped {
            rows.push(Row::new(vec!["".into(), "not taken".into(), part.as_str().into()]));
        }
        if !rows.is_empty() {
            let table = Table::new("", "Tool; ; Fields").rows(rows);
            sections.push(Section::new("Missing, assumed, not taken").with(table));
        }
        sections
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }
}

impl Answer for ConvertedTools {
    fn sections(&self) -> Vec<Section> {
        let mut sections = Vec::new();
        for (title, list) in
            [("Not written", &self.lost), ("To be filled in", &self.missing), ("Assumed", &self.assumed)]
        {
            if !list.is_empty() {
                let rows = list.iter().map(|what| Row::new(vec![what.as_str().into()]));
                sections.push(Section::new(title).with(Table::new("", "Tool").rows(rows)));
            }
        }
        sections
    }

    fn data(&self) -> Cow<'_, str> {
        Cow::Borrowed(&self.text)
    }
}
