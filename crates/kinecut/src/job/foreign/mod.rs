//! Programs that others wrote: read as their control reads them, and followed on the machine.
//!
//! Nothing is planned and nothing is posted: the text itself is what is simulated, so that every finding stands at a block
//! of the file.

pub(crate) mod follow;
pub(crate) mod given;
mod magazine;
pub(crate) mod registers;

use std::fmt;

pub(crate) use follow::{Followed, Missing, at_block, follow};
pub use given::{
    GivenFile, GivenJob, ProgramWants, control_of, control_of_name, given_alone, given_with_job,
};

use super::check::{Job, JobProgram};
use super::outcome::{Outcome, SetupOutcome};
use super::plan::Planned;
use super::read_back::ReadBack;
use super::run::run_checked;
use crate::base::{Finding, Progress, Result, at_most};
use crate::nc::{Control, PostNotes, Posted};
use crate::operations::known::Known;
use crate::trace::Trace;

/// What reading a program of others has shown.
#[derive(Clone, Debug)]
pub struct Foreign {
    /// The control that runs it.
    pub control: Control,
    /// Warnings of the reader, and registers that are not the tools' own.
    pub findings: Vec<Finding>,
    /// What was read and is not followed.
    pub unfollowed: Vec<Unfollowed>,
    /// Largest difference of the distances of start and end from the centre of an arc, as written [mm].
    pub radius_difference: f64,
}

/// Something that was read and is not followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unfollowed {
    /// Line of the program, from 1.
    pub line: Option<u32>,
    /// In words.
    pub what: String,
}

impl fmt::Display for Unfollowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}

impl Foreign {
    /// What reading proves of a file.
    pub(crate) fn claim(&self, file: &str) -> String {
        format!("`{file}` was read whole as {} reads it: no word of it is skipped", self.control.title())
    }

    /// The bound of that claim.
    pub(crate) fn bound(&self, done: &SetupOutcome) -> String {
        let moves = done.trace.segments.iter().filter(|s| !s.alternative).count();
        format!(
            "{} lines, {moves} moves; ends of arcs off their circles by {} \u{b5}m",
            done.posted.text.lines().count(),
            at_most(self.radius_difference * 1e3, 2)
        )
    }
}

/// Reads the program of a setup and follows it.
///
/// # Errors
/// Those of the reader and of the trace, each at its place in the program.
pub(crate) fn foreign_setup(
    job: &Job,
    setup: usize,
    program: &JobProgram,
    planned: Planned,
) -> Result<SetupOutcome> {
    let Followed { reading, trace, lines, findings, unfollowed, .. } =
        follow(job, setup, program, Missing::Refused)?;
    let posted = Posted {
        text: program.text.clone(),
        lines: vec![None; program.text.split('\n').count()],
        notes: PostNotes::default(),
    };
    Ok(SetupOutcome {
        file: program.file.clone(),
        planned,
        posted,
        plan_trace: Trace::default(),
        program: reading.program,
        trace,
        read_back: ReadBack::default(),
        lines,
        foreign: Some(Foreign {
            control: program.control,
            findings,
            unfollowed,
            radius_difference: reading.radius_difference,
        }),
        known: Known::default(),
    })
}

/// Simulates a program that is given by itself: cut, compared and judged as a job's.
///
/// # Errors
/// Those of [`run`](super::run).
pub fn simulate_given(given: GivenJob, progress: &dyn Progress) -> Result<Outcome> {
    let (name, job, subjects, place) = given.into_parts();
    run_checked(&name, job, (subjects, Vec::new()), &|e| place.locate(e), progress)
}
