//! A plane curve with exact tangents as a chain of tangent arcs, for controls and for closed-form cutting.
//!
//! Method: walk along the curve; between two of its points with their tangents lies a biarc (two arcs that meet with a
//! common tangent) of equal tangent lengths. Its distance from the curve is `|k'| L^3 / 324` to the first order (`k'`
//! derivative of the curvature by arc length, `L` length), so the step that uses the tolerance up follows from the error
//! of the step before by a cube root. The error is never assumed: each biarc is measured against points of the curve,
//! and halved until it fits. At a cusp (radius of curvature 0) and at an inflection nothing is special: the tangent is
//! given, and the biarc may turn either way.
//!
//! If the height changes other than in proportion, the error of the height is part of the measure.
//!
//! Source: equal tangent lengths: Bolton 1975; the constant 324 agrees with the count of biarcs of an involute in
//! [`biarcs_needed`](super::biarcs_needed).

mod points;

pub use points::arcs_near;

use glam::{DVec2, DVec3};

use super::arc_chain::{PlanarArc, arc_chain};
use super::{Arc, CubicSpan, Curve, Line, PlaneCurve, Rise, Spiral};
use crate::base::{Code, Finding, Result};

/// Points at which a biarc is measured. Its error has at most a few extremes; the largest of a smooth function with
/// three is found to a few percent.
const SAMPLES: usize = 9;
/// Share of the tolerance that the measured error may use: what the samples may miss.
const SHARE: f64 = 0.93;
/// Share of the tolerance that a step aims at, so that few are refused.
const AIM: f64 = 0.75;
/// Most that a step grows over the one before.
const GROW: f64 = 2.0;
/// Largest turn of a biarc [rad]: beyond it the biarc of equal tangent lengths is no near fit.
const MOST_TURN: f64 = 1.4;
/// First step [rad of the curve's own parameter].
const FIRST_STEP: f64 = 0.2;
/// Sagitta below which a piece is straight [mm]: a thousandth of the finest resolution of a control.
const STRAIGHT: f64 = 1e-9;
/// Most pieces: a tolerance that asks for more is a slip of units, and would fill the memory.
const MOST_PIECES: usize = 2_000_000;
/// Least step, as a share of the whole: below it parameters no longer differ by their rounding.
const LEAST_STEP: f64 = 1e-12;

/// A curve to walk along: point and unit tangent in the direction of travel at a parameter.
pub(super) trait Walk {
    /// Parameters at start and end.
    fn ends(&self) -> [f64; 2];
    /// Point and unit tangent.
    fn at(&self, u: f64) -> (DVec2, DVec2);
    /// Arc length between two parameters [mm], never negative.
    fn length(&self, a: f64, b: f64) -> f64;
}

impl Walk for Spiral {
    fn ends(&self) -> [f64; 2] {
        self.parameters()
    }

    fn at(&self, u: f64) -> (DVec2, DVec2) {
        /// Speed below which the direction of the derivative is rounding [mm/rad].
        const CUSP: f64 = 1e-9;
        let [x, y] = self.series::<2>(u);
        let [from, to] = self.parameters();
        let direction = if to < from { -1.0 } else { 1.0 };
        let d = DVec2::new(x.derivative(1), y.derivative(1)) * direction;
        let speed = d.length();
        let tangent = if speed > CUSP { d / speed } else { DVec2::from_angle(self.angle(u)) };
        (DVec2::new(x.value(), y.value()), tangent)
    }

    fn length(&self, a: f64, b: f64) -> f64 {
        self.law().length(a, b).abs()
    }
}

impl Walk for CubicSpan {
    fn ends(&self) -> [f64; 2] {
        [0.0, 1.0]
    }

    fn at(&self, u: f64) -> (DVec2, DVec2) {
        (self.point(u), self.tangent(u))
    }

    fn length(&self, a: f64, b: f64) -> f64 {
        self.length_between(a, b)
    }
}

impl CubicSpan {
    /// Largest distance of the curve from `count` biarcs through its points at equal steps of the parameter [mm]:
    /// how some controls run it. Infinite where a biarc does not exist (a cusp).
    pub fn off_biarcs(&self, count: u32) -> f64 {
        let at = |i: u32| f64::from(i) / f64::from(count);
        let offs = (0..count).map(|i| biarc_error(self, [at(i), at(i + 1)]));
        // A distance that is not a number never fits.
        offs.map(|off| if off >= 0.0 { off } else { f64::INFINITY })
            .fold(0.0, |a, b| if b > a { b } else { a })
    }

    /// The curve as tangent arcs and lines that leave it by at most `tolerance` [mm].
    ///
    /// # Errors
    /// `KC0801` when the tolerance is not positive or too small, or where the curve turns back in a cusp.
    pub fn arcs(&self, tolerance: f64) -> Result<Vec<PlanarArc>> {
        arcs_of(self, tolerance)
    }
}

