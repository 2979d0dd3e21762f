//! Programs that others wrote: read as their control reads them, and followed on the machine.
//!
//! Nothing is planned and nothing is posted: the text itself is what is simulated, so that every finding stands at a block
//! of the file.

mod registers;

use registers::Registers;

use super::check::{Job, JobProgram, JobSetup};
use super::outcome::SetupOutcome;
use super::plan::Planned;
use super::read_back::ReadBack;
use super::run::{CHORD, in_text};
use crate::base::{Code, Error, Finding, Result, Severity, Sources};
use crate::nc::{self, Control, Posted};
use crate::program::{Item, Program, ToolNumber};
use crate::trace::{Operator, Trace, TraceOptions, trace};

/// What reading a program of others has shown.
#[derive(Clone, Debug)]
pub struct Foreign {
    /// The control that runs it.
    pub control: Control,
    /// Warnings of the reader, and registers that are not the tools' own.
    pub findings: Vec<Finding>,
    /// What was read and is not followed, in words for the verdict.
    pub unfollowed: Vec<String>,
    /// Largest difference of the distances of start and end from the centre of an arc, as written [mm].
    pub radius_difference: f64,
}

impl Foreign {
    /// What reading proves of a file.
    pub(super) fn claim(&self, file: &str) -> String {
        format!("`{file}` was read whole as {} reads it: no word of it is skipped", self.control.title())
    }

    /// The bound of that claim.
    pub(super) fn bound(&self, done: &SetupOutcome) -> String {
        let moves = done.trace.segments.iter().filter(|s| !s.alternative).count();
        format!(
            "{} lines, {moves} moves; ends of arcs off their circles by {:.2} \u{b5}m at most",
            done.posted.text.lines().count(),
            self.radius_difference * 1e3
        )
    }
}

/// Reads the program of a setup and follows it.
///
/// # Errors
/// Those of the reader and of the trace, each at its place in the program.
pub(super) fn foreign_setup(
    job: &Job,
    setup: &JobSetup,
    program: &JobProgram,
    planned: Planned,
) -> Result<SetupOutcome> {
    let mut sources = Sources::default();
    let clamping = [setup.setup.clone()];
    let reading = nc::read(&mut sources, &program.file, &program.text, program.control, &clamping)?;
    let read = reading.program;
    let lines: Vec<Option<u32>> = (0..read.items.len())
        .map(|i| read.origin(i).span.map(|s| sources.line(s).saturating_sub(1)))
        .collect();
    let posted = Posted {
        text: program.text.clone(),
        lines: vec![None; program.text.split('\n').count()],
        notes: nc::PostNotes::default(),
    };
    let registers = Registers::of(job, setup, program, &read, |item| {
        read.origin(item as usize).span.map(|s| sources.locate(s))
    });
    let in_spindle = program.in_spindle.or_else(|| only_tool(job, &read));
    let options = TraceOptions {
        chord: CHORD,
        machine: job.machine.as_ref(),
        tools: &job.tools,
        retract_height: planned.retract_height,
        operator: Operator { in_spindle, lengths: &registers.lengths, own_radius: true },
        radii: &registers.radii,
        comp_start: program.control.comp_start(),
    };
    let placed = |e: Error| in_text(e, &program.file, &posted, &lines);
    let mut followed = trace(&read, &options).map_err(placed)?;
    if let Some(segment) = followed.segments.iter().find(|s| s.tool.is_none()) {
        return Err(placed(without_tool().key(format!("item[{}]", segment.item)).into()));
    }
    if let (None, Some(tool)) = (program.in_spindle, in_spindle) {
        followed.assumed.push(format!("the program calls no tool: {tool} is in the spindle"));
    }
    if program.is_latin {
        followed.assumed.push("the file is no UTF-8: it was read as Latin-1".to_owned());
    }
    let mut findings = reading.findings;
    findings.extend(registers.findings);
    let (notes, findings) = findings.into_iter().partition(|f: &Finding| f.severity == Severity::Note);
    let unfollowed = Vec::from_iter(notes).iter().map(note_text).collect();
    Ok(SetupOutcome {
        file: program.file.clone(),
        planned,
        posted,
        plan_trace: Trace::default(),
        program: read,
        trace: followed,
        read_back: ReadBack::default(),
        lines,
        foreign: Some(Foreign {
            control: program.control,
            findings,
            unfollowed,
            radius_difference: reading.radius_difference,
        }),
    })
}

/// A note of the reader in one line.
fn note_text(note: &Finding) -> String {
    match &note.place {
        Some(place) => format!("line {}: {}", place.line, note.message),
        None => note.message.clone(),
    }
}

/// The only tool of a job, when the program calls none.
fn only_tool(job: &Job, program: &Program) -> Option<ToolNumber> {
    let calls = (0..program.items.len()).any(|i| matches!(program.items.get(i), Item::Tool { .. }));
    match job.tools.as_slice() {
        [tool] if !calls => Some(tool.number),
        _ => None,
    }
}

/// The error of a program that moves before it has a tool.
fn without_tool() -> Finding {
    Finding::error(Code::NC_STATE, "the program moves before a tool is called")
        .cure("call a tool first, or say which one is in the spindle: program = { tool = 1, .. }")
}
