//! The path of a roughing level from its entry to the wall.

use std::f64::consts::TAU;

use super::clearing::{Cleared, Clearing, Disc, turns};
use super::entry::impossible;
use super::lead::{Rounding, lead};
use super::spec::{BoreSpec, Entry, Rough};
use super::spiral::from_centre;
use crate::base::{Code, Finding, Result};
use crate::geom::PlaneCurve;

/// Start of a level of roughing, and the path from there to the wall.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Opening {
    /// The point in which the cutter comes down, for a counter-clockwise path [mm].
    pub(super) point: [f64; 2],
    /// The way from there to the wall.
    pub(super) curves: Vec<PlaneCurve>,
    /// Radius of the circle on which the clearing begins [mm]; zero: in the centre or a point.
    pub(super) inner_radius: f64,
    /// Base radius of the involute at the wall [mm]; zero for other strategies.
    pub(super) base_radius: f64,
    /// Turns that the path would have from the centre or the inner circle.
    pub(super) turns: f64,
    /// Largest normal step [mm].
    pub(super) step: f64,
    /// Engagement kept [rad], where one is.
    pub(super) engagement: Option<f64>,
    /// Turns of the start's involute before the start [rad]: the paper's phi0; zero from the centre.
    pub(super) roll: f64,
    /// Tangent angle at the wall [rad].
    pub(super) psi: f64,
    /// Turns of the path.
    pub(super) visible_turns: f64,
}

/// The way that clears a roughing level to the path radius `wall` [mm], counter-clockwise about the origin.
///
/// # Errors
/// `KC0402` for a start outside, `KC0403` when a core would be left, `KC0404` when nothing is left to rough, or what
/// the strategy refuses.
pub(super) fn opening(
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
    match (entry, rough.start) {
        // Up to the cutter's radius the helix leaves no core.
        (Entry::Helix { radius: helix, .. }, _) => Ok(Opening::of(clear(disc(helix, a))?)),
        (Entry::Plunge, None) => Ok(Opening::of(clear(disc(0.0, 0.0))?)),
        (_, Some(point)) if clearing == Clearing::Involute => {
            from_point(spec, rough, wall, spec.from_centre(point))
        }
        (_, Some(_)) => Err(Finding::error(
            Code::PLAN_VALUE,
            format!("the strategy `{}` cannot start in a point off the centre", clearing.name()),
        )
        .help("leave out `start`, or use `involute`")
        .key("start")
        .into()),
        (Entry::PreDrilled { diameter }, None) => {
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
            let first = from_centre(opening.inner_radius, 1, 0.0)?;
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
            base_radius,
            engagement: cleared.engagement,
            ..Opening::on_circle(cleared.curves, cleared.inner, cleared.turns, cleared.step, 0.0)
        }
    }
}

/// The spiral from a point off the centre: a lead-in that reaches the wall in steps of at most the limit.
fn from_point(spec: &BoreSpec, rough: &Rough, radius: f64, start: [f64; 2]) -> Result<Opening> {
    let n = turns(radius, rough.stepover)?;
    let lead = lead(radius, n, start, 0.0, spec.resolution, Rounding::Down).map_err(|e| e.under("start"))?;
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
        .key("start")
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
