//! INI files of LinuxCNC: `[SECTION]`, `KEY = value`, comments from `#` or `;` at the start of a line.

use super::{Fate, ImportedLine, wrong};
use crate::base::{FileId, Result, Sources, Span};

/// Sections about the chain of axes; lines of other sections are never used, which is reported once.
const OURS: &[&str] = &["EMC", "KINS", "TRAJ", "HAL"];

/// A key with its value.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) section: String,
    pub(super) key: String,
    pub(super) value: String,
    pub(super) span: Span,
    pub(super) used: Option<String>,
}

/// The entries of an INI file, in order.
#[derive(Clone, Debug, Default)]
pub(super) struct Ini {
    pub(super) entries: Vec<Entry>,
}

impl Ini {
    /// Reads a text; a line that is no section, key or comment is an error.
    pub(super) fn read(sources: &Sources, file: FileId) -> Result<Ini> {
        let mut ini = Ini::default();
        let mut section = String::new();
        let mut start = 0usize;
        for raw in sources.text(file).split_inclusive('\n') {
            let line = raw.trim();
            let lead = raw.len() - raw.trim_start().len();
            let span = Span { file, start: (start + lead) as u32, end: (start + lead + line.len()) as u32 };
            start += raw.len();
            if line.is_empty() || line.starts_with(['#', ';']) {
                continue;
            }
            if let Some(name) = line.strip_prefix('[') {
                let Some((name, _)) = name.split_once(']') else {
                    return Err(wrong(sources, span, "a section is not closed by `]`".to_owned()));
                };
                section = name.trim().to_ascii_uppercase();
                continue;
            }
            let Some((key, value)) = line.split_once('=') else {
                return Err(wrong(sources, span, format!("`{line}` is neither a section nor KEY = value")));
            };
            ini.entries.push(Entry {
                section: section.clone(),
                key: key.trim().to_ascii_uppercase(),
                value: value.trim().to_owned(),
                span,
                used: None,
            });
        }
        Ok(ini)
    }

    /// The entries of a key.
    pub(super) fn all<'a>(&'a self, section: &'a str, key: &'a str) -> impl Iterator<Item = &'a Entry> {
        self.entries.iter().filter(move |e| e.section == section && e.key == key)
    }

    /// The first entry of a key, marked as used for `what`; LinuxCNC takes the first too.
    pub(super) fn take(&mut self, section: &str, key: &str, what: &str) -> Option<Entry> {
        let entry = self.entries.iter_mut().find(|e| e.section == section && e.key == key)?;
        entry.used = Some(what.to_owned());
        Some(entry.clone())
    }

    /// True if the file has this section.
    pub(super) fn has(&self, section: &str) -> bool {
        self.entries.iter().any(|e| e.section == section)
    }

    /// Fate of each entry.
    pub(super) fn lines(&self, sources: &Sources) -> Vec<ImportedLine> {
        let line = |e: &Entry| {
            // Commands of the HAL are reported with the HAL.
            if e.section == "HAL" && e.key == "HALCMD" {
                return None;
            }
            let fate = match &e.used {
                Some(what) => Fate::Used(what.clone()),
                None => Fate::Ignored(why_ignored(e)),
            };
            Some(ImportedLine {
                file: sources.name(e.span.file).to_owned(),
                line: sources.line(e.span),
                text: format!("[{}]{} = {}", e.section, e.key, e.value),
                fate,
            })
        };
        self.entries.iter().filter_map(line).collect()
    }
}

fn why_ignored(e: &Entry) -> String {
    let axis = e.section.starts_with("AXIS_");
    let joint = e.section.starts_with("JOINT_");
    let limit = matches!(e.key.as_str(), "MIN_LIMIT" | "MAX_LIMIT" | "MAX_VELOCITY" | "MAX_ACCELERATION");
    let why = match (axis, joint, limit, e.key.as_str()) {
        (true, _, true, _) => "limits of a coordinate; those of its joint count",
        (_, true, true, _) => "this joint moves no axis of the chain",
        (_, _, _, "HALFILE" | "POSTGUI_HALFILE") => "not read here, or a script",
        _ if axis || joint => "homing and following, not geometry",
        _ if OURS.contains(&e.section.as_str()) => "no geometry of the machine",
        _ => "this section is not about the machine's axes",
    };
    why.to_owned()
}
