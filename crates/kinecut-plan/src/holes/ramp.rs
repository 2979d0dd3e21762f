//! Roughing of a bore by a path that comes down: a ramping spiral level by level, or one helix at the wall.

use std::f64::consts::TAU;

use super::clearing::turns;
use super::entry;
use super::figures::{Opening, PassFigures, Slug};
use super::helix::{self, Helix};
use super::levels::Level;
use super::rough::{back, over};
use super::spec::{BoreSpec, Entry, Rough};
use super::strategy::Strategy;
use super::toolpath::{Toolpath, ToolpathPace, ToolpathRole};
use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, LensOrder, PlaneCurve, Rise, RiseShape, Spiral, Support, on_circle};

/// Down along an annular spiral to the wall, round, and back in the plane of the floor; the next level goes on from
/// there.
pub(super) fn by_ramp(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    (entry, wall): (Entry, f64),
    levels: &[Level],
) -> Result<PassFigures> {
    if rough.start.is_some() {
        return Err(Finding::error(Code::PLAN_VALUE, "a ramping spiral is about the bore's centre")
            .help("leave out `start`")
            .key("rough.start")
            .into());
    }
    let (inner, most) = match entry {
        Entry::PreDrilled { diameter } => {
            entry::check(spec, rough, entry, wall)?;
            (0.5 * diameter - spec.cutter_radius(), wall)
        }
        Entry::Helix { radius, .. } => (radius, spec.cutter_radius().min(wall)),
        Entry::Plunge => (entry::usual_radius(spec, wall), spec.cutter_radius().min(wall)),
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
    let step = spec.stepover(rough).map_err(|e| e.under("rough"))?;
    let turns = turns(wall - inner, step).map_err(|e| e.under("rough.stepover"))?;
    let psi = spec.rough_psi(rough);
    let base = (wall - inner) / (TAU * f64::from(turns));
    let law = Support::Lens { inner, base_radius: base, order: LensOrder::One };
    let out: PlaneCurve = Spiral::new(law.into(), 0.0, TAU * f64::from(turns))?.into();
    // Mirrored in the line through the centre and the place on the wall, and run backwards: in, and climb again.
    let home = out.mirrored().reversed();
    let (out, home) = (out.rotated(psi), home.rotated(psi));
    let start = on_circle(inner, psi);
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
        toolpath.settle(wall, psi, level.floor);
        toolpath.circle(ToolpathRole::Circle, rough.feed, wall, psi)?;
        toolpath.along(ToolpathRole::Rough, rough.feed, &home);
        toolpath.settle(inner, psi, level.floor);
        toolpath.circle(ToolpathRole::Circle, rough.feed, inner, psi)?;
    }
    let opening = Opening::on_circle(vec![out], inner, f64::from(turns), TAU * base, psi);
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
pub(super) fn by_helix(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    radius: f64,
    slug: &mut Option<Slug>,
) -> Result<PassFigures> {
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
    let pitch = rough.pitch.unwrap_or_else(|| entry::usual_pitch(spec, radius));
    helix::follows(&spec.cutter, radius, pitch).map_err(|e| e.under("rough"))?;
    let psi = spec.rough_psi(rough);
    let start = on_circle(radius, psi).to_array();
    over(toolpath, spec, start, spec.top);
    toolpath.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, spec.top + spec.clearance());
    let feeds = [rough.feed, rough.feed];
    Helix { role: ToolpathRole::Rough, feeds, radius, psi, pitch }.run(toolpath, spec.floor())?;
    if leaves {
        // Up in the slot: the core still stands inside.
        toolpath.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, spec.retract_z);
        *slug = Some(Slug { diameter: core, before: toolpath.moves.len() });
    } else {
        toolpath.along(ToolpathRole::LeadOut, rough.feed, &back(spec, radius, psi)?);
    }
    let opening =
        Opening::on_circle(vec![InvoluteRecord::circle(radius, psi)?.into()], radius, 1.0, 0.0, psi);
    let whole = Level { index: 0, above: spec.top, floor: spec.floor(), radius };
    PassFigures::of(toolpath, opening, radius, &[whole])
}
