//! How the cutter enters: which ways down are possible, and the spiral that follows from each.
//!
//! Order of preference: a hole drilled before, a helix below the cutter's radius, a plunge. None may leave a core
//! standing: the cutter would meet it with its face, or it would come loose.

use std::f64::consts::TAU;

use super::clearing::{Cleared, Clearing, Disc};
use super::rounded::{Rounding, lead};
use super::spec::{BoreSpec, Entry, Rough, RoughStart};
use super::spiral::turns;
use crate::base::{Code, Finding, Result};
use crate::geom::PlaneCurve;

/// Checks the way down by itself: whether the cutter may go it, and whether it fits the start.
///
/// # Errors
/// `KC0403` with the bound that is broken and the help.
pub fn check(spec: &BoreSpec, rough: &Rough) -> Result<()> {
    let a = spec.cutter_radius();
    match (spec.entry, spec.start) {
        (Entry::PreDrilled, RoughStart::PreDrilled { diameter }) => {
            if diameter > spec.cutter.diameter && diameter.is_finite() {
                return Ok(());
            }
            Err(impossible("the cutter does not fit into the pre-drilled hole")
                .value_mm(diameter)
                .bound_mm(spec.cutter.diameter)
                .help("drill larger, use a smaller cutter, or enter by a helix from the centre")
                .key("start")
                .into())
        }
        (Entry::PreDrilled, _) | (Entry::Plunge | Entry::Helix { .. }, RoughStart::PreDrilled { .. }) => {
            Err(impossible("a pre-drilled hole as the start and as the entry belong together")
                .help("give both, with the diameter of the hole, or neither")
                .key("entry")
                .into())
        }
        (Entry::Automatic, _) => {
            let entry = super::entry_table::chosen(spec, rough);
            check(&BoreSpec { entry, ..*spec }, rough)
        }
        (Entry::Plunge, _) if !spec.cutter.centre_cutting => {
            Err(impossible("a cutter that does not cut at its centre cannot plunge")
                .help("enter by a helix, drill first, or use a centre-cutting cutter")
                .key("entry")
                .into())
        }
        (Entry::Plunge, _) => Ok(()),
        (Entry::Helix { .. }, RoughStart::Point(_)) => {
            Err(impossible("a helix is about the bore's centre and cannot begin in another point")
                .help("start in the centre, or plunge")
                .key("entry")
                .into())
        }
        (Entry::Helix { radius, pitch }, RoughStart::Centre) => {
            let bound = a.min(spec.rough_radius(rough, spec.floor())?);
            if !(radius > 0.0 && radius < bound) {
                return Err(impossible(
                    "the entry helix leaves a core: its radius must lie below the cutter's and the path's",
                )
                .value_mm(radius)
                .bound_mm(bound)
                .key("entry.radius")
                .help("use a smaller helix radius")
                .into());
            }
            ramp(spec, radius, pitch)
        }
    }
}

/// Whether the cutter follows a helix of this radius and pitch [mm].
///
/// # Errors
/// `KC0403` with the slope and the bound.
pub fn ramp(spec: &BoreSpec, radius: f64, pitch: f64) -> Result<()> {
    if !(pitch > 0.0 && pitch.is_finite()) {
        return Err(impossible("the pitch of the entry helix must be positive")
            .value_mm(pitch)
            .bound_mm(0.0)
            .key("entry.pitch")
            .into());
    }
    let slope = (pitch / (TAU * radius)).atan();
    match spec.cutter.max_ramp_angle {
        Some(most) if slope > most => {
            Err(impossible("the entry helix is steeper than the cutter can follow")
                .value(slope.to_degrees(), "deg")
                .bound(most.to_degrees(), "deg")
                .help(format!(
                    "use a pitch of at most {:.3} mm, or a larger radius",
                    TAU * radius * most.tan()
                ))
                .key("entry.pitch")
                .into())
        }
        _ => Ok(()),
    }
}

/// How a level of roughing begins, and the path from there to the wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// The point in which the cutter comes down, for a counter-clockwise path [mm].
    pub point: [f64; 2],
    /// The way from there to the wall.
    pub curves: Vec<PlaneCurve>,
    /// Radius of the circle on which the clearing begins [mm]; zero: in the centre or a point.
    pub inner_radius: f64,
    /// Base radius of the involute at the wall [mm]; zero for other strategies.
    pub base_radius: f64,
    /// Turns that the path would have from the centre or the inner circle.
    pub turns: f64,
    /// Largest normal step [mm].
    pub step: f64,
    /// Engagement kept [rad], where one is.
    pub engagement: Option<f64>,
    /// Turns of the start's involute before the start [rad]: the paper's phi0; zero from the centre.
    pub roll: f64,
    /// Tangent angle at the wall [rad].
    pub psi: f64,
    /// Turns of the path.
    pub visible_turns: f64,
}

