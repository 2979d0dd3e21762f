//! Roughing of a bore level by level in planes: the way from the entry to the wall, the circle there, and back into the
//! open.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::clearing::{Clearing, Disc, turns};
use super::entry::impossible;
use super::figures::{Opening, PassFigures};
use super::helix::{self, Helix};
use super::lead::{Rounding, lead};
use super::levels::{Level, no_depth};
use super::spec::{BoreSpec, Entry, Rough};
use super::spiral::{HALF_TURN, base_radius, from_centre, leave};
use super::toolpath::{Toolpath, ToolpathPace, ToolpathRole};
use crate::base::{Code, Finding, Result};
use crate::geom::PlaneCurve;

/// Turns of the involute that leads from the roughed wall back into the open: half a turn of it ends a quarter of
/// the radius off the wall.
const WAY_BACK_TURNS: u32 = 2;

/// Roughs level by level, each cleared in its plane.
///
/// # Errors
/// `KC0402` for a start outside, `KC0403` when a core would be left, `KC0404` when nothing is left to rough, or what the
/// strategy refuses.
pub(super) fn by_clearing(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    (entry, clearing): (Entry, Clearing),
    levels: &[Level],
) -> Result<PassFigures> {
    let mut last: Option<(f64, Opening)> = None;
    for level in levels {
        toolpath.level = level.index;
        let radius = level.radius;
        let opening = match last.take() {
            Some((r, same)) if r == radius => same,
            _ => opening(spec, rough, entry, clearing, radius)?,
        };
        if let Entry::Helix { pitch, .. } = entry {
            // The helix has the radius that the rounded spiral starts from.
            helix::follows(&spec.cutter, opening.inner_radius, pitch)?;
        }
        let back = back(spec, radius, opening.psi)?;
        enter(toolpath, spec, rough, entry, &opening, level)?;
        for curve in &opening.curves {
            toolpath.along(ToolpathRole::Rough, rough.feed, curve);
        }
        toolpath.circle(ToolpathRole::Circle, rough.feed, radius, opening.psi)?;
        toolpath.along(ToolpathRole::LeadOut, rough.feed, &back);
        last = Some((radius, opening));
    }
    let Some((radius, opening)) = last else { return Err(no_depth()) };
    PassFigures::of(toolpath, opening, radius, levels)
}

/// The way that clears a level to the path radius `wall` [mm], counter-clockwise about the origin.
fn opening(spec: &BoreSpec, rough: &Rough, entry: Entry, clearing: Clearing, wall: f64) -> Result<Opening> {
    let a = spec.cutter_radius();
    let step = spec.stepover(rough).map_err(|e| e.under("rough"))?;
    let psi = spec.rough_psi(rough);
    let disc = |inner: f64, inner_most: f64| Disc {
        inner,
        inner_most,
        outer: wall,
        cutter: a,
        step,
        engagement: rough.engagement,
        psi,
        resolution: spec.resolution,
    };
    let clear = |disc: Disc| clearing.path(&disc).map_err(|e| e.under("rough"));
    match (entry, rough.start) {
        // Up to the cutter's radius the helix leaves no core.
        (Entry::Helix { radius: helix, .. }, _) => Ok(Opening::of(clear(disc(helix, a))?, psi)),
        (Entry::Plunge, None) => Ok(Opening::of(clear(disc(0.0, 0.0))?, psi)),
        (_, Some(point)) if clearing == Clearing::Involute => {
            from_point(spec, rough, step, wall, spec.about_centre(point))
        }
        (_, Some(_)) => Err(Finding::error(
            Code::PLAN_VALUE,
            format!("the strategy `{}` cannot start in a point off the centre", clearing.name()),
        )
        .help("leave out `rough.start`, or use the strategy `involute`")
        .key("rough.start")
        .into()),
        (Entry::PreDrilled { diameter }, None) => {
            let inner = 0.5 * diameter - a;
            if inner >= wall {
                return Err(Finding::error(Code::PLAN_VALUE, "the pre-drilled hole leaves nothing to rough")
                    .value_mm(diameter)
                    .bound_mm(2.0 * (wall + a))
                    .help("leave out `rough`")
                    .key("entry.diameter")
                    .into());
            }
            // In a hole hardly larger than the cutter the turn to its wall would be tiny: go as from the centre.
            let tiny = inner <= wall / f64::from(turns(wall, step)?);
            if tiny && !matches!(clearing, Clearing::ConstantEngagement(_)) {
                return Ok(Opening::of(clear(disc(0.0, 0.0))?, psi));
            }
            // A first turn in the air up to the wall of the hole, then the steps.
            let mut opening = Opening::of(clear(disc(inner, inner))?, psi);
            let first = from_centre(opening.inner_radius, 1, psi)?;
            opening.curves.insert(0, first.into());
            opening.point = [0.0, 0.0];
            opening.turns += 1.0;
            opening.visible_turns += 1.0;
            Ok(opening)
        }
    }
}

