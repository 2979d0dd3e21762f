//! Roughing of a bore: level by level in planes, level by level along a ramping spiral, or along one helix at the
//! wall.

use std::f64::consts::TAU;

use glam::DVec3;

use super::clearing::{Clearing, turns};
use super::entry;
use super::figures::{PassFigures, Slug};
use super::helix::Helix;
use super::lead::{HALF_TURN, base_radius, leave};
use super::levels::Level;
use super::opening::{Opening, opening};
use super::spec::{BoreSpec, Entry, Rough, Strategy};
use super::toolpath::{Toolpath, ToolpathPace, ToolpathRole};
use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, LensOrder, PlaneCurve, Rise, RiseShape, Spiral, Support, on_circle};

/// Turns of the involute that leads from the roughed wall back into the open: half a turn of it ends a quarter of
/// the radius off the wall.
const WAY_BACK_TURNS: u32 = 2;

/// Plans the roughing, and says what core comes loose.
pub(super) fn plan_rough(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    slug: &mut Option<Slug>,
) -> Result<PassFigures> {
    let levels = spec.levels(rough.stepdown).map_err(|e| e.under("rough.stepdown"))?;
    match spec.strategy.clearing() {
        Some(clearing) => by_clearing(toolpath, spec, rough, clearing, &levels),
        None if spec.strategy == Strategy::Ramping => by_ramp(toolpath, spec, rough, &levels),
        None => by_helix(toolpath, spec, rough, slug),
    }
}