/// A chain of tangent arcs and straight pieces that leaves a plane curve by at most `tolerance` [mm], begins and ends
/// exactly in its ends and has its tangents there.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{InvoluteRecord, arcs_along};
/// let spiral = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
/// assert!(arcs_along(&spiral.into(), 0.001).unwrap().len() <= 217 + 4);
/// ```
///
/// # Errors
/// `KC0801` when the tolerance is not positive, or so small that the chain would need millions of arcs.
pub fn arcs_along(curve: &PlaneCurve, tolerance: f64) -> Result<Vec<PlanarArc>> {
    match curve {
        PlaneCurve::Record(record) => arc_chain(record, tolerance),
        PlaneCurve::Spiral(spiral) => arcs_of(spiral, tolerance),
    }
}

/// The chain of a curve, in its plane.
pub(super) fn arcs_of(curve: &impl Walk, tolerance: f64) -> Result<Vec<PlanarArc>> {
    Ok(chain(curve, &Rise::NONE, tolerance)?.into_iter().map(|p| p.arc).collect())
}

/// Largest distance of the curve between two parameters from the biarc through its ends there [mm]; infinite where no
/// biarc exists.
pub(super) fn biarc_error(curve: &impl Walk, [a, b]: [f64; 2]) -> f64 {
    let biarc = Biarc::new(curve.at(a), curve.at(b));
    biarc.map_or(f64::INFINITY, |biarc| biarc.error(curve, [a, b], None))
}

/// A spiral that begins at height `z` and rises, as lines, arcs and helices that leave it by at most `tolerance` [mm].
///
/// # Errors
/// As [`arcs_along`].
pub fn helices_along(spiral: &Spiral, z: f64, rise: &Rise, tolerance: f64) -> Result<Vec<Curve>> {
    Ok(raise(&chain(spiral, rise, tolerance)?, z))
}

/// Pieces in space.
pub(super) fn raise(pieces: &[FitPiece], z: f64) -> Vec<Curve> {
    let mut from = z;
    let space = |p: &FitPiece| {
        let to = z + p.height;
        let start = p.arc.start.extend(from);
        let curve: Curve = if p.arc.is_line() {
            Line { start, end: p.arc.end.extend(to) }.into()
        } else {
            let centre = p.arc.centre.extend(from);
            Arc { start, centre, axis: DVec3::Z, sweep: p.arc.sweep, rise: to - from }.into()
        };
        from = to;
        curve
    };
    pieces.iter().map(space).collect()
}

/// A piece of a chain, and the height of its end above the start of the chain [mm].
#[derive(Clone, Copy, Debug)]
pub(super) struct FitPiece {
    pub(super) arc: PlanarArc,
    height: f64,
}

/// The chain of a curve.
pub(super) fn chain(curve: &impl Walk, rise: &Rise, tolerance: f64) -> Result<Vec<FitPiece>> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(Finding::error(Code::GEOMETRY, "the tolerance of an arc chain must be positive")
            .value_mm(tolerance)
            .bound_mm(0.0)
            .into());
    }
    let too_fine = || -> crate::base::Error {
        Finding::error(Code::GEOMETRY, "the tolerance of an arc chain is too small for this curve")
            .value_mm(tolerance)
            .into()
    };
    let [from, to] = curve.ends();
    let direction = if to < from { -1.0 } else { 1.0 };
    let level = rise.is_even() == Some(0.0);
    let even = rise.is_even().is_some();
    let total = if level { 1.0 } else { curve.length(from, to) };
    let mut pieces = Vec::new();
    let (mut u, mut here) = (from, curve.at(from));
    let mut step = FIRST_STEP.min((to - from).abs());
    let mut travelled = 0.0;
    while u != to {
        let left = (to - u).abs();
        // A rest shorter than a third of a step is shared with the step before it.
        let wanted = if left <= step { left } else { step.min((0.5 * left).max(left - step)) };
        let next = if wanted >= left { to } else { u + direction * wanted };
        let there = curve.at(next);
        let turn = here.1.angle_to(there.1);
        let fit = if turn.abs() <= MOST_TURN { Biarc::new(here, there) } else { None };
        let length = if level { 0.0 } else { curve.length(u, next) };
        let span = [travelled / total, (travelled + length) / total];
        let error = match &fit {
            Some(biarc) => biarc.error(curve, [u, next], (!even).then_some((rise, span))),
            None => f64::INFINITY,
        };
        if error > SHARE * tolerance || !(error >= 0.0) {
            // The cube root of a finite error; at least a halving of what does not fit at all.
            let shrink =
                if error.is_finite() { (AIM * tolerance / error).cbrt().clamp(0.1, 0.85) } else { 0.5 };
            step = wanted * shrink;
            if step <= LEAST_STEP * (to - from).abs() {
                return Err(too_fine());
            }
            continue;
        }
        let Some(biarc) = fit else { return Err(too_fine()) };
        let lengths = [biarc.first.length(), biarc.last.length()];
        let middle = span[0] + (span[1] - span[0]) * lengths[0] / (lengths[0] + lengths[1]);
        for (arc, f) in [(biarc.first, middle), (biarc.last, span[1])] {
            if arc.start != arc.end {
                let height = if level {
                    0.0
                } else if f >= 1.0 {
                    rise.total()
                } else {
                    rise.at(f)
                };
                pieces.push(FitPiece { arc, height });
            }
        }
        if pieces.len() > MOST_PIECES {
            return Err(too_fine());
        }
        // A piece whose error is rounding noise needs no smaller step.
        let grow = (AIM * tolerance / error.max(1e-3 * tolerance)).cbrt().min(GROW);
        step = wanted * grow;
        (u, here) = (next, there);
        travelled += length;
    }
    if let Some(last) = pieces.last_mut() {
        last.height = rise.total();
    }
    Ok(pieces)
}

