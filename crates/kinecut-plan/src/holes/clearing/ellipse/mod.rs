//! An elliptic pocket cleared by a morphing spiral: from a circle (or the centre) to the inner parallel of the ellipse,
//! each turn a step nearer to it, with contact G2, G4 or G6 at the wall.
//!
//! The support function is `q = i + W(th)/(2 pi N) (Q(th) - i)`, `Q = sqrt(a^2 sin^2 th + b^2 cos^2 th) - d` the support
//! of the parallel at the distance `d` (cutter radius and allowance), `i` the radius of the circle. Neighbouring turns
//! have supports that differ by `(Q - i)/N`, and lie at most that far apart.
//!
//! Everything is about the origin, long axis along X or Y as given, counter-clockwise; the wall is met, and left, at an
//! end of the short axis, where it is flattest. A turned ellipse is the caller's rotation.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use super::disc::{MOST_PIECES, arc, too_many, turns};
use super::turns::Turns;
use crate::base::{Code, Error, Finding, Result};
use crate::geom::{InvoluteRecord, LensOrder, PlaneCurve, Spiral, Support};

/// An elliptic pocket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipsePocket {
    /// Half axes of the wall along X and Y [mm].
    pub half_axes: [f64; 2],
    /// Radius of the cutter [mm].
    pub cutter: f64,
    /// Stock to leave on the wall [mm].
    pub allowance: f64,
    /// Radius of the circle on which the cutter's centre has run before, once round [mm]; zero: it plunged in the centre.
    pub inner: f64,
    /// Largest normal step [mm].
    pub step: f64,
    /// Order of the weight: contact with the wall.
    pub order: LensOrder,
}

/// A cleared elliptic pocket.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearedEllipse {
    /// From the inner circle (in `(0, -inner)`, long axis along X; in `(inner, 0)`, along Y), or from the centre, to the
    /// wall, each curve starting where the last one ended.
    pub curves: Vec<PlaneCurve>,
    /// The full lap along the wall.
    pub closing: PlaneCurve,
    /// Half axes of an ellipse at the distance of the path: where the closing lap crosses X and Y [mm].
    pub reach: [f64; 2],
    /// Turns about the centre, the closing lap not counted.
    pub turns: f64,
    /// Largest distance of neighbouring turns, measured [mm].
    pub step: f64,
    /// Largest engagement from the second turn on, exactly for the curves, looked at in 24 places a turn [rad].
    pub engagement: f64,
    /// Smallest radius of curvature of spiral and closing lap [mm].
    pub least_radius: f64,
}

/// Places in a turn at which step and engagement are looked at.
const LOOKS: u32 = 24;
/// Places in a turn at which the radius of curvature is looked at: the weights have harmonics up to the fourth.
const PLACES: u32 = 96;
/// Most whole turns more than the step asks for, as a multiple, that are tried so that the spiral does not turn back.
const MOST_TIMES: u32 = 4;

/// The path that clears an elliptic pocket.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::geom::LensOrder;
/// use kinecut::holes::clearing::{EllipsePocket, ellipse};
/// let pocket = EllipsePocket {
///     half_axes: [68.0, 48.0], cutter: 8.0, allowance: 0.0, inner: 5.0, step: 4.0, order: LensOrder::One,
/// };
/// let path = ellipse(&pocket).unwrap();
/// assert_eq!(path.turns, 14.0); // (68 - 8 - 5) / 4 = 13.75
/// assert!(path.step <= 4.0 && (path.curves[0].end().y + 40.0).abs() < 1e-9);
/// ```
///
/// # Errors
/// `KC0401` when the cutter does not fit between the axes or into the bends of the wall (with the place), `KC0404` for
/// other numbers that give no path.
pub fn ellipse(pocket: &EllipsePocket) -> Result<ClearedEllipse> {
    let [x, y] = pocket.half_axes;
    if x < y {
        let lying = turned_in(&EllipsePocket { half_axes: [y, x], ..*pocket }, true)?;
        return Ok(ClearedEllipse {
            curves: lying.curves.iter().map(|c| c.rotated(FRAC_PI_2)).collect(),
            closing: lying.closing.rotated(FRAC_PI_2),
            reach: [lying.reach[1], lying.reach[0]],
            ..lying
        });
    }
    turned_in(pocket, false)
}