fn by_clearing(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    clearing: Clearing,
    levels: &[Level],
) -> Result<PassFigures> {
    entry::check(spec, rough)?;
    let entry = entry::chosen(spec, rough);
    let mut last: Option<(f64, Opening)> = None;
    for level in levels {
        toolpath.level = level.index;
        let radius = spec.rough_radius(rough, level.floor)?;
        let opening = match last.take() {
            Some((r, same)) if r == radius => same,
            _ => opening(spec, rough, entry, clearing, radius)?,
        };
        if let Entry::Helix { pitch, .. } = entry {
            // The helix has the radius that the rounded spiral starts from.
            entry::ramp(spec, opening.inner_radius, pitch)?;
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
    let Some((radius, opening)) = last else {
        return Err(Finding::error(Code::PLAN_VALUE, "a bore needs a depth").into());
    };
    PassFigures::of(toolpath, opening, radius, levels)
}

/// The way from the wall back into the open.
fn back(spec: &BoreSpec, radius: f64, psi: f64) -> Result<PlaneCurve> {
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
fn over(toolpath: &mut Toolpath, spec: &BoreSpec, [x, y]: [f64; 2], clear: f64) {
    if toolpath.height().is_infinite() {
        toolpath.to(ToolpathRole::Approach, ToolpathPace::Rapid, DVec3::new(x, y, spec.retract_z));
    } else {
        // Up into what the level above has cleared, and across.
        toolpath.vertically(ToolpathRole::Link, ToolpathPace::Rapid, clear);
        toolpath.to(ToolpathRole::Link, ToolpathPace::Rapid, DVec3::new(x, y, clear));
    }
}

/// Down along an annular spiral to the wall, round, and back in the plane of the floor; the next level goes on from
/// there.
fn by_ramp(toolpath: &mut Toolpath, spec: &BoreSpec, rough: &Rough, levels: &[Level]) -> Result<PassFigures> {
    let wall = spec.rough_radius(rough, spec.floor())?;
    let entry = entry::chosen(spec, rough);
    if rough.start.is_some() {
        return Err(Finding::error(Code::PLAN_VALUE, "a ramping spiral is about the bore's centre")
            .help("leave out `start`")
            .key("rough.start")
            .into());
    }
    let (inner, most) = match entry {
        Entry::PreDrilled { diameter } => {
            entry::check(spec, rough)?;
            (0.5 * diameter - spec.cutter_radius(), wall)
        }
        Entry::Helix { radius, .. } => (radius, spec.cutter_radius().min(wall)),
        Entry::Plunge => (entry::usual_radius(spec, rough), spec.cutter_radius().min(wall)),
    };
    if !(inner > 0.0 && inner < most) {
        return Err(Finding::error(
            Code::ENTRY_IMPOSSIBLE,
            "a ramping spiral leaves a core: its inner radius must lie below the cutter's and the path's",
        )
        .value_mm(inner)
        .bound_mm(most)
        .help("use a smaller helix radius as the entry")
        .key("entry.radius")
        .into());
    }
    let turns = turns(wall - inner, rough.stepover).map_err(|e| e.under("rough.stepover"))?;
    let base = (wall - inner) / (TAU * f64::from(turns));
    let law = Support::Lens { inner, base_radius: base, order: LensOrder::One };
    let out: PlaneCurve = Spiral::new(law.into(), 0.0, TAU * f64::from(turns))?.into();
    // Mirrored in the line through the centre and the place on the wall, and run backwards: in, and climb again.
    let home = out.mirrored().reversed();
    let start = on_circle(inner, 0.0);
    check_slope(spec, &out, levels, spec.clearance())?;
    for level in levels {
        toolpath.level = level.index;
        if level.index == 0 {
            over(toolpath, spec, start.to_array(), level.above);
            let z = level.above + spec.clearance();
            toolpath.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, z);
        }
        let fall = level.floor - toolpath.height();
        toolpath.along_rising(ToolpathRole::Rough, rough.feed, &out, Rise::new(RiseShape::Smooth, fall));
        toolpath.settle(wall, 0.0, level.floor);
        toolpath.circle(ToolpathRole::Circle, rough.feed, wall, 0.0)?;
        toolpath.along(ToolpathRole::Rough, rough.feed, &home);
        toolpath.settle(inner, 0.0, level.floor);
        toolpath.circle(ToolpathRole::Circle, rough.feed, inner, 0.0)?;
    }
    let opening = Opening::on_circle(vec![out], inner, f64::from(turns), TAU * base, 0.0);
    PassFigures::of(toolpath, opening, wall, levels)
}

fn check_slope(spec: &BoreSpec, out: &PlaneCurve, levels: &[Level], clearance: f64) -> Result<()> {
    let most = spec.cutter.max_ramp_angle.unwrap_or(entry::USUAL_RAMP);
    let Some(first) = levels.first() else { return Ok(()) };
    let fall = first.above + clearance - first.floor;
    let slope = (RiseShape::Smooth.steepest() * fall / out.length()).atan();
    if slope <= most {
        return Ok(());
    }
    let allowed = most.tan() * out.length() / RiseShape::Smooth.steepest() - clearance;
    let help = if allowed > 0.0 {
        format!("use an axial step of at most {allowed:.3} mm, or smaller radial steps")
    } else {
        "use smaller radial steps, or another strategy".to_owned()
    };
    Err(Finding::error(Code::ENTRY_IMPOSSIBLE, "the ramping spiral is steeper than the cutter can follow")
        .value(slope.to_degrees(), "deg")
        .bound(most.to_degrees(), "deg")
        .help(help)
        .key("rough.stepdown")
        .into())
}

/// One helix at the wall, from above the top face to the floor.
fn by_helix(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    slug: &mut Option<Slug>,
) -> Result<PassFigures> {
    let radius = spec.rough_radius(rough, spec.floor())?;
    let core = 2.0 * (radius - spec.cutter_radius());
    // At equality the cutter's rim just meets the axis: a point stays.
    let leaves = core >= spec.drilled().unwrap_or(0.0);
    if leaves && spec.strategy == Strategy::Helix {
        return Err(Finding::error(
            Code::ENTRY_IMPOSSIBLE,
            format!("a helix at the wall leaves a core of diameter {core:.3} mm"),
        )
        .value_mm(spec.cutter.diameter)
        .bound_mm(spec.wall_radius(spec.floor()) - rough.allowance)
        .help(
            "use a cutter larger than half the bore, drill first, or clear it by another strategy (through bores: \
             `outline-helix`)",
        )
        .key("strategy")
        .into());
    }
    let pitch = entry::pitch(spec, rough);
    entry::ramp(spec, radius, pitch).map_err(|e| e.under("rough"))?;
    let start = on_circle(radius, 0.0).to_array();
    over(toolpath, spec, start, spec.top);
    toolpath.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, spec.top + spec.clearance());
    let feeds = [rough.feed, rough.feed];
    Helix { role: ToolpathRole::Rough, feeds, radius, psi: 0.0, pitch }.run(toolpath, spec.floor())?;
    if leaves {
        // Up in the slot: the core still stands inside.
        toolpath.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, spec.retract_z);
        *slug = Some(Slug { diameter: core, before: toolpath.moves.len() });
    } else {
        toolpath.along(ToolpathRole::LeadOut, rough.feed, &back(spec, radius, 0.0)?);
    }
    let opening =
        Opening::on_circle(vec![InvoluteRecord::circle(radius, 0.0)?.into()], radius, 1.0, 0.0, 0.0);
    let whole = Level { index: 0, above: spec.top, floor: spec.floor() };
    PassFigures::of(toolpath, opening, radius, &[whole])
}
