//! How the cutter enters: which ways down are possible, and the spiral that follows from each.
//!
//! Order of preference: a hole drilled before, a helix below the cutter's radius, a plunge. None may leave a core
//! standing: the cutter would meet it with its face, or it would come loose.

use std::f64::consts::TAU;

use super::rounded::{RoughSpiral, Rounding, lead, spiral_from_centre, spiral_from_circle};
use super::spec::{BoreSpec, Entry, Rough, RoughStart};
use super::spiral::turns;
use crate::base::{Code, Finding, Result};

/// Checks the way down by itself: whether the cutter may go it, and whether it fits the start.
///
/// # Errors
/// `KC0403` with the bound that is broken and the cure.
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
                .cure("drill larger, use a smaller cutter, or enter by a helix from the centre")
                .key("start")
                .into())
        }
        (Entry::PreDrilled, _) | (_, RoughStart::PreDrilled { .. }) => {
            Err(impossible("a pre-drilled hole as the start and as the entry belong together")
                .cure("give both, with the diameter of the hole, or neither")
                .key("entry")
                .into())
        }
        (Entry::Plunge, _) if !spec.cutter.centre_cutting => {
            Err(impossible("a cutter that does not cut at its centre cannot plunge")
                .cure("enter by a helix, drill first, or use a centre-cutting cutter")
                .key("entry")
                .into())
        }
        (Entry::Plunge, _) => Ok(()),
        (Entry::Helix { .. }, RoughStart::Point(_)) => {
            Err(impossible("a helix is about the bore's centre and cannot begin in another point")
                .cure("start in the centre, or plunge")
                .key("entry")
                .into())
        }
        (Entry::Helix { radius, pitch }, RoughStart::Centre) => {
            let bound = a.min(spec.rough_radius(rough)?);
            if !(radius > 0.0 && radius < bound) {
                return Err(impossible(
                    "the entry helix leaves a core: its radius must lie below the cutter's and the path's",
                )
                .value_mm(radius)
                .bound_mm(bound)
                .key("entry.radius")
                .cure("use a smaller helix radius")
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
                .cure(format!(
                    "use a pitch of at most {:.3} mm, or a larger radius",
                    TAU * radius * most.tan()
                ))
                .key("entry.pitch")
                .into())
        }
        _ => Ok(()),
    }
}

/// How a level of roughing begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// The point in which the cutter comes down, for a counter-clockwise path [mm].
    pub point: [f64; 2],
    /// The spiral from there to the wall.
    pub spiral: RoughSpiral,
    /// Turns of the start's involute before the start [rad]: the paper's phi0; zero from the centre.
    pub roll: f64,
    /// Tangent angle at the wall [rad].
    pub psi: f64,
    /// Turns of the path.
    pub visible_turns: f64,
}

/// The spiral of a roughing level, counter-clockwise about the origin.
///
/// # Errors
/// `KC0402` for a start outside, `KC0403` when a core would be left, `KC0404` when nothing is left to rough.
pub fn opening(spec: &BoreSpec, rough: &Rough) -> Result<Opening> {
    let (a, radius, u) = (spec.cutter_radius(), spec.rough_radius(rough)?, spec.resolution);
    let of_spiral = |spiral: RoughSpiral, point: [f64; 2]| {
        let visible_turns = f64::from(spiral.turns);
        Opening { point, spiral, roll: 0.0, psi: 0.0, visible_turns }
    };
    match (spec.entry, spec.start) {
        (Entry::Helix { radius: helix, .. }, _) => {
            // Up to the cutter's radius the helix leaves no core.
            let spiral = spiral_from_circle(helix, a, radius, rough.step, 0.0, u)?;
            let start = spiral.records[0].start().to_array();
            Ok(of_spiral(spiral, start))
        }
        (_, RoughStart::Centre) => Ok(of_spiral(spiral_from_centre(radius, rough.step, 0.0, u)?, [0.0, 0.0])),
        (_, RoughStart::Point(point)) => from_point(spec, rough, radius, point),
        (_, RoughStart::PreDrilled { diameter }) => {
            let inner = 0.5 * diameter - a;
            if inner >= radius {
                return Err(Finding::error(Code::PLAN_VALUE, "the pre-drilled hole leaves nothing to rough")
                    .value_mm(diameter)
                    .bound_mm(2.0 * (radius + a))
                    .cure("leave out `rough`")
                    .key("start")
                    .into());
            }
            // In a hole hardly larger than the cutter the turn to its wall would be tiny: go as from the centre.
            if inner <= radius / f64::from(turns(radius, rough.step)?) {
                return Ok(of_spiral(spiral_from_centre(radius, rough.step, 0.0, u)?, [0.0, 0.0]));
            }
            // A first turn in the air up to the wall of the hole, then the steps.
            let mut spiral = spiral_from_circle(inner, inner, radius, rough.step, 0.0, u)?;
            let first = super::spiral::from_centre(spiral.inner_radius, 1, 0.0)?;
            spiral.records.insert(0, first);
            spiral.turns += 1;
            Ok(of_spiral(spiral, [0.0, 0.0]))
        }
    }
}

/// The spiral from a point off the centre: a lead-in that reaches the wall in steps of at most the limit.
fn from_point(spec: &BoreSpec, rough: &Rough, radius: f64, point: [f64; 2]) -> Result<Opening> {
    let n = turns(radius, rough.step)?;
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
        .cure("start nearer to the centre")
        .key("start")
        .into());
    }
    let step = TAU * lead.base_radius;
    let spiral = RoughSpiral {
        records: lead.records,
        inner_radius: 0.0,
        base_radius: lead.base_radius,
        turns: n,
        step,
    };
    Ok(Opening { point: start, spiral, roll: lead.roll, psi: lead.psi, visible_turns: lead.turns })
}

fn impossible(message: &str) -> Finding {
    Finding::error(Code::ENTRY_IMPOSSIBLE, message)
}
