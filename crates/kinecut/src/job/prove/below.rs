//! A tool that goes below the part: into the table where that is stated, else farther below the stock than a through hole
//! or an outline needs.

use glam::DVec3;

use super::Simulated;
use super::work::{Work, highest, passes};
use crate::base::{Code, Finding};
use crate::geom::{Aabb, Rigid};
use crate::operations::OperationPlan;
use crate::tool::Tool;
use crate::trace::Segment;

/// The table, parallels and vise lie under the stock and around it; farther out lies the place where tools are changed [mm].
const AROUND: f64 = 50.0;
/// Depth that is rounding of coordinates [mm].
const ROUNDING: f64 = 2e-3;

pub(super) fn below(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().filter_map(|work| one(simulated, work)).collect()
}

/// The first block of a piece of work that goes too deep, with the greatest depth of all of them.
fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let setup = &simulated.job.setups[work.setup];
    let stock = simulated.job.stock.bounds();
    let near = stock.grown(work.radius() + AROUND);
    let own = planned(simulated, work).map_or(0.0, OperationPlan::breakthrough);
    let breakthrough = if own > setup.breakthrough { own } else { setup.breakthrough };
    let allowed = breakthrough + work.tool.cutter.tip_height();
    let to_work = setup.to_work();
    let mut worst: Option<(u32, f64)> = None;
    let mut blocks: Vec<u32> = Vec::new();
    for done in &work.done {
        let depth = match setup.table {
            Some(table) => table - lowest(work.tool, done.segment, &to_work, near),
            None => depth_below(done.segment, stock, near, allowed) - allowed,
        };
        if depth > ROUNDING {
            blocks.push(done.segment.item);
            let deepest = worst.map_or(depth, |(_, d)| if d > depth { d } else { depth });
            worst = Some((blocks[0], deepest));
        }
    }
    let (item, depth) = worst?;
    blocks.dedup();
    let also = match blocks.len() {
        1 => String::new(),
        n => format!(" (in {n} blocks, this is the first)"),
    };
    let finding = match setup.table {
        Some(table) => {
            Finding::error(Code::BELOW_STOCK, format!("{} goes into the table{also}", work.tool.number))
                .value(depth, "mm below it")
                .bound(table, "mm, `table` of the setup")
                .help("correct the depth")
        }
        None => {
            let message =
                format!("{} goes far below the stock, where table or vise may stand{also}", work.tool.number);
            Finding::error(Code::BELOW_STOCK, message)
                .value(depth + allowed, "mm below it")
                .bound(allowed, "mm, its point and `breakthrough`")
                .help("correct the depth; else set `breakthrough` of the setup, or its `table`")
        }
    };
    Some(simulated.at(work.setup, item, finding))
}

/// The plan of a piece of work, where its operation was planned.
fn planned<'a>(simulated: &Simulated<'a>, work: &Work<'_>) -> Option<&'a OperationPlan> {
    let mut operations = simulated.setups[work.setup].planned.operations.iter();
    operations.find(|o| Some(o.number) == work.number).map(|o| &o.plan)
}

/// Tips and axes of the tool along a segment.
fn places(segment: &Segment) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    /// Steps along a segment; a line has its depth at its ends, but may be near the stock only between them.
    const STEPS: u32 = 32;
    (0..=STEPS).map(move |i| segment.tool_at(f64::from(i) / f64::from(STEPS)))
}

/// Depth of the tip below the side of the stock that the tool points to [mm]; or a greater number that is no more than `allowed`.
fn depth_below(segment: &Segment, stock: Aabb, near: Aabb, allowed: f64) -> f64 {
    let under = |axis: DVec3| -highest(stock, -axis);
    if segment.turning.is_none() {
        let axis = segment.axis;
        let most = under(axis) + highest(segment.curve.bounds(), -axis);
        if most <= 0.0 {
            return most;
        }
    }
    // Whatever its axis, the tip is no deeper than it is far from the stock.
    let tips = segment.curve.bounds();
    let far = (stock.min - tips.min).max(tips.max - stock.max).max(DVec3::ZERO).length();
    if far <= allowed {
        return far;
    }
    let beside = places(segment).filter(|(tip, axis)| passes(*tip, *axis, near));
    beside.map(|(tip, axis)| under(axis) - tip.dot(axis)).fold(f64::NEG_INFINITY, f64::max)
}

/// Lowest point of tool, shank and holder along Z of the work offset, while the tool is near the stock [mm].
fn lowest(tool: &Tool, segment: &Segment, to_work: &Rigid, near: Aabb) -> f64 {
    let up = to_work.inverse().vector(DVec3::Z);
    // A tool whose numbers make no body is refused before.
    let parts = tool.profiles().unwrap_or_default();
    let lowest = |(tip, axis): (DVec3, DVec3)| {
        let lean = axis.dot(up).clamp(-1.0, 1.0);
        let aside = (1.0 - lean * lean).max(0.0).sqrt();
        let below = parts.iter().map(|(profile, at)| profile.support(aside, -lean) - at * lean);
        to_work.point(tip).z - below.fold(f64::NEG_INFINITY, f64::max)
    };
    places(segment).filter(|(tip, _)| passes(*tip, up, near)).map(lowest).fold(f64::INFINITY, f64::min)
}