/// With the long axis along X; `upright` when the caller's is along Y.
fn turned_in(pocket: &EllipsePocket, upright: bool) -> Result<ClearedEllipse> {
    check(pocket, upright)?;
    let offset = pocket.cutter + pocket.allowance;
    let [a, b] = pocket.half_axes.map(|h| h - offset);
    if pocket.inner > 0.0 {
        return ForwardSpiral::from_circle(pocket, pocket.inner)?.finished(pocket, Vec::new());
    }
    if let Some(way) = ForwardSpiral::from_centre(pocket)? {
        // A semicircle from the centre, tangent to the spiral where it begins.
        let start = way.spiral()?.start();
        let first = arc(0.5 * start, 0.5 * start.length(), PI, PI)?;
        return way.finished(pocket, vec![first]);
    }
    // The spiral would turn back about the centre: run a circle of a step first.
    let inner = pocket.step.min(pocket.cutter).min(0.5 * b.min(a));
    let first = arc(DVec2::new(0.0, -0.5 * inner), 0.5 * inner, PI, PI)?;
    let ring = InvoluteRecord::circle(inner, 0.0)?.into();
    ForwardSpiral::from_circle(pocket, inner)?.finished(pocket, vec![first, ring])
}

impl EllipsePocket {
    /// Whether the cutter fits, and the numbers give a path.
    ///
    /// # Errors
    /// As [`ellipse`].
    pub fn check(&self) -> Result<()> {
        let [x, y] = self.half_axes;
        if x < y {
            return check(&EllipsePocket { half_axes: [y, x], ..*self }, true);
        }
        check(self, false)
    }
}

fn check(pocket: &EllipsePocket, upright: bool) -> Result<()> {
    let value = |what: &str, value: f64, bound: f64, help: &str| -> Result<()> {
        Err(Finding::error(Code::PLAN_VALUE, what).value_mm(value).bound_mm(bound).help(help).into())
    };
    let [a, b] = pocket.half_axes;
    if !(a.is_finite() && b > 0.0) {
        return value("the half axes of an elliptic pocket must be positive", b, 0.0, "");
    }
    if !(pocket.cutter > 0.0 && pocket.cutter.is_finite()) {
        return value("a cutter needs a positive radius", pocket.cutter, 0.0, "");
    }
    if !(pocket.allowance >= 0.0 && pocket.allowance.is_finite()) {
        return value("the allowance must not be negative", pocket.allowance, 0.0, "");
    }
    if !(pocket.step > 0.0 && pocket.step <= 2.0 * pocket.cutter) {
        let help = "choose a positive step up to the cutter's diameter";
        return value("the radial step is not usable", pocket.step, 2.0 * pocket.cutter, help);
    }
    let offset = pocket.cutter + pocket.allowance;
    if b <= offset {
        return Err(Finding::error(
            Code::CUTTER_TOO_LARGE,
            "the cutter does not fit between the ends of the short axis",
        )
        .value_mm(2.0 * offset)
        .bound_mm(2.0 * b)
        .help("use a cutter smaller than the short axis minus twice the allowance")
        .into());
    }
    let bend = b * b / a;
    if bend <= offset {
        return Err(bend_too_tight(a, bend, offset, upright));
    }
    if !(pocket.inner >= 0.0 && pocket.inner < b - offset) {
        let help = "enter on a smaller circle";
        return value(
            "the starting circle does not lie inside the path at the wall",
            pocket.inner,
            b - offset,
            help,
        );
    }
    let count = (a - offset - pocket.inner) / pocket.step;
    if count > MOST_PIECES { Err(too_many(count, "turns")) } else { Ok(()) }
}

/// The wall bends more than the cutter at the ends of the long axis.
fn bend_too_tight(a: f64, bend: f64, offset: f64, upright: bool) -> Error {
    let (x, y) = if upright { (0.0, a) } else { (a, 0.0) };
    let mut finding = Finding::error(
        Code::CUTTER_TOO_LARGE,
        format!(
            "the cutter with its allowance does not fit into the bends of the wall at the ends of the long axis, \
             ({x}, {y}) and ({}, {}): their radius of curvature is smaller",
            0.0 - x,
            0.0 - y
        ),
    )
    .value_mm(offset)
    .bound_mm(bend)
    .help("use a smaller cutter, or leave less stock");
    finding.point = Some([x, y, 0.0]);
    finding.into()
}

/// A spiral that does not turn back, with its first parameter.
struct ForwardSpiral {
    law: Support,
    inner: f64,
    turns: u32,
    /// Whole turns at the centre that are left out.
    left_out: u32,
    least_radius: f64,
}

