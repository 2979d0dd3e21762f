//! Options for following the program of a setup, and the places of its lines.

use super::check::Job;
use super::plan::SetupPlan;
use crate::base::{FileId, Location, Sources};
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
    let line = line?;
    let before = || text.split_inclusive('\n').take(line as usize);
    if before().all(|l| l.ends_with('\n')) {
        // A text has one line more than line ends.
        let (line, start) = before().fold((1, 0), |(line, at), l| (line + 1, at + l.len()));
        let text = text[start..].lines().next().unwrap_or_default();
        let (start, end) = (start as u32, (start + text.len()) as u32);
        return Some(Location { file: file.to_owned(), line, column: 1, start, end, text: text.to_owned() });
    }
    let mut sources = Sources::default();
    let id: FileId = sources.add(file, text);
    let start: usize = text.split_inclusive('\n').take(line as usize).map(str::len).sum();
    let length = text[start..].lines().next().map_or(0, str::len);
    let span = crate::base::Span { file: id, start: start as u32, end: (start + length) as u32 };
    Some(sources.locate(span))
}
