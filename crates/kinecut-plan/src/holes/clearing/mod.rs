//! Ways to clear the disc inside a bore in one plane, each a chain of exact curves from a small circle to the wall:
//! one strategy a file, all asked for in the same words and answered in the same form.
//!
//! Everything is counter-clockwise about the origin, in the plane of a level; the cutter's centre starts on the circle
//! of radius `inner` (zero: in the centre), where the whole disc that it can sweep from there is already cleared, and
//! ends on the wall circle of radius `outer`, which it then runs round once.

mod archimedes;
mod ellipse;
mod even;
mod poles;
mod rings;
mod spiral;
#[cfg(test)]
mod tests;
mod trochoid;
mod turns;

pub use ellipse::{ClearedEllipse, EllipsePocket, ellipse};
pub use even::rings_of_equal_engagement;

use std::f64::consts::TAU;

use glam::DVec2;

use super::spiral::wall_point;
use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, LensOrder, PlaneCurve};

/// Most turns, loops or arcs of a path: beyond it the program runs for days, and the cause is a number in the wrong
/// unit. Ten times as many take 125 kB each of a ramp, 2.8 GB in all, and minutes.
pub(super) const MOST_PIECES: f64 = 10_000.0;

/// How the disc is cleared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Clearing {
    /// Circle involute (Sorokin, But, Kombarov 2013): constant normal step, contact G2 with the wall.
    Involute,
    /// Lens involute: the same step and length, contact G4 or G6.
    Lens(LensOrder),
    /// Lens spiral of constant engagement, with the step as a cap.
    ConstantEngagement(LensOrder),
    /// Arcs about the vertices of a regular polygon: 2 (semicircles) or more poles, contact G1.
    Poles(u32),
    /// Archimedean spiral: meets the wall with a kink.
    Archimedes,
    /// Concentric rings joined by radial lines.
    RingsRadial,
    /// Concentric rings joined by tangent S links.
    RingsTangent,
    /// Trochoidal loops along the ring.
    Trochoid,
}

/// What is to be cleared.
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

impl Clearing {
    /// Name in job files.
    pub fn name(self) -> &'static str {
        match self {
            Clearing::Involute => "involute",
            Clearing::Lens(LensOrder::Zero) => "lens-0",
            Clearing::Lens(LensOrder::One) => "lens-1",
            Clearing::Lens(LensOrder::Two) => "lens-2",
            Clearing::ConstantEngagement(LensOrder::Zero) => "constant-engagement-g2",
            Clearing::ConstantEngagement(LensOrder::One) => "constant-engagement",
            Clearing::ConstantEngagement(LensOrder::Two) => "constant-engagement-g6",
            Clearing::Poles(2) => "arcs-2",
            Clearing::Poles(4) => "arcs-4",
            Clearing::Poles(_) => "arcs",
            Clearing::Archimedes => "archimedean",
            Clearing::RingsRadial => "rings",
            Clearing::RingsTangent => "rings-tangent",
            Clearing::Trochoid => "trochoidal",
        }
    }

    /// The path that clears a disc.
    ///
    /// # Errors
    /// `KC0404` for numbers that give no path (what, value, bound, help).
    pub fn path(self, disc: &Disc) -> Result<Cleared> {
        disc.check()?;
        match self {
            Clearing::Involute => spiral::involute(disc),
            Clearing::Lens(order) => spiral::lens(disc, order),
            Clearing::ConstantEngagement(order) => even::constant_engagement(disc, order),
            Clearing::Poles(poles) => poles::arcs(disc, poles),
            Clearing::Archimedes => archimedes::archimedes(disc),
            Clearing::RingsRadial => rings::radial(disc),
            Clearing::RingsTangent => rings::tangent(disc),
            Clearing::Trochoid => trochoid::loops(disc),
        }
    }
}

impl Disc {
    /// The numbers that every strategy needs.
    fn check(&self) -> Result<()> {
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
}

/// The error of a path of absurdly many pieces.
pub(super) fn too_many(count: f64, unit: &str) -> crate::base::Error {
    Finding::error(Code::PLAN_VALUE, "the path would need an absurd number of pieces")
        .value(count, unit)
        .bound(MOST_PIECES, unit)
        .help("choose a larger step or engagement; check the units")
        .into()
}

/// The arc about `centre` of a signed radius (negative: clockwise) that starts at the tangent angle `angle` and turns
/// by `turn` > 0 [rad].
fn arc(centre: DVec2, radius: f64, angle: f64, turn: f64) -> Result<PlaneCurve> {
    let start = centre + wall_point(radius, angle);
    Ok(InvoluteRecord::new(radius.abs() * turn, start.to_array(), angle, radius, radius)?.into())
}

/// The straight line between two points.
fn line(from: DVec2, to: DVec2) -> Result<PlaneCurve> {
    let way = to - from;
    let straight = f64::INFINITY;
    Ok(InvoluteRecord::new(way.length(), from.to_array(), way.to_angle(), straight, straight)?.into())
}

/// The way along the starting circle from the tangent angle `psi` on by `turn` taken to [0, 2 pi), if there is any:
/// in the air, so that every path starts at the same place.
fn along_inner(disc: &Disc, turn: f64) -> Result<Option<PlaneCurve>> {
    let turn = turn.rem_euclid(TAU);
    if disc.inner > 0.0 && turn > 0.0 {
        arc(DVec2::ZERO, disc.inner, disc.psi, turn).map(Some)
    } else {
        Ok(None)
    }
}
