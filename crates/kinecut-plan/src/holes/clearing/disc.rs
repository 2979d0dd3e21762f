//! The disc inside a bore before and after it is cleared, and the arcs and lines of which paths are made.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, PlaneCurve};
use crate::holes::circle::{MOST_PIECES, circle, too_many, wall_point};

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
    pub(super) fn cleared(&self, curves: Vec<PlaneCurve>, turns: f64, step: f64) -> Result<Cleared> {
        let closing = circle(self.outer, self.psi)?;
        Ok(Cleared { curves, inner: self.inner, closing, turns, step, engagement: None })
    }
}

/// The arc about `centre` of a signed radius (negative: clockwise) that starts at the tangent angle `angle` and turns
/// by `turn` > 0 [rad].
pub(super) fn arc(centre: DVec2, radius: f64, angle: f64, turn: f64) -> Result<PlaneCurve> {
    let start = centre + wall_point(radius, angle);
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
