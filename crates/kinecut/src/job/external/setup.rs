//! A set-up whose program others wrote.

use std::sync::Arc;

use super::{Errors, ExternalProgram, Followed, Missing, follow};
use crate::base::{Result, at_most};
use crate::job::check::{Job, JobProgram};
use crate::job::plan::SetupPlan;
use crate::job::read_back::ReadBack;
use crate::job::setup_outcome::SetupOutcome;
use crate::nc::{PostNotes, Posted};
use crate::operations::known::Known;
use crate::trace::Trace;

impl ExternalProgram {
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
pub(crate) fn external_setup(
    job: &Job,
    setup: usize,
    program: &JobProgram,
    planned: SetupPlan,
) -> Result<SetupOutcome> {
    let done = follow(job, setup, program, Missing::Refused, Errors::Stop)?;
    let lines = done.lines();
    let Followed { reading, trace, findings, unfollowed, .. } = done;
    let posted = Posted { text: Arc::clone(&program.text), lines: Vec::new(), notes: PostNotes::default() };
    Ok(SetupOutcome {
        file: program.file.clone(),
        planned,
        posted,
        plan_trace: Trace::default(),
        program: reading.program,
        trace,
        read_back: ReadBack::default(),
        lines,
        time: None,
        external: Some(ExternalProgram {
            control: program.control,
            findings,
            unfollowed,
            radius_difference: reading.radius_difference,
        }),
        known: Known::default(),
    })
}
