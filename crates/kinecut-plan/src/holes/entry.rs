//! The entry of a roughing level: the one that is taken, and its check. None may leave a core standing: the cutter would
//! meet it with its face, or it would come loose.

use std::f64::consts::TAU;

use super::spec::{BoreSpec, CutterData, Entry, Rough};
use crate::base::{Code, Finding, Result};

/// Ramp that nearly every end mill follows [rad]: 2 degrees.
pub const USUAL_RAMP: f64 = 0.035;
/// Radius of the usual entry helix in cutter radii: below 1 no core is left, and the load of the helix is even.
const USUAL_SHARE: f64 = 0.6;
/// Share of the allowed ramp that is used: the planner may move the radius of a helix a little.
const RESERVE: f64 = 0.9;

/// The entry that the plan takes: the given one, or the best possible.
pub fn chosen(spec: &BoreSpec, rough: &Rough) -> Entry {
    match (spec.entry, rough.start) {
        (Some(given), _) => given,
        (None, Some(_)) => Entry::Plunge,
        (None, None) => usual_helix(spec, rough),
    }
}

/// The usual helix into a bore.
pub fn usual_helix(spec: &BoreSpec, rough: &Rough) -> Entry {
    let radius = usual_radius(spec, rough);
    Entry::Helix { radius, pitch: TAU * radius * usual_ramp(&spec.cutter).tan() }
}

/// Largest descent of a turn of a helix at the wall [mm]: as given, or as steep as the cutter is known to follow.
pub(super) fn pitch(spec: &BoreSpec, rough: &Rough) -> f64 {
    rough.pitch.unwrap_or_else(|| {
        let radius = spec.rough_radius(rough, spec.floor()).unwrap_or(spec.cutter_radius());
        TAU * radius * usual_ramp(&spec.cutter).tan()
    })
}

/// Radius of the usual entry helix [mm].
pub(super) fn usual_radius(spec: &BoreSpec, rough: &Rough) -> f64 {
    let radius = USUAL_SHARE * spec.cutter_radius();
    // A bore without room is refused elsewhere; here the helix only stays a helix.
    let room = spec.rough_radius(rough, spec.floor()).map_or(radius, |r| 0.5 * r);
    if room < radius { room } else { radius }
}

fn usual_ramp(cutter: &CutterData) -> f64 {
    RESERVE * cutter.max_ramp_angle.unwrap_or(USUAL_RAMP).clamp(0.0, USUAL_RAMP)
}

/// Checks the way down by itself: whether the cutter may go it, and whether it fits the start.
///
/// # Errors
/// `KC0403` with the bound that is broken and the help.
pub fn check(spec: &BoreSpec, rough: &Rough) -> Result<()> {
    let a = spec.cutter_radius();
    match (chosen(spec, rough), rough.start) {
        (Entry::PreDrilled { .. }, Some(_)) => {
            Err(impossible("a pre-drilled hole as the start and as the entry belong together")
                .help("give both, with the diameter of the hole, or neither")
                .key("entry")
                .into())
        }
        (Entry::PreDrilled { diameter }, None) => {
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
        (Entry::Plunge, _) if !spec.cutter.centre_cutting => {
            Err(impossible("a cutter that does not cut at its centre cannot plunge")
                .help("enter by a helix, drill first, or use a centre-cutting cutter")
                .key("entry")
                .into())
        }
        (Entry::Plunge, _) => Ok(()),
        (Entry::Helix { .. }, Some(_)) => {
            Err(impossible("a helix is about the bore's centre and cannot begin in another point")
                .help("start in the centre, or plunge")
                .key("entry")
                .into())
        }
        (Entry::Helix { radius, pitch }, None) => {
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

pub(super) fn impossible(message: &str) -> Finding {
    Finding::error(Code::ENTRY_IMPOSSIBLE, message)
}
