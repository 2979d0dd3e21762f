//! What a reader collects from a file, and how it becomes an outline.
//!
//! Each edge carries in its label the number of the entity it comes from, so that errors name the entity and its line
//! and weights stay with their edges whichever way the loops are turned.

use super::chain::chain;
use super::half_section::close_along;
use super::source::Source;
use super::{Outline, OutlineEdge, OutlineOptions, OutlineRead};
use crate::base::{Code, Finding, Result};

/// Weight of an edge that has none.
const PLAIN: f64 = 1.0;
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

    /// The outline as the options say: closed along the axis of a half section, open chains joined.
    pub(super) fn finish_with(mut self, options: &OutlineOptions) -> Result<OutlineRead> {
        if let Some(axis) = options.half_section {
            close_along(&mut self, axis, options.snap)?;
        }
        self.finish(options.snap)
    }

    /// The outline: open chains joined within `snap` [mm], what is drawn twice left out.
    pub(super) fn finish(mut self, snap: f64) -> Result<OutlineRead> {
        chain(&mut self, snap)?;
        if self.loops.is_empty() {
            let passed =
                if self.notes.is_empty() { String::new() } else { format!(" ({})", self.notes.join("; ")) };
            return Err(self
                .source
                .whole(format!("the file holds no lines or arcs of an outline{passed}"))
                .help("draw the face as closed loops of lines and arcs")
                .into());
        }
        let loops = std::mem::take(&mut self.loops);
        let origin_of: Vec<u32> = loops.iter().flatten().map(|e| e.label).collect();
        let name = |i: usize| match origin_of.get(i) {
            Some(&label) => format!("{i} ({})", self.entity(label)),
            None => i.to_string(),
        };
        let outline = Outline::named(loops, Vec::new(), &name).map_err(|mut error| {
            if error.0.place.is_none() {
                error.0.place = Some(self.source.file());
            }
            error
        })?;
        let weight =
            |e: &OutlineEdge| self.origins.get(e.label as usize).and_then(|o| o.weight).unwrap_or(PLAIN);
        let weights = outline.edges().iter().map(weight).collect();
        let mut labels: Vec<String> = self.origins.iter().filter_map(|o| o.label.clone()).collect();
        labels.sort();
        labels.dedup();
        let label_of = |origin: u32| {
            let label = self.origins.get(origin as usize)?.label.as_ref()?;
            u32::try_from(labels.binary_search(label).ok()?).ok()
        };
        let outline = outline.relabelled(|l| label_of(l).unwrap_or(OutlineEdge::NO_LABEL), labels.clone());
        Ok(OutlineRead { outline, weights, notes: self.notes })
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
