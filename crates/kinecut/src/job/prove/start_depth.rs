//! Values to start with in a cut that is deeper than they are for.

use std::f64::consts::PI;

use super::Simulated;
use super::work::Work;
use crate::base::{Code, Finding};
use crate::cutting::{Material, MaterialGroup};
use crate::tool::Cutter;

/// Depth up to which start values in the full width are for, in diameters.
const DEEPEST: f64 = 0.5;
/// Arc of contact from which on a cut counts as one of the full width [rad].
const WIDE: f64 = 5.0 / 6.0 * PI;

/// A warning for each operation that cuts steel, iron or titanium in the full width of an end mill deeper than start values are
/// for: at the deepest block.
pub(super) fn start_depth(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().filter_map(|work| one(simulated, work)).collect()
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let (job, number) = (simulated.job, work.number?);
    let before: usize = job.setups[..work.setup].iter().map(|s| s.operations.len()).sum();
    let at = (work.setup, (number as usize).checked_sub(before)?);
    let is_start = job.cutting.iter().any(|taken| taken.operation == at && taken.has_start());
    let is_mill = matches!(
        work.tool.cutter,
        Cutter::EndMill { .. } | Cutter::BullNose { .. } | Cutter::BallNose { .. }
    );
    let material = Material::of(job.material.as_deref()?)?;
    let is_soft = matches!(material.group, MaterialGroup::NonFerrous | MaterialGroup::Plastic);
    if !is_start || !is_mill || is_soft {
        return None;
    }
    let moves = &simulated.simulation.engagement.as_ref()?.moves[work.setup];
    let depth = |d: &super::Done<'_>| {
        let wide = moves.get(d.index)?.stretches.iter().filter(|s| s.arc >= WIDE);
        Some((d.segment.item, wide.map(|s| s.depth).reduce(f64::max)?))
    };
    let (item, deepest) = work.feeds().filter_map(depth).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let most = DEEPEST * 2.0 * work.radius();
    // A level is not deeper for a hundredth of a millimetre.
    const SAME: f64 = 0.01;
    if deepest <= most + SAME {
        return None;
    }
    let message = format!(
        "{} has values to start with, and cuts its full width deeper than they are for",
        work.tool.number
    );
    let finding = Finding::warning(Code::START_DEPTH, message)
        .value_mm((deepest * 100.0).round() / 100.0)
        .bound(most, "mm, half its diameter")
        .help(format!("write stepdown = {most}, or give speed and feed of your own"));
    Some(simulated.at(work.setup, item, finding))
}
