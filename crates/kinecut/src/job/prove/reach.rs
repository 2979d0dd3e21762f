//! Work that is deeper than the flutes: a drilled hole from which chips cannot leave, a wall along which the shank rubs.

use super::work::Work;
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::stock::near::{tops, touches};

/// Depth beyond the flutes that counts [mm].
const LEAST: f64 = 0.05;
/// The shank is as thick as the cutter when it is thinner by no more than this in diameter [mm].
const AS_THICK: f64 = 0.02;
/// Most places at which a shank is looked at, for each piece of work.
const MOST: usize = 50;

pub(super) fn reach(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated
        .works
        .iter()
        .filter_map(|work| match work.tool.cutter.is_axial() {
            true => drill(simulated, work),
            false => mill(simulated, work),
        })
        .collect()
}

/// The first hole that is deeper than the flutes.
fn drill(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let stock = &simulated.simulation.stock;
    let ring = [work.radius() + 0.1, work.radius() + 2.0 * simulated.job.step + 1.0];
    let flutes = work.tool.flute_length;
    let down = |d: &&Done<'_>| {
        let way = d.segment.curve.end() - d.segment.curve.start();
        d.cuts() && d.segment.turning.is_none() && way.dot(d.segment.axis) < -0.99 * way.length()
    };
    work.feeds().filter(down).find_map(|d| {
        let (tip, axis) = d.segment.tool_at(1.0);
        // The lowest material around the hole, as it is in the end: no hole is deeper than it was.
        let rim = tops(stock, tip, axis, ring).into_iter().reduce(f64::min)?;
        let depth = rim - tip.dot(axis);
        (depth > flutes + LEAST).then(|| {
            let message =
                format!("{} drills deeper than its flutes: chips cannot leave the hole", work.tool.number);
            let finding = Finding::error(Code::TOO_DEEP, message)
                .value((depth * 100.0).round() / 100.0, "mm deep")
                .bound(flutes, "mm, `flute_length`")
                .help("take a longer drill, or drill less deep");
            simulated.at(work.setup, d.segment.item, finding)
        })
    })
}

/// The first cut in which a shank as thick as the cutter rubs along a wall.
fn mill(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let tool = work.tool;
    let (shank, at) = tool.shank_profile().ok()??;
    let cutter = tool.cutter.diameter(tool.flute_length);
    if tool.shank_diameter < cutter - AS_THICK || tool.shank_diameter > cutter + AS_THICK {
        // A thinner one is free; a thicker one overlaps, which is found as such.
        return None;
    }
    let stock = simulated.job.stock.bounds();
    let deep = |d: &&Done<'_>| {
        let (tip, up) = d.segment.tool_at(1.0);
        let top = (stock.min * up).max(stock.max * up).element_sum();
        d.cuts() && top - tip.dot(up) > tool.flute_length + LEAST
    };
    work.feeds().filter(deep).take(MOST).find_map(|d| {
        let rubs = |share: f64| {
            let (tip, axis) = d.segment.tool_at(share);
            touches(&simulated.simulation.stock, &[(&shank, at)], tip, axis, AS_THICK)
        };
        (rubs(0.5) || rubs(1.0)).then(|| {
            let message = format!(
                "the shank of {} rubs along a wall: the flutes are shorter than it is high",
                tool.number
            );
            let finding = Finding::warning(Code::TOO_DEEP, message)
                .bound(tool.flute_length, "mm, `flute_length`")
                .help(
                    "take longer flutes or a thinner shank; if it is thinner, say so with `shank_diameter`",
                );
            simulated.at(work.setup, d.segment.item, finding)
        })
    })
}