/// Two arcs that meet with a common tangent.
#[derive(Clone, Copy, Debug)]
struct Biarc {
    first: PlanarArc,
    last: PlanarArc,
    /// Tangent at the joint.
    tangent: DVec2,
}

impl Biarc {
    /// Between two points with unit tangents; `None` where it would have to turn back.
    ///
    /// ```text
    /// d = v.v / (v.(t0 + t1) + sqrt((v.(t0 + t1))^2 + 2 (1 - t0.t1) v.v)),   v = p1 - p0
    /// ```
    fn new((p0, t0): (DVec2, DVec2), (p1, t1): (DVec2, DVec2)) -> Option<Biarc> {
        let v = p1 - p0;
        let along = v.dot(t0 + t1);
        let squared = v.length_squared();
        // |t0 - t1|^2 / 2 = 1 - t0.t1, without cancellation.
        let bend = (t0 - t1).length_squared();
        let d = squared / (along + (along * along + bend * squared).sqrt());
        if !(along > 0.0 && d > 0.0 && d.is_finite()) {
            return None;
        }
        let joint = 0.5 * (p0 + p1 + (t0 - t1) * d);
        let tangent = ((p1 - t1 * d) - (p0 + t0 * d)).try_normalize()?;
        let last = arc_from(p1, -t1, joint);
        Some(Biarc {
            first: arc_from(p0, t0, joint),
            last: PlanarArc { start: last.end, end: last.start, sweep: -last.sweep, ..last },
            tangent,
        })
    }

    /// Largest distance of the curve between two parameters from it, at the samples; with the heights.
    fn error(&self, curve: &impl Walk, [a, b]: [f64; 2], rise: Option<(&Rise, [f64; 2])>) -> f64 {
        let joint = self.first.end;
        let mut points = [DVec2::ZERO; SAMPLES];
        let mut worst: f64 = 0.0;
        for (i, p) in points.iter_mut().enumerate() {
            *p = curve.at(a + (b - a) * (i + 1) as f64 / (SAMPLES + 1) as f64).0;
            let arc = if (*p - joint).dot(self.tangent) < 0.0 { &self.first } else { &self.last };
            let off = distance(arc, *p);
            // A distance that is not a number must not pass.
            if !(off <= worst) {
                worst = off;
            }
        }
        let Some((rise, [from, to])) = rise else { return worst };
        // Lengths up to the samples, by chords: good to a thousandth of the length of a piece.
        let mut lengths = [0.0; SAMPLES + 1];
        let mut before = self.first.start;
        let mut sum = 0.0;
        for (i, p) in points.iter().chain([&self.last.end]).enumerate() {
            sum += p.distance(before);
            lengths[i] = sum;
            before = *p;
        }
        let middle = self.first.length() / (self.first.length() + self.last.length());
        let at = |f: f64| rise.at(from + (to - from) * f);
        let [z0, z1, z2] = [at(0.0), at(middle), at(1.0)];
        let mut height: f64 = 0.0;
        for s in &lengths[..SAMPLES] {
            let f = s / sum;
            let straight = if f < middle {
                z0 + (z1 - z0) * f / middle
            } else {
                z1 + (z2 - z1) * (f - middle) / (1.0 - middle)
            };
            height = height.max((straight - at(f)).abs());
        }
        worst.hypot(height)
    }
}

/// Distance of a point near an arc from it [mm].
fn distance(arc: &PlanarArc, p: DVec2) -> f64 {
    if arc.is_line() {
        let along = arc.end - arc.start;
        return match along.try_normalize() {
            Some(t) => t.perp_dot(p - arc.start).abs(),
            None => (p - arc.start).length(),
        };
    }
    ((p - arc.centre).length() - arc.radius()).abs()
}

/// The arc from a point with this unit tangent to another point.
fn arc_from(p: DVec2, t: DVec2, end: DVec2) -> PlanarArc {
    let chord = end - p;
    let across = t.perp_dot(chord);
    let sweep = 2.0 * across.atan2(t.dot(chord));
    if chord.length() * sweep.abs() < 8.0 * STRAIGHT {
        return PlanarArc { start: p, end, centre: p, sweep: 0.0 };
    }
    PlanarArc { start: p, end, centre: p + t.perp() * (chord.length_squared() / (2.0 * across)), sweep }
}

#[cfg(test)]
mod tests;
