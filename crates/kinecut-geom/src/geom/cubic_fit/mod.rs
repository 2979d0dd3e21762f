//! A plane curve as a chain of cubics with its tangents and curvatures at their ends, for controls that run cubics.
//!
//! Method: walk along the curve; between two of its places lies the cubic that touches it at both to the second
//! order. Its error is of the sixth order in the angle turned (an involute: `rho D^6 / 8100`), so the step that uses
//! the tolerance up follows from the error of the step before by a sixth root. The error is never assumed: each span is
//! measured against points of the exact curve, and made shorter until it fits.
//!
//! At a cusp the curvature is infinite: there the span has the tangents and passes through the middle.

use glam::DVec2;

use super::{CubicSpan, PlanarJet, PlaneCurve};
use crate::base::{Code, Error, Finding, Result};

/// Points at which a span is measured. Its error has a few extremes; with a dozen points to each, the largest is
/// missed by less than a hundredth.
const SAMPLES: usize = 32;
/// Share of the tolerance that the measured error may use: what the samples may miss.
const SHARE: f64 = 0.98;
/// Share of the tolerance that a step aims at, so that few are refused.
const AIM: f64 = 0.8;
/// Most that a step grows over the one before.
const GROW: f64 = 2.0;
/// Largest turn of a span [rad]: beyond it a cubic with these ends may have a loop.
const MOST_TURN: f64 = 1.5;
/// First step [rad].
const FIRST_STEP: f64 = 0.2;
/// Most spans: a tolerance that asks for more is a slip of units.
const MOST_SPANS: usize = 1_000_000;
/// Least step, as a share of the whole: below it parameters no longer differ by their rounding.
const LEAST_STEP: f64 = 1e-12;

/// The parameter to walk by: the turn of a record, a spiral's own.
fn ends(curve: &PlaneCurve) -> [f64; 2] {
    match curve {
        PlaneCurve::Record(record) if record.is_line() => [0.0, record.length()],
        PlaneCurve::Record(record) => [0.0, record.turn(record.length()).abs()],
        PlaneCurve::Spiral(spiral) => spiral.parameters(),
    }
}

fn jet(curve: &PlaneCurve, u: f64) -> PlanarJet {
    match curve {
        PlaneCurve::Record(record) if record.is_line() => record.at(u),
        PlaneCurve::Record(record) if u >= ends(curve)[1] => record.at(record.length()),
        PlaneCurve::Record(record) => record.at(record.length_at_turn(u)),
        PlaneCurve::Spiral(spiral) => spiral.at_parameter(u),
    }
}

/// A chain of cubics that leaves a plane curve by at most `tolerance` [mm], begins and ends in its ends, and has its
/// tangents and (but for cusps) its curvatures at every joint.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{InvoluteRecord, cubics_along};
/// let spiral = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
/// // Half as many blocks as arcs (217).
/// assert!(cubics_along(&spiral.into(), 0.001).unwrap().len() < 190);
/// ```
///
/// # Errors
/// `KC0801` when the tolerance is not positive, or so small that rounding is in its way.
pub fn cubics_along(curve: &PlaneCurve, tolerance: f64) -> Result<Vec<CubicSpan>> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(Finding::error(Code::GEOMETRY, "the tolerance of a chain of cubics must be positive")
            .value_mm(tolerance)
            .bound_mm(0.0)
            .into());
    }
    let too_fine = || -> Error {
        Finding::error(Code::GEOMETRY, "the tolerance of a chain of cubics is too small for this curve")
            .value_mm(tolerance)
            .into()
    };
    let [from, to] = ends(curve);
    let direction = if to < from { -1.0 } else { 1.0 };
    let mut spans = Vec::new();
    let (mut u, mut here) = (from, jet(curve, from));
    let mut step = FIRST_STEP.min((to - from).abs());
    while u != to {
        let left = (to - u).abs();
        // A rest shorter than a step is shared with the step before it.
        let wanted = if left <= step { left } else { step.min((0.5 * left).max(left - step)) };
        let next = if wanted >= left { to } else { u + direction * wanted };
        let there = jet(curve, next);
        let middle = jet(curve, 0.5 * (u + next)).p;
        let near = here.d1.angle_to(there.d1).abs() <= MOST_TURN;
        let fit = if near { CubicSpan::touching([here, there], middle) } else { None };
        let error = fit.as_ref().map_or(f64::INFINITY, |span| measure(span, curve, [u, next]));
        match fit {
            Some(span) if error <= SHARE * tolerance => spans.push(span),
            _ => {
                let shrink = if error.is_finite() {
                    (AIM * tolerance / error).powf(1.0 / 6.0).clamp(0.3, 0.95)
                } else {
                    0.5
                };
                step = wanted * shrink;
                if !(step > LEAST_STEP * (to - from).abs()) {
                    return Err(too_fine());
                }
                continue;
            }
        }
        if spans.len() > MOST_SPANS {
            return Err(too_fine());
        }
        // A piece whose error is rounding noise needs no smaller step.
        step = wanted * (AIM * tolerance / error.max(1e-3 * tolerance)).powf(1.0 / 6.0).min(GROW);
        (u, here) = (next, there);
    }
    Ok(spans)
}

/// Largest distance of points of the curve between two parameters from a span [mm]; infinite where the nearest points
/// do not follow one another along it (a loop).
fn measure(span: &CubicSpan, curve: &PlaneCurve, [a, b]: [f64; 2]) -> f64 {
    let mut worst: f64 = 0.0;
    let mut before = 0.0;
    for i in 1..=SAMPLES {
        let share = i as f64 / (SAMPLES + 1) as f64;
        let p = jet(curve, a + (b - a) * share).p;
        let Some((foot, off)) = foot(span, p, share.max(before)) else { return f64::INFINITY };
        if foot < before {
            return f64::INFINITY;
        }
        before = foot;
        // A distance that is not a number must not pass.
        if !(off <= worst) {
            worst = off;
        }
    }
    worst
}

/// The foot of a point on a span near a parameter, and the distance, by Gauss-Newton; `None` where it does not settle.
fn foot(span: &CubicSpan, p: DVec2, guess: f64) -> Option<(f64, f64)> {
    let mut t = guess;
    /// The guess is good to a few percent and the distance small: each step gains two digits or more.
    const STEPS: u32 = 12;
    /// Change of the parameter whose effect on a distance is rounding.
    const SETTLED: f64 = 1e-7;
    for _ in 0..STEPS {
        let [x, y] = span.series::<2>(t);
        let off = p - DVec2::new(x.value(), y.value());
        let along = DVec2::new(x.derivative(1), y.derivative(1));
        let step = off.dot(along) / along.length_squared();
        let next = (t + step).clamp(0.0, 1.0);
        if !((next - t).abs() > SETTLED) {
            return next.is_finite().then(|| (next, (p - span.point(next)).length()));
        }
        t = next;
    }
    None
}

#[cfg(test)]
mod tests;