/// The spiral from a point off the centre: a lead-in that reaches the wall in steps of at most the limit.
fn from_point(spec: &BoreSpec, rough: &Rough, step: f64, radius: f64, start: [f64; 2]) -> Result<Opening> {
    let n = turns(radius, step)?;
    let polar = rough.touch_angle.map_or(0.0, |wanted| spec.tangent_angle(wanted) - FRAC_PI_2);
    let lead =
        lead(radius, n, start, polar, spec.resolution, Rounding::Down).map_err(|e| e.under("rough.start"))?;
    if let Some(wanted) = rough.touch_angle
        && start != [0.0, 0.0]
    {
        return Err(spec.no_free_direction(["touch_angle", "start"], wanted, lead.psi).under("rough").into());
    }
    // After its first turn the cutter must still sweep the centre.
    let mut turned = TAU;
    let mut reached = radius;
    for curve in &lead.curves {
        let PlaneCurve::Record(record) = curve else { continue };
        let whole = record.turn(record.length());
        if turned < whole {
            reached = record.at(record.length_at_turn(turned)).p.length();
            break;
        }
        turned -= whole;
    }
    if reached > spec.cutter_radius() {
        return Err(impossible(
            "a spiral from this start leaves a core: its first turn must stay within the cutter's radius",
        )
        .value_mm(reached)
        .bound_mm(spec.cutter_radius())
        .help("start nearer to the centre")
        .key("rough.start")
        .into());
    }
    Ok(Opening {
        point: start,
        base_radius: lead.base_radius,
        roll: lead.roll,
        visible_turns: lead.turns,
        ..Opening::on_circle(lead.curves, 0.0, f64::from(n), TAU * lead.base_radius, lead.psi)
    })
}

/// The way from the wall back into the open.
pub(super) fn back(spec: &BoreSpec, radius: f64, psi: f64) -> Result<PlaneCurve> {
    Ok(leave(radius, base_radius(radius, WAY_BACK_TURNS, spec.resolution), HALF_TURN, psi)?.into())
}

/// From wherever the cutter is to the floor of the level.
pub(super) fn enter(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    entry: Entry,
    opening: &Opening,
    level: &Level,
) -> Result<()> {
    let [x, y] = opening.point;
    let clear = level.above + spec.clearance();
    over(toolpath, spec, [x, y], clear);
    match entry {
        Entry::Plunge => {
            toolpath.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, clear);
            toolpath.vertically(ToolpathRole::Entry, ToolpathPace::Feed(rough.plunge_feed()), level.floor);
        }
        Entry::PreDrilled { .. } => {
            toolpath.vertically(
                ToolpathRole::Approach,
                ToolpathPace::Rapid,
                clear.min(level.floor + spec.clearance()),
            );
            toolpath.vertically(ToolpathRole::Entry, ToolpathPace::Feed(rough.plunge_feed()), level.floor);
        }
        Entry::Helix { pitch, .. } => {
            toolpath.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, clear);
            let (radius, psi) = (opening.inner_radius, opening.psi);
            let feeds = [rough.plunge_feed(), rough.feed];
            Helix { role: ToolpathRole::Entry, feeds, radius, psi, pitch }.run(toolpath, level.floor)?;
        }
    }
    Ok(())
}

/// Over a place in the plane: on the safe plane first, later at a height in what is cleared.
pub(super) fn over(toolpath: &mut Toolpath, spec: &BoreSpec, [x, y]: [f64; 2], clear: f64) {
    if toolpath.height().is_infinite() {
        toolpath.to(ToolpathRole::Approach, ToolpathPace::Rapid, DVec3::new(x, y, spec.retract_z));
    } else {
        // Up into what the level above has cleared, and across.
        toolpath.vertically(ToolpathRole::Link, ToolpathPace::Rapid, clear);
        toolpath.to(ToolpathRole::Link, ToolpathPace::Rapid, DVec3::new(x, y, clear));
    }
}
