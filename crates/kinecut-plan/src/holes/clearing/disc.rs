//! The disc inside a bore before and after it is cleared, and the arcs and lines that paths are made of.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::base::{Code, Error, Finding, Result};
use crate::geom::{InvoluteRecord, PlaneCurve, on_circle};

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

/// The error of a path of absurdly many pieces.
pub(super) fn too_many(count: f64, unit: &str) -> Error {
    Finding::error(Code::PLAN_VALUE, "the path would need an absurd number of pieces")
        .value(count, unit)
        .bound(MOST_PIECES, unit)
        .help("choose a larger step or engagement; check the units")
        .into()
}

/// A disc to be cleared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Radius of the circle from which the cutter's centre starts [mm]; zero: it starts in the centre.
    pub inner: f64,
    /// Up to where that circle may grow when a base radius is rounded [mm].
    pub inner_most: f64,
    /// Radius of the wall circle of the cutter's centre [mm].
    pub outer: f64,
    /// Radius of the cutter [mm].
    pub cutter: f64,
    /// Largest radial step [mm].
    pub step: f64,
    /// Largest engagement angle [rad], for the strategies that keep one.
    pub engagement: Option<f64>,
    /// Tangent angle at which the wall is met: the path ends in `(outer sin psi, -outer cos psi)`.
    pub psi: f64,
    /// Least step of the control [mm], for which the base radii of involutes are rounded.
    pub resolution: Option<f64>,
}

/// A cleared disc.
#[derive(Clone, Debug, PartialEq)]
pub struct Cleared {
    /// From the inner circle to the wall circle, each curve starting where the last one ended.
    pub curves: Vec<PlaneCurve>,
    /// Radius of the circle on which it really starts [mm]: a rounded base radius may move it a little.
    pub inner: f64,
    /// The full circle at the wall.
    pub closing: InvoluteRecord,
    /// Turns about the centre, the closing circle not counted.
    pub turns: f64,
    /// Largest normal step [mm].
    pub step: f64,
    /// Engagement kept [rad], for the strategies that keep one.
    pub engagement: Option<f64>,
}

impl Disc {
    /// The numbers that every strategy needs.
    pub(super) fn check(&self) -> Result<()> {
        let fail = |what: &str, value: f64, bound: f64, help: &str| {
            Err(Finding::error(Code::PLAN_VALUE, what).value_mm(value).bound_mm(bound).help(help).into())
        };
        if !(self.outer > 0.0 && self.outer.is_finite()) {
            return fail("the wall circle of a path needs a positive radius", self.outer, 0.0, "");
        }
        if !(self.inner >= 0.0 && self.inner < self.outer) {
            return fail(
                "the circle from which a path starts must be smaller than the one at the wall",
                self.inner,
                self.outer,
                "enter on a smaller circle, or run the wall circle only",
            );
        }
        if !(self.cutter > 0.0 && self.cutter.is_finite()) {
            return fail("a cutter needs a positive radius", self.cutter, 0.0, "");
        }
        if !(self.step > 0.0 && self.step <= 2.0 * self.cutter) {
            let help = "choose a positive step up to the cutter's diameter; a larger one leaves material between \
                        the turns";
            return fail("the radial step is not usable", self.step, 2.0 * self.cutter, help);
        }
        if !self.psi.is_finite() {
            return Err(Finding::error(Code::PLAN_VALUE, "the angle at which the wall is met is not finite")
                .value(self.psi, "")
                .into());
        }
        let turns = (self.outer - self.inner) / self.step;
        if turns > MOST_PIECES {
            return Err(too_many(turns, "turns"));
        }
        Ok(())
    }

    /// Cleared by a path from the inner circle to the wall in so many turns of largest normal step `step` [mm].
    pub(in crate::holes) fn cleared(
        &self,
        curves: Vec<PlaneCurve>,
        turns: f64,
        step: f64,
    ) -> Result<Cleared> {
        let closing = InvoluteRecord::circle(self.outer, self.psi)?;
        Ok(Cleared { curves, inner: self.inner, closing, turns, step, engagement: None })
    }
}

/// The arc about `centre` of a signed radius (negative: clockwise) that starts at the tangent angle `angle` and turns
/// by `turn` > 0 [rad].
pub(super) fn arc(centre: DVec2, radius: f64, angle: f64, turn: f64) -> Result<PlaneCurve> {
    let start = centre + on_circle(radius, angle);
    Ok(InvoluteRecord::new(radius.abs() * turn, start.to_array(), angle, radius, radius)?.into())
}

/// The straight line between two points.
pub(super) fn line(from: DVec2, to: DVec2) -> Result<PlaneCurve> {
    let way = to - from;
    let straight = f64::INFINITY;
    Ok(InvoluteRecord::new(way.length(), from.to_array(), way.to_angle(), straight, straight)?.into())
}

/// The way along the starting circle from the tangent angle `psi` on by `turn` taken to [0, 2 pi), if there is any:
/// in the air, so that every path starts at the same place.
pub(super) fn along_inner(disc: &Disc, turn: f64) -> Result<Option<PlaneCurve>> {
    let turn = turn.rem_euclid(TAU);
    if disc.inner > 0.0 && turn > 0.0 {
        arc(DVec2::ZERO, disc.inner, disc.psi, turn).map(Some)
    } else {
        Ok(None)
    }
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
