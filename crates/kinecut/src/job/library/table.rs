//! The tool table of LinuxCNC: number, length, diameter and a remark. It has no kind, no flutes and no unit.

use std::collections::BTreeMap;

use super::fields::{fit_name, rounded};
use super::own::too_many;
use super::{Library, LibraryFormat, LibraryTool, MOST_TOOLS};
use crate::base::{Code, FileId, Finding, Location, Result, Sources, Span};
use crate::job::external::kind_in;
use crate::job::file::{ToolTable, ToolType};
use crate::nc::{TableTool, tool_table};

/// Letters whose numbers are taken.
const TAKEN: &str = "TZD";
/// Beginnings of words for drills whose points are not those of twist drills.
const OTHER_POINTS: [&str; 3] = ["SPOT", "CENT", "REAM"];

/// Reads a tool table; `unit` is that of its lengths in mm.
pub(super) fn read(sources: &Sources, id: FileId, file: &str, unit: f64) -> Result<Library> {
    let table = tool_table(sources, id, unit)?;
    if table.len() > MOST_TOOLS {
        return Err(too_many(table.len()).at(Location::whole_file(file)).into());
    }
    let mut library = Library::of(file, LibraryFormat::LinuxCnc);
    let words = words(sources, id)?;
    for own in table {
        let words = words.get(&own.line).map(Vec::as_slice).unwrap_or_default();
        library.tools.push(tool(&own, words));
    }
    Ok(library)
}

/// The words of each line without its remark, by the number of the line. A number of a tool is there once: controls do not
/// agree which of two lines counts.
fn words(sources: &Sources, id: FileId) -> Result<BTreeMap<u32, Vec<String>>> {
    let (mut all, mut numbers, mut start) = (BTreeMap::new(), BTreeMap::new(), 0);
    for (line, text) in (1u32..).zip(sources.text(id).split_inclusive('\n')) {
        let code = &text[..text.find(';').unwrap_or(text.len())];
        let words: Vec<String> = code.split_whitespace().map(str::to_ascii_uppercase).collect();
        let number = words.iter().find_map(|word| word.strip_prefix('T')?.parse::<f64>().ok());
        if let Some(first) = number.and_then(|number| numbers.insert(number.to_bits(), line)) {
            let place = Span { file: id, start, end: start + code.trim_end().len() as u32 };
            let message = format!("T{} is in the table twice", number.unwrap_or_default());
            return Err(Finding::error(Code::TOOL_FILE, message)
                .at(sources.locate(place))
                .help(format!("its first line is {first}: leave one of them out"))
                .into());
        }
        all.insert(line, words);
        start += text.len() as u32;
    }
    Ok(all)
}

fn tool(own: &TableTool, words: &[String]) -> LibraryTool {
    let (name, changed) = fit_name(&own.remark);
    let mut tool = LibraryTool::of(ToolTable {
        name,
        diameter: own.diameter.unwrap_or(0.0),
        ..ToolTable::bare(own.number)
    });
    if own.number == 0 {
        tool.lacks("number", "0 is no tool");
    }
    if own.diameter.is_none() {
        tool.lacks("diameter", "no D in the table");
    }
    let remark = own.remark.to_uppercase();
    match kind_in(&remark).and_then(kind) {
        Some(kind) => {
            tool.table.kind = kind;
            tool.assumed.push("the type, from the remark".to_owned());
        }
        None => tool.lacks("type", "a tool table has none, nor has the remark"),
    }
    let (length, mut dropped) = (own.offset[2], Vec::new());
    if length > 0.0 {
        tool.table.gauge_length = Some(length);
        tool.assumed.push(format!("gauge_length {} mm, as Z counts from the spindle", rounded(length)));
    } else if length < 0.0 {
        dropped.push(format!("Z ({} mm: below 0 it is no length of a tool)", rounded(length)));
    }
    let words_of_remark = || remark.split(|c: char| !c.is_alphabetic());
    match tool.table.kind {
        ToolType::Tapered => {
            tool.lacks("half_angle", "not in a tool table");
            // The diameter of the table of a tapered tool is that of its tip.
            if let Some(largest) = own.diameter {
                tool.table.diameter = 0.0;
                tool.lacks("diameter", "that of the tip is not in a tool table");
                dropped.push(format!("D ({} mm, the largest diameter)", rounded(largest)));
            }
        }
        ToolType::BullNose => tool.lacks("corner_radius", "not in a tool table"),
        ToolType::Drill if words_of_remark().any(|word| OTHER_POINTS.iter().any(|w| word.starts_with(w))) => {
            tool.lacks("point", "not in a tool table");
        }
        _ => {}
    }
    tool.lacks("flute_length", "not in a tool table");
    let said = |word: &&String| word.get(1..).and_then(|n| n.parse::<f64>().ok()).is_some_and(|n| n != 0.0);
    let left = words.iter().filter(said).filter(|word| !word.starts_with(|c| TAKEN.contains(c)));
    dropped.extend(left.map(|word| word[..1].to_owned()));
    tool.dropped = dropped;
    if changed {
        tool.dropped.push("the end of the remark".to_owned());
    }
    tool
}

/// The type of a kind that a remark names.
fn kind(word: &str) -> Option<ToolType> {
    serde_json::from_value(word.into()).ok()
}
