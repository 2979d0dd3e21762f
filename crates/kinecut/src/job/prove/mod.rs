//! What is held against a program that was simulated, one rule a file: rules that neither the control nor the lines of the
//! stock know, for programs of kinecut and of others alike.

mod axis_speed;
mod swept;
pub(super) mod turned;
mod turned_into;
mod unknown_start;

use super::check::Job;
use super::outcome::SetupOutcome;
use super::run::line_place;
use super::simulate::Simulation;
use crate::base::{Finding, Location};

/// A simulated job, as rules see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Simulated<'a> {
    /// The job.
    pub(super) job: &'a Job,
    /// Its programs, followed.
    pub(super) setups: &'a [SetupOutcome],
    /// The cut stock, and what each segment did to it.
    pub(super) simulation: &'a Simulation,
}

impl Simulated<'_> {
    /// The block of an item of a setup's program.
    pub(super) fn place(&self, setup: usize, item: u32) -> Option<Location> {
        let done = &self.setups[setup];
        let line = done.lines.get(item as usize).copied().flatten();
        line_place(&done.file, &done.posted.text, line)
    }
}

/// A rule: what it finds, in the order of the program.
type Rule = fn(&Simulated<'_>) -> Vec<Finding>;

/// All rules; each is a file of this folder.
const RULES: &[Rule] =
    &[turned::turned, turned_into::turned_into, unknown_start::unknown_start, axis_speed::axis_speed];

/// What all rules find.
pub(super) fn findings(simulated: &Simulated<'_>) -> Vec<Finding> {
    RULES.iter().flat_map(|rule| rule(simulated)).collect()
}
