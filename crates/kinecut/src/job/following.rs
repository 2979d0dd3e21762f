//! Options for following the program of a setup, and the places of its lines.

use std::cell::Cell;

use super::check::Job;
use super::plan::SetupPlan;
use crate::base::{FileId, Location, Sources, Span};
use crate::trace::{RegisterState, TraceOptions};

/// Distance of the chords along which the tip is followed while rotary axes turn freely [mm].
pub(crate) const CHORD: f64 = 1e-3;

/// Options for following the program of a setup.
pub(crate) fn trace_options<'a>(job: &'a Job, planned: &'a SetupPlan) -> TraceOptions<'a> {
    TraceOptions {
        chord: CHORD,
        machine: job.machine.as_ref(),
        tools: &job.tools,
        retract_height: planned.retract_height,
        operator: RegisterState::default(),
        radii: &planned.radii,
        comp_start: job.post.control.comp_start(),
    }
}

/// A whole line of the program as a place.
pub(crate) fn line_place(file: &str, text: &str, line: Option<u32>) -> Option<Location> {
    LinePlaces::new(file, text).at(line)
}

/// Places of whole lines of a program: the next one is sought from the last on.
pub(crate) struct LinePlaces<'a> {
    file: &'a str,
    text: &'a str,
    /// A line, 0-based, and its first byte.
    last: Cell<(u32, usize)>,
}

impl<'a> LinePlaces<'a> {
    pub(crate) fn new(file: &'a str, text: &'a str) -> LinePlaces<'a> {
        LinePlaces { file, text, last: Cell::default() }
    }

    /// The place of a line, 0-based.
    pub(crate) fn at(&self, line: Option<u32>) -> Option<Location> {
        let line = line?;
        let (mut number, mut start) = self.last.get();
        if line < number {
            (number, start) = (0, 0);
        }
        while number < line {
            let Some(length) = self.text[start..].find('\n') else { return Some(self.beyond(line)) };
            (number, start) = (number + 1, start + length + 1);
        }
        self.last.set((number, start));
        let text = self.text[start..].lines().next().unwrap_or_default();
        let (start, end) = (start as u32, (start + text.len()) as u32);
        let (file, text) = (self.file.to_owned(), text.to_owned());
        Some(Location { file, line: line + 1, column: 1, start, end, text })
    }

    /// The end of a text that has no such line.
    fn beyond(&self, line: u32) -> Location {
        let mut sources = Sources::default();
        let id: FileId = sources.add(self.file, self.text);
        let start: usize = self.text.split_inclusive('\n').take(line as usize).map(str::len).sum();
        let length = self.text[start..].lines().next().map_or(0, str::len);
        sources.locate(Span { file: id, start: start as u32, end: (start + length) as u32 })
    }
}
