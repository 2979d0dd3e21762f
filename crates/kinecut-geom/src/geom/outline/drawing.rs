//! Lines and arcs that a reader collects from a file, to become an outline.
//!
//! Each edge carries in its label the number of the entity it comes from, so that errors name the entity and its line
//! and weights stay with their edges whichever way the loops are turned.

use super::OutlineEdge;
use super::source::Source;
use crate::base::{Code, Finding};

/// Most notes of one kind that are given each a sentence of its own.
const MOST_SENTENCES: usize = 5;

/// An entity of a file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Origin {
    /// Its kind as the file calls it.
    pub(super) what: String,
    /// First byte in the file, where known.
    pub(super) offset: Option<usize>,
    /// Layer or name.
    pub(super) label: Option<String>,
    /// Weight of its edges, if the file gives one.
    pub(super) weight: Option<f64>,
}

/// Entities of a file as lines and arcs [mm].
pub(super) struct Drawing {
    pub(super) source: Source,
    pub(super) origins: Vec<Origin>,
    /// Closed loops.
    pub(super) loops: Vec<Vec<OutlineEdge>>,
    /// Open chains of edges, to be joined at their ends.
    pub(super) paths: Vec<Vec<OutlineEdge>>,
    pub(super) notes: Vec<String>,
}

impl Drawing {
    pub(super) fn new(source: Source) -> Drawing {
        Drawing { source, origins: Vec::new(), loops: Vec::new(), paths: Vec::new(), notes: Vec::new() }
    }

    /// Adds an entity; its edges are given this label.
    pub(super) fn origin(&mut self, origin: Origin) -> u32 {
        self.origins.push(origin);
        // More entities than 32 bits count do not fit into memory.
        u32::try_from(self.origins.len() - 1).unwrap_or(u32::MAX)
    }

    /// An entity by words: "LINE on layer "0" (line 12)".
    pub(super) fn entity(&self, label: u32) -> String {
        self.origins.get(label as usize).map_or_else(String::new, |o| {
            let label = o.label.as_ref().map(|l| format!(" of {l:?}")).unwrap_or_default();
            let line = o.offset.map(|at| format!(" in line {}", self.source.line(at))).unwrap_or_default();
            format!("{}{label}{line}", o.what)
        })
    }

    /// An error at an entity.
    pub(super) fn error_at(&self, label: u32, code: Code, message: impl Into<String>) -> Finding {
        let finding = Finding::error(code, message);
        match self.origins.get(label as usize) {
            Some(Origin { offset: Some(at), .. }) => finding.at(self.source.at(*at)),
            _ => finding.at(self.source.file()),
        }
    }
}

/// Notes of one kind: a few sentences, and how many more there are.
pub(super) fn sentences(kind: &str, each: &[String]) -> Vec<String> {
    let mut notes: Vec<String> = each.iter().take(MOST_SENTENCES).cloned().collect();
    if each.len() > MOST_SENTENCES {
        notes.push(format!("{kind}: {} more", each.len() - MOST_SENTENCES));
    }
    notes
}
