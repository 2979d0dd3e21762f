//! Walls from which the tool that finishes them is pressed away by more than they allow. By what finishing is planned to take: the
//! lines of the stock are too far apart for cuts as thin as these.

use super::work::Work;
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::cutting::FORCE_SPREAD;
use crate::job::engagement::{deflection_beside, force_of};
use crate::program::Role;

/// Share of a tolerance that is asked for, and the deflection that counts where none is [mm].
const SHARE: f64 = 1.0 / 3.0;
const MOST: f64 = 0.02;

/// A warning for each piece of work: at the block in which finishing begins.
pub(super) fn deflection(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().filter_map(|work| one(simulated, work)).collect()
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let operation = work.operation.filter(|o| o.spring_passes() == 0)?;
    let cut = operation.finishing()?;
    let force = force_of(simulated.job.material.as_deref())?;
    let found = deflection_beside(&cut, &force, work.tool)?;
    let wanted = operation.milling().wanted_tolerance;
    let limit = wanted.map_or(MOST, |tolerance| SHARE * tolerance);
    if found <= limit {
        return None;
    }
    let done = &simulated.setups[work.setup];
    let finishes = |d: &&Done<'_>| {
        let planned = done.planned_item(d.segment.item);
        planned.is_some_and(|item| done.planned.program.origin(item as usize).role == Role::Finish)
    };
    let begin = work.feeds().find(finishes)?;
    let of = if wanted.is_some() { "a third of the tolerance" } else { "is usually allowed" };
    let message = format!(
        "the deflection of {} while it finishes the wall, by half of a force that is known within {:.0} %, is more than {of}",
        work.tool.number,
        100.0 * FORCE_SPREAD
    );
    let help = "add spring_passes = 1, leave less for finishing, or take a tool that sticks out less";
    let finding = Finding::warning(Code::TOOL_DEFLECTION, message)
        .value_mm(micrometre(found))
        .bound_mm(micrometre(limit))
        .help(help);
    Some(simulated.at(work.setup, begin.segment.item, finding))
}

/// To a micrometre.
fn micrometre(mm: f64) -> f64 {
    (mm * 1000.0).round() / 1000.0
}