/// The way that clears a roughing level to the path radius `wall` [mm], counter-clockwise about the origin.
///
/// # Errors
/// `KC0402` for a start outside, `KC0403` when a core would be left, `KC0404` when nothing is left to rough, or what
/// the strategy refuses.
pub fn opening(
    spec: &BoreSpec,
    rough: &Rough,
    entry: Entry,
    clearing: Clearing,
    wall: f64,
) -> Result<Opening> {
    let a = spec.cutter_radius();
    let disc = |inner: f64, inner_most: f64| Disc {
        inner,
        inner_most,
        outer: wall,
        cutter: a,
        step: rough.stepover,
        engagement: rough.engagement,
        psi: 0.0,
        resolution: spec.resolution,
    };
    let clear = |disc: Disc| clearing.path(&disc).map_err(|e| e.under("rough"));
    match (entry, spec.start) {
        // Up to the cutter's radius the helix leaves no core.
        (Entry::Helix { radius: helix, .. }, _) => Ok(Opening::of(clear(disc(helix, a))?)),
        (_, RoughStart::Centre) => Ok(Opening::of(clear(disc(0.0, 0.0))?)),
        (_, RoughStart::Point(point)) if clearing == Clearing::Involute => {
            from_point(spec, rough, wall, point)
        }
        (_, RoughStart::Point(_)) => Err(Finding::error(
            Code::PLAN_VALUE,
            format!("the strategy `{}` cannot start in a point off the centre", clearing.name()),
        )
        .help("leave out `start`, or use `involute`")
        .key("start")
        .into()),
        (_, RoughStart::PreDrilled { diameter }) => {
            let inner = 0.5 * diameter - a;
            if inner >= wall {
                return Err(Finding::error(Code::PLAN_VALUE, "the pre-drilled hole leaves nothing to rough")
                    .value_mm(diameter)
                    .bound_mm(2.0 * (wall + a))
                    .help("leave out `rough`")
                    .key("start")
                    .into());
            }
            // In a hole hardly larger than the cutter the turn to its wall would be tiny: go as from the centre.
            let tiny = inner <= wall / f64::from(turns(wall, rough.stepover)?);
            if tiny && !matches!(clearing, Clearing::ConstantEngagement(_)) {
                return Ok(Opening::of(clear(disc(0.0, 0.0))?));
            }
            // A first turn in the air up to the wall of the hole, then the steps.
            let mut opening = Opening::of(clear(disc(inner, inner))?);
            let first = super::spiral::from_centre(opening.inner_radius, 1, 0.0)?;
            opening.curves.insert(0, first.into());
            opening.point = [0.0, 0.0];
            opening.turns += 1.0;
            opening.visible_turns += 1.0;
            Ok(opening)
        }
    }
}

impl Opening {
    /// A way that begins on a circle about the centre, at tangent angle `psi`.
    pub(super) fn on_circle(curves: Vec<PlaneCurve>, inner: f64, turns: f64, step: f64, psi: f64) -> Opening {
        Opening {
            point: curves.first().map_or([0.0, 0.0], |c| c.start().to_array()),
            inner_radius: inner,
            base_radius: 0.0,
            turns,
            step,
            engagement: None,
            roll: 0.0,
            psi,
            visible_turns: turns,
            curves,
        }
    }

    fn of(cleared: Cleared) -> Opening {
        let base_radius = match cleared.curves.last() {
            Some(PlaneCurve::Record(record)) => record.base_radius(),
            _ => 0.0,
        };
        Opening {
            point: cleared.curves.first().map_or([0.0, 0.0], |c| c.start().to_array()),
            inner_radius: cleared.inner,
            base_radius,
            turns: cleared.turns,
            step: cleared.step,
            engagement: cleared.engagement,
            roll: 0.0,
            psi: 0.0,
            visible_turns: cleared.turns,
            curves: cleared.curves,
        }
    }
}

/// The spiral from a point off the centre: a lead-in that reaches the wall in steps of at most the limit.
fn from_point(spec: &BoreSpec, rough: &Rough, radius: f64, point: [f64; 2]) -> Result<Opening> {
    let n = turns(radius, rough.stepover)?;
    let start = if spec.sense == super::spec::Sense::Climb { point } else { [-point[0], point[1]] };
    let lead = lead(radius, n, start, 0.0, spec.resolution, Rounding::Down).map_err(|e| e.under("start"))?;
    // After its first turn the cutter must still sweep the centre.
    let mut turned = TAU;
    let mut reached = radius;
    for record in &lead.records {
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
        .key("start")
        .into());
    }
    Ok(Opening {
        point: start,
        curves: lead.records.into_iter().map(PlaneCurve::from).collect(),
        inner_radius: 0.0,
        base_radius: lead.base_radius,
        turns: f64::from(n),
        step: TAU * lead.base_radius,
        engagement: None,
        roll: lead.roll,
        psi: lead.psi,
        visible_turns: lead.turns,
    })
}

fn impossible(message: &str) -> Finding {
    Finding::error(Code::ENTRY_IMPOSSIBLE, message)
}
