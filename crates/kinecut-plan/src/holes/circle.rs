//! Circles about the bore's centre: the place at a tangent angle, the whole circle, and the whole turns between two of
//! them.
//!
//! Counter-clockwise about the origin. The circle of radius `R` has the tangent angle `psi` in `(R sin psi, -R cos psi)`,
//! polar angle `psi - pi/2`.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::base::{Code, Error, Finding, Result};
use crate::geom::InvoluteRecord;

/// Most turns, loops or arcs of a path: beyond it the program runs for days, and the cause is a number in the wrong
/// unit. Ten times as many take 125 kB each of a ramp, 2.8 GB in all, and minutes.
pub(super) const MOST_PIECES: f64 = 10_000.0;

/// Slack of the whole-turn count: a step that divides the radius exactly must not cost a turn for a rounding
/// error (relative; a hundred times the error of the division, far below any step a control can show).
const TURN_SLACK: f64 = 1e-12;

/// Whole turns with which a spiral crosses `width` [mm] in normal steps of at most `max_step` [mm], equation (15).
///
/// # Errors
/// `KC0404` when a value is not positive and finite, or there are more than ten thousand turns.
pub fn turns(width: f64, max_step: f64) -> Result<u32> {
    let count = (width / max_step - TURN_SLACK).ceil().clamp(1.0, f64::INFINITY);
    if !(width > 0.0 && max_step > 0.0 && max_step.is_finite() && count.is_finite()) {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "a spiral needs a positive width and a positive step that is not absurdly small",
        )
        .value_mm(max_step)
        .into());
    }
    if count > MOST_PIECES {
        return Err(too_many(count, "turns"));
    }
    // In range by the check above.
    Ok(count as u32)
}

/// The point of the circle of `radius` about the origin at which the counter-clockwise tangent angle is `psi`.
pub fn wall_point(radius: f64, psi: f64) -> DVec2 {
    let (sin, cos) = psi.sin_cos();
    DVec2::new(radius * sin, -radius * cos)
}

/// The full counter-clockwise circle about the origin that starts at tangent angle `psi` [rad].
///
/// # Errors
/// `KC0801` when the radius is not positive and finite.
pub fn circle(radius: f64, psi: f64) -> Result<InvoluteRecord> {
    InvoluteRecord::new(TAU * radius, wall_point(radius, psi).to_array(), psi, radius, radius)
}

/// The error of a path of absurdly many pieces.
pub(super) fn too_many(count: f64, unit: &str) -> Error {
    Finding::error(Code::PLAN_VALUE, "the path would need an absurd number of pieces")
        .value(count, unit)
        .bound(MOST_PIECES, unit)
        .help("choose a larger step or engagement; check the units")
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_without_turns_are_refused() {
        for (width, step) in [(10.0, 0.0), (10.0, f64::NAN), (15.0, 1e-300)] {
            assert_eq!(turns(width, step).unwrap_err().code(), Code::PLAN_VALUE);
        }
    }
}
