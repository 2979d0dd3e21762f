//! Feeding through air at depth: below the top of the stock, within its outline, and neither in material nor along any.
//!
//! A right program feeds through air too: on its approach, over what a level before has cleared, on its way out. So
//! three patterns are reported: a piece of work whose way at depth is nearly all in air, a drilling cycle that meets
//! nothing, and a single way that is far longer than any of these. A tool that rubs along a wall or floor that stays (a
//! spring pass) is not in air.

mod ways;

use glam::DVec3;
use rayon::prelude::*;

use self::ways::{AirMove, Ways};
use super::work::{Work, highest, passes};
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::geom::Aabb;
use crate::job::look::TOUCH;
use crate::program::Item;
use crate::stock::near::{may_touch, touches};
use crate::tool::Cutter;

/// Share of the way at depth in air from which a piece of work is reported.
const NEARLY_ALL: f64 = 0.9;
/// Shortest way in air of that piece: in diameters of the tool, and [mm].
const SHORT: [f64; 2] = [4.0, 10.0];
/// Shortest single way through air that is reported: in diameters of the tool, and [mm].
const LONG: [f64; 2] = [20.0, 200.0];

pub(super) fn air(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().flat_map(|work| one(simulated, work)).collect()
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Vec<Finding> {
    // A piece of work that meets nothing at all is reported, unless other tools of the program do.
    let external = simulated.setups[work.setup].external.is_some();
    let idle = !work.done.iter().any(Done::met);
    // A tap runs in a hole that is there: its thread is not simulated.
    if matches!(work.tool.cutter, Cutter::Tap(_))
        || idle && !(external && simulated.segments(work.setup).any(|d| d.met()))
    {
        return Vec::new();
    }
    let Ok(cutting) = work.tool.cutting_profile() else { return Vec::new() };
    let diameter = 2.0 * work.radius();
    let most = |[diameters, least]: [f64; 2]| {
        if diameters * diameter > least { diameters * diameter } else { least }
    };
    let feeds: Vec<&Done<'_>> = work.feeds().collect();
    let (stock, radius) = (simulated.job.stock.bounds(), work.radius());
    // Material nearby counts only if a path that meets nothing could be reported.
    let bounds: Vec<AirMove> = feeds.par_iter().map(|d| way(d, stock, radius, |_, _| false)).collect();
    let lines = &simulated.simulation.stock;
    let parts = [(&cutting, 0.0)];
    let near =
        |tip, axis| may_touch(lines, &parts, tip, axis, TOUCH) && touches(lines, &parts, tip, axis, TOUCH);
    let bounds = feeds.iter().map(|done| done.index).zip(bounds);
    let mut ways = Ways::new(bounds, |at| way(feeds[at], stock, radius, near));
    let finding = |message: String, way: f64| {
        Finding::warning(Code::FEED_IN_AIR, message)
            .value((way * 10.0).round() / 10.0, "mm")
            .help("look at its place, its depth and the stock")
    };
    if let Some(air) = ways.nearly_all(NEARLY_ALL, most(SHORT))
        && let Some(first) = ways.first().map(|at| feeds[at])
    {
        let message =
            format!("{} feeds through air nearly all the way that it is inside the stock", work.name);
        return vec![simulated.at(work.setup, first.segment.item, finding(message, air))];
    }
    let mut found = Vec::new();
    if let Some(item) = idle_hole((simulated, work), &feeds, &mut ways) {
        let message = format!("a drilling cycle of {} meets no material", work.tool.number);
        let whole = Finding { value: None, ..finding(message, 0.0) };
        found.push(simulated.at(work.setup, item, whole));
    }
    if let Some((way, first)) = ways.longest(most(LONG)) {
        let message = format!("{} feeds through air inside the stock for long", work.tool.number);
        found.push(simulated.at(work.setup, feeds[first].segment.item, finding(message, way)));
    }
    found
}

/// `near`: whether material is near a place of the tool, which is not in air there.
fn way(done: &Done<'_>, stock: Aabb, radius: f64, near: impl Fn(DVec3, DVec3) -> bool) -> AirMove {
    let segment = done.segment;
    let grown = stock.grown(radius);
    let up = segment.axis;
    if segment.turning.is_none() && -highest(segment.curve.bounds(), -up) >= highest(stock, up) - TOUCH {
        return AirMove { depth: 0.0, air: 0.0 };
    }
    let length = segment.curve.length();
    let steps = (length / radius).ceil().clamp(2.0, 40.0) as u32;
    let (mut deep, mut free) = (0u32, 0u32);
    for i in 0..steps {
        let (tip, axis) = segment.tool_at((f64::from(i) + 0.5) / f64::from(steps));
        let inside = passes(tip, axis, grown) && tip.dot(axis) < highest(stock, axis) - TOUCH;
        deep += u32::from(inside);
        free += u32::from(inside && !done.met() && !near(tip, axis));
    }
    let part = |n: u32| length * f64::from(n) / f64::from(steps);
    AirMove { depth: part(deep), air: part(free) }
}

/// The first drilling cycle whose drill is in air all the way.
fn idle_hole(
    (simulated, work): (&Simulated<'_>, &Work<'_>),
    feeds: &[&Done<'_>],
    ways: &mut Ways<impl Fn(usize) -> AirMove + Sync>,
) -> Option<u32> {
    /// Least depth in air [mm].
    const DEEP: f64 = 2.0;
    if !matches!(work.tool.cutter, Cutter::Drill { .. }) {
        return None;
    }
    let program = &simulated.setups[work.setup].program;
    let mut end = 0;
    for hole in feeds.chunk_by(|a, b| a.segment.item == b.segment.item) {
        let moves = end..end + hole.len();
        end = moves.end;
        if !matches!(program.items.get(hole[0].segment.item as usize), Item::Cycle(..)) {
            continue;
        }
        let is_idle = |w: AirMove| w.air > DEEP + work.tool.cutter.tip_height() && w.air >= 0.99 * w.depth;
        if is_idle(ways.sums(moves.clone())) {
            ways.ask(&moves.clone().collect::<Vec<_>>());
            if is_idle(ways.sums(moves)) {
                return Some(hole[0].segment.item);
            }
        }
    }
    None
}