impl ForwardSpiral {
    fn law(pocket: &EllipsePocket, inner: f64, turns: u32) -> Support {
        Support::Morph {
            inner,
            half_axes: pocket.half_axes,
            offset: pocket.cutter + pocket.allowance,
            turns: f64::from(turns),
            order: pocket.order,
        }
    }

    /// Smallest radius of curvature of a law between whole turns [mm]; stops early when it is not positive.
    fn least_radius(law: &Support, from: u32, to: u32) -> f64 {
        let mut least = f64::INFINITY;
        for i in PLACES * from..=PLACES * to {
            least = law.radius(TAU * f64::from(i) / f64::from(PLACES)).min(least);
            if least <= 0.0 {
                break;
            }
        }
        least
    }

    /// From a circle run before: the fewest turns that keep the step and do not turn back.
    fn from_circle(pocket: &EllipsePocket, inner: f64) -> Result<ForwardSpiral> {
        let offset = pocket.cutter + pocket.allowance;
        let least = turns(pocket.half_axes[0] - offset - inner, pocket.step)?;
        let mut tightest = f64::NEG_INFINITY;
        let mut count = least;
        while count <= least.saturating_mul(MOST_TIMES).saturating_add(MOST_TIMES) {
            let law = ForwardSpiral::law(pocket, inner, count);
            let radius = ForwardSpiral::least_radius(&law, 0, count);
            if radius > 0.0 {
                return Ok(ForwardSpiral { law, inner, turns: count, left_out: 0, least_radius: radius });
            }
            tightest = tightest.max(radius);
            count += 1 + count / 8;
        }
        Err(Finding::error(
            Code::PLAN_VALUE,
            "the pocket is too slender for a spiral from this circle: the path would turn back on itself",
        )
        .value_mm(tightest)
        .bound_mm(0.0)
        .help("enter on a larger circle, or use a larger cutter")
        .into())
    }

    /// From the centre, the first turn left out: it bends without bound. What the plunge and the turn after it clear
    /// must meet. Nothing when the spiral would turn back.
    fn from_centre(pocket: &EllipsePocket) -> Result<Option<ForwardSpiral>> {
        let offset = pocket.cutter + pocket.allowance;
        let least = turns(pocket.half_axes[0] - offset, pocket.step)?.max(2);
        for count in [least, least.saturating_add(1), least.saturating_mul(2)] {
            let law = ForwardSpiral::law(pocket, 0.0, count);
            let meets = (PLACES..=2 * PLACES).all(|i| {
                let [q, slope] = law.at(TAU * f64::from(i) / f64::from(PLACES));
                q.hypot(slope) < 2.0 * pocket.cutter
            });
            let radius = ForwardSpiral::least_radius(&law, 1, count);
            if radius <= 0.0 {
                // All of it shrinks with the count alike.
                return Ok(None);
            }
            if meets {
                return Ok(Some(ForwardSpiral {
                    law,
                    inner: 0.0,
                    turns: count,
                    left_out: 1,
                    least_radius: radius,
                }));
            }
        }
        Ok(None)
    }

    fn spiral(&self) -> Result<Spiral> {
        Spiral::new(self.law.into(), TAU * f64::from(self.left_out), TAU * f64::from(self.turns))
    }

    fn finished(self, pocket: &EllipsePocket, before: Vec<PlaneCurve>) -> Result<ClearedEllipse> {
        let wall = Support::Ellipse { half_axes: pocket.half_axes, offset: pocket.cutter + pocket.allowance };
        let (from, to) = (f64::from(self.left_out), f64::from(self.turns));
        let measured = Turns { inner: self.inner, parts: &[(self.law, to), (wall, 1.0)] };
        // A turn that is left out cannot be measured against.
        let first = if self.left_out > 0 { from + 1.0 } else { 0.0 };
        let step = measured.largest_step(TAU * first, TAU * (to + 1.0), LOOKS);
        let second = from + 1.0;
        let engagement = measured.largest_engagement(pocket.cutter, TAU * second, TAU * (to + 1.0), LOOKS);
        let closing = Spiral::new(wall.into(), 0.0, TAU)?;
        let run_before = before.iter().map(PlaneCurve::turn).sum::<f64>() / TAU;
        let mut curves = before;
        curves.push(self.spiral()?.into());
        Ok(ClearedEllipse {
            curves,
            closing: closing.into(),
            reach: pocket.half_axes.map(|h| h - pocket.cutter - pocket.allowance),
            turns: run_before + to - from,
            step,
            engagement,
            least_radius: self.least_radius.min(ForwardSpiral::least_radius(&wall, 0, 1)),
        })
    }
}

#[cfg(test)]
mod tests;
