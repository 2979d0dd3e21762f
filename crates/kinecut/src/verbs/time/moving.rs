//! A program on its machine, posted from a job or written by others.

use std::sync::Arc;

use crate::base::{Finding, Result};
use crate::job::external::given::GivenJob;
use crate::job::external::{Errors, Followed, Missing, at_block, follow};
use crate::job::following::line_place;
use crate::job::{Job, SetupOutcome};
use crate::nc::Control;
use crate::program::Program;
use crate::trace::Trace;

/// A program that was followed on the machine of its job.
#[derive(Debug)]
pub(super) struct MovingProgram {
    pub(super) file: String,
    pub(super) control: Control,
    pub(super) text: Arc<str>,
    pub(super) program: Program,
    pub(super) trace: Trace,
    /// For each item its line, 0-based.
    lines: Vec<Option<u32>>,
    pub(super) findings: Vec<Finding>,
    /// Parts that were read and are not followed, and assumptions.
    pub(super) remarks: Vec<String>,
}

impl MovingProgram {
    /// A program that others wrote.
    ///
    /// # Errors
    /// Those of the reader and of the trace, each at its place in the program.
    pub(super) fn of_given(given: &GivenJob) -> Result<MovingProgram> {
        let program = given.program()?;
        let done = follow(given.job(), 0, program, Missing::StoodFor, Errors::Stop)?;
        let lines = done.lines();
        let Followed { reading, trace, findings, unfollowed, .. } = done;
        let line = |item: u32| lines.get(item as usize).copied().flatten();
        let remarks = unfollowed.iter().map(ToString::to_string);
        Ok(MovingProgram {
            file: program.file.clone(),
            control: program.control,
            text: Arc::clone(&program.text),
            remarks: remarks.chain(trace.assumed.iter().cloned()).collect(),
            program: reading.program,
            findings: findings.into_iter().map(|f| *at_block(f.into(), program, line).0).collect(),
            trace,
            lines,
        })
    }

    /// The program of a setup of a job.
    pub(super) fn of_setup(job: &Job, setup: SetupOutcome) -> MovingProgram {
        let control = setup.control(job);
        let mut findings = setup.planned.findings;
        let mut remarks = Vec::new();
        if let Some(external) = setup.external {
            findings.extend(external.findings);
            remarks.extend(external.unfollowed.iter().map(ToString::to_string));
        }
        remarks.extend(setup.trace.assumed.iter().cloned());
        MovingProgram {
            file: setup.file,
            control,
            text: setup.posted.text,
            program: setup.program,
            trace: setup.trace,
            lines: setup.lines,
            findings,
            remarks,
        }
    }

    /// Line of an item, 0-based.
    pub(super) fn line(&self, item: u32) -> Option<u32> {
        self.lines.get(item as usize).copied().flatten()
    }

    /// A finding about an item, at its line.
    pub(super) fn at_line(&self, mut finding: Finding) -> Finding {
        if let Some(item) = finding.item.take() {
            finding.place = line_place(&self.file, &self.text, self.line(item));
        }
        finding
    }
}
