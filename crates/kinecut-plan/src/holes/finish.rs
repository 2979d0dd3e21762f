//! Finishing of a bore's wall: a lead-in along a spiral, the circle at the wall, spring passes, a lead-out; once at
//! full depth when the flutes are long enough, otherwise level by level.

use std::f64::consts::TAU;

use glam::DVec2;

use super::figures::PassFigures;
use super::finish_lead::{way_in, way_out};
use super::lead::Lead;
use super::levels::{Level, no_depth};
use super::spec::{BoreSpec, FeedAt, Finish};
use super::toolpath::{Toolpath, ToolpathPace, ToolpathRole};
use super::wear;
use crate::base::{Code, Finding, Result};
use crate::num::angle::wrap_positive;

/// Overlaps of the finishing circle smaller than this are zero [rad]: rounding of two equal tangent angles.
const NO_OVERLAP: f64 = 1e-9;

pub(super) fn plan_finish(toolpath: &mut Toolpath, spec: &BoreSpec, finish: &Finish) -> Result<PassFigures> {
    let levels = spec.levels(finish.stepdown, 0.0)?;
    toolpath.finishing = true;
    let mut last: Option<(f64, f64, Ways)> = None;
    for level in &levels {
        toolpath.level = level.index;
        let radius = level.radius;
        let open = open_radius(spec, radius, level)?;
        let ways = match last.take() {
            Some((r, o, ways)) if (r, o) == (radius, open) => ways,
            _ => {
                let enter = way_in(spec, finish, radius, open)?;
                let leave = way_out(spec, finish, radius, open, &enter)?;
                let switches = finish
                    .wear
                    .map(|w| wear::switches(&enter.curves, &leave.curves, &w, open))
                    .transpose()?;
                Ways { enter, leave, switches }
            }
        };
        run(toolpath, spec, finish, level, radius, &ways)?;
        last = Some((radius, open, ways));
    }
    let Some((radius, _, ways)) = last else {
        return Err(no_depth());
    };
    PassFigures::of_lead(toolpath, ways.enter, finish.turns, radius, &levels)
}

/// The ways of a level.
struct Ways {
    enter: Lead,
    leave: Lead,
    /// Points at which the control's compensation is switched on and off.
    switches: Option<wear::Switches>,
}

/// One level.
fn run(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    finish: &Finish,
    level: &Level,
    radius: f64,
    ways: &Ways,
) -> Result<()> {
    let (way_in, way_out) = (&ways.enter, &ways.leave);
    let lead_start = way_in.curves[0].start();
    let start = ways.switches.map_or(lead_start, |s| s.start);
    descend(toolpath, spec, finish, level, start);
    let feed = centre_feed(spec, finish, radius);
    toolpath.comp = ways.switches.is_some();
    toolpath.to(ToolpathRole::LeadIn, ToolpathPace::Feed(feed), lead_start.extend(level.floor));
    for curve in &way_in.curves {
        toolpath.along(ToolpathRole::LeadIn, feed, curve);
    }
    for _ in 0..=finish.spring_passes {
        toolpath.circle(ToolpathRole::Finish, feed, radius, way_in.psi)?;
    }
    let overlap = wrap_positive(way_out.psi - way_in.psi);
    if overlap > NO_OVERLAP && overlap < TAU - NO_OVERLAP {
        toolpath.around(ToolpathRole::Finish, feed, radius, way_in.psi, overlap, 0.0)?;
    }
    for curve in &way_out.curves {
        toolpath.along(ToolpathRole::LeadOut, feed, curve);
    }
    toolpath.comp = false;
    if let Some(s) = ways.switches {
        toolpath.to(ToolpathRole::LeadOut, ToolpathPace::Feed(feed), s.end.extend(level.floor));
    }
    Ok(())
}

/// To a place on the floor of a level, from the safe plane or across what is open.
pub(super) fn descend(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    finish: &Finish,
    level: &Level,
    start: DVec2,
) {
    let clear = level.floor + spec.clearance();
    if toolpath.height() >= spec.retract_z {
        toolpath.to(ToolpathRole::Approach, ToolpathPace::Rapid, start.extend(spec.retract_z));
    } else {
        let across = clear.max(toolpath.height() + spec.clearance());
        toolpath.vertically(ToolpathRole::Link, ToolpathPace::Rapid, across);
        toolpath.to(ToolpathRole::Link, ToolpathPace::Rapid, start.extend(across));
    }
    toolpath.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, clear);
    let down = spec.rough.map_or(finish.feed, |r| r.plunge_feed());
    toolpath.vertically(ToolpathRole::Entry, ToolpathPace::Feed(down), level.floor);
}

/// Feed of the cutter's centre [mm/s]: at the wall the edge's envelope runs on a circle larger by the cutter's
/// radius.
fn centre_feed(spec: &BoreSpec, finish: &Finish, radius: f64) -> f64 {
    match finish.feed_at {
        FeedAt::Centre => finish.feed,
        FeedAt::Wall => finish.feed * radius / (radius + spec.cutter_radius()),
    }
}

/// Radius about the centre within which the cutter's centre is in the open before finishing a level [mm].
fn open_radius(spec: &BoreSpec, radius: f64, level: &Level) -> Result<f64> {
    match (&spec.rough, spec.drilled()) {
        (Some(rough), _) => {
            // The roughing level that holds this floor may end deeper, where a conical wall is narrower.
            /// Floors that agree but for rounding [mm].
            const SAME: f64 = 1e-9;
            let levels = spec.levels(rough.stepdown, rough.allowance)?;
            match levels.iter().find(|l| l.floor <= level.floor + SAME) {
                Some(same) => Ok(same.radius),
                None => spec.rough_radius(rough, level.floor),
            }
        }
        (None, Some(diameter)) => {
            let open = 0.5 * diameter - spec.cutter_radius();
            if open > 0.0 {
                return Ok(open.min(radius));
            }
            Err(Finding::error(
                Code::ENTRY_IMPOSSIBLE,
                "the cutter does not fit into the bore as it is before finishing",
            )
            .value_mm(spec.cutter.diameter)
            .bound_mm(diameter)
            .help("rough it first, or use a smaller cutter")
            .into())
        }
        (None, None) => Err(Finding::error(
            Code::ENTRY_IMPOSSIBLE,
            "finishing alone needs the diameter that the bore has before",
        )
        .help("add `rough`, or give the bore as a pre-drilled start")
        .into()),
    }
}
