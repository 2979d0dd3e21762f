//! Cutters whose edges rub: the thickest chip is thinner than the rounding of an edge can cut.

use super::Simulated;
use super::work::Work;
use crate::base::{Code, Finding};
use crate::job::engagement::Chips;

/// Diameter up to which mills are mostly solid [mm]; larger ones carry inserts.
const SOLID: f64 = 20.0;
/// Radius of the edges of solid cutters, and of inserts [mm]: usual ones of coated carbide.
const EDGES: [f64; 2] = [0.010, 0.020];
/// Share of that radius below which nothing is cut.
const LEAST: f64 = 0.3;

/// A warning for each piece of work in which no chip is thick enough, at the block of the thickest.
pub(super) fn rubs(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().filter_map(|work| one(simulated, work)).collect()
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let engagement = simulated.simulation.engagement.as_ref()?;
    if work.tool.cutter.is_axial() {
        return None;
    }
    let done = &simulated.setups[work.setup];
    let chip = |d: &super::Done<'_>| {
        let chips = Chips::of(done, d.segment, &simulated.job.tools)?;
        let moved = engagement.moves[work.setup].get(d.index)?;
        let advance = moved.stretches.iter().map(|s| s.advance).fold(0.0, f64::max);
        (advance > 0.0).then(|| (d.segment.item, chips.thickest(advance)))
    };
    let (item, thickest) = work.feeds().filter_map(chip).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let edge = EDGES[usize::from(2.0 * work.radius() > SOLID)];
    if thickest >= LEAST * edge {
        return None;
    }
    let message = format!("{} rubs: its thickest chip is too thin for a usual edge", work.tool.number);
    let finding = Finding::warning(Code::EDGE_RUBS, message)
        .value_mm((thickest * 1e4).round() / 1e4)
        .bound(LEAST * edge, &format!("mm, {LEAST} of an edge rounded by {edge} mm"))
        .help("take a higher feed per tooth, or fewer teeth");
    Some(simulated.at(work.setup, item, finding))
}
