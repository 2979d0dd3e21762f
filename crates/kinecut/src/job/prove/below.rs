//! A tool that goes below the part: into the table where that is stated, else farther below the stock than a through hole
//! or an outline needs.

use glam::DVec3;

use super::Simulated;
use super::work::{Work, works};
use crate::base::{Code, Finding};
use crate::geom::{Aabb, Rigid};
use crate::operations::OperationPlan;
use crate::stock::cut::CutAxis;
use crate::tool::Tool;
use crate::trace::Segment;

/// The table, parallels and vise lie under the stock and around it; farther out lies the place where tools are changed [mm].
const AROUND: f64 = 50.0;
/// Depth that is rounding of coordinates [mm].
const ROUNDING: f64 = 2e-3;

pub(super) fn below(simulated: &Simulated<'_>) -> Vec<Finding> {
    works(simulated).iter().filter_map(|work| one(simulated, work)).collect()
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
            None => depth_below(done.segment, stock, near) - allowed,
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

/// Places along a segment that lie above, under or near the stock.
fn places(segment: &Segment, near: Aabb, axis: DVec3) -> impl Iterator<Item = DVec3> + '_ {
    /// Steps along a segment; a line has its depth at its ends, but may be near the stock only between them.
    const STEPS: u32 = 32;
    let length = segment.curve.length();
    (0..=STEPS)
        .map(move |i| segment.curve.at(length * f64::from(i) / f64::from(STEPS)).p)
        .filter(move |p| (0..3).all(|i| axis[i].abs() > 0.5 || (p[i] >= near.min[i] && p[i] <= near.max[i])))
}

/// Depth of the tip below the side of the stock that the tool points to [mm].
fn depth_below(segment: &Segment, stock: Aabb, near: Aabb) -> f64 {
    let Some(axis) = CutAxis::of(segment.axis).map(CutAxis::vector) else { return f64::NEG_INFINITY };
    let under = (stock.min * axis).min(stock.max * axis).element_sum();
    let bounds = segment.curve.bounds();
    let low = (bounds.min * axis).min(bounds.max * axis).element_sum();
    if under - low <= 0.0 {
        return under - low;
    }
    places(segment, near, axis).map(|p| under - p.dot(axis)).fold(f64::NEG_INFINITY, f64::max)
}

/// Lowest point of tool, shank and holder along Z of the work offset, while the tool is near the stock [mm].
fn lowest(tool: &Tool, segment: &Segment, to_work: &Rigid, near: Aabb) -> f64 {
    let up = to_work.inverse().vector(DVec3::Z);
    let lean = segment.axis.dot(up).clamp(-1.0, 1.0);
    let aside = (1.0 - lean * lean).max(0.0).sqrt();
    // Heights above the tip and radii at them.
    let mut rings = vec![
        (
            if aside > 1e-6 { tool.cutter.tip_height() } else { 0.0 },
            0.5 * tool.cutter.diameter(tool.flute_length),
        ),
        (tool.flute_length, 0.5 * tool.cutter.diameter(tool.flute_length)),
        (tool.stickout, 0.5 * tool.shank_diameter),
    ];
    let mut height = tool.stickout;
    for part in tool.holder.iter().flat_map(|h| &h.segments) {
        rings.push((height, 0.5 * part.lower_diameter));
        height += part.height;
        rings.push((height, 0.5 * part.upper()));
    }
    let body = rings.iter().map(|(z, r)| z * lean - r * aside).fold(0.0, f64::min);
    let along = CutAxis::of(up).map_or(DVec3::ZERO, CutAxis::vector);
    places(segment, near, along).map(|p| to_work.point(p).z + body).fold(f64::INFINITY, f64::min)
}
