//! A planar cubic Bezier curve: what `G5` of LinuxCNC is.
//!
//! For the writer, which fits it to spirals, and for the reader, which gets it exactly. Its own parameter runs from 0
//! to 1; arc length is the integral of the speed by adaptive quadrature, the parameter at a length follows by Newton,
//! derivatives of any order by power series.
//!
//! ```text
//! P(t) = (1-t)^3 P0 + 3 (1-t)^2 t P1 + 3 (1-t) t^2 P2 + t^3 P3
//! curvature at the ends: k0 = (2/3) T0 x (P2 - P1) / a^2,  k1 = (2/3) (P2 - P1) x T1 / b^2,  a, b: handles
//! ```
//!
//! Source: de Boor, Höllig, Sabin 1987 (contact of second order at both ends: error of the sixth order).

use glam::DVec2;

use super::PlanarJet;
use super::spiral::by_arc_length;
use crate::base::{Code, Finding, Result};
use crate::num::quadrature::gauss;
use crate::num::root::bracketed_newton;
use crate::num::taylor::Taylor;

/// A cubic Bezier curve in the plane, with its arc length.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::DVec2;
/// use kinecut::geom::CubicSpan;
/// // A quarter of the unit circle, as near as four points come to it.
/// let k = 4.0 / 3.0 * (2f64.sqrt() - 1.0);
/// let span = CubicSpan::new([DVec2::X, DVec2::new(1.0, k), DVec2::new(k, 1.0), DVec2::Y]).unwrap();
/// assert!((span.length() - std::f64::consts::FRAC_PI_2).abs() < 3e-4);
/// assert!((span.at(0.5 * span.length()).p - DVec2::splat(0.5f64.sqrt())).length() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicSpan {
    points: [DVec2; 4],
    length: f64,
}

/// Speed below which a point is a cusp, as a share of the size of the control polygon: the direction of the derivative
/// is rounding there.
const CUSP: f64 = 1e-9;

impl CubicSpan {
    /// The curve of four control points [mm].
    ///
    /// # Errors
    /// `KC0801` when a number is not finite or the curve has no length.
    pub fn new(points: [DVec2; 4]) -> Result<CubicSpan> {
        let flat = CubicSpan { points, length: 0.0 };
        let length = flat.length_between(0.0, 1.0);
        if !(points.iter().all(|p| p.is_finite()) && length.is_finite() && length > 0.0) {
            return Err(Finding::error(
                Code::GEOMETRY,
                "a cubic needs control points that are finite and not all the same",
            )
            .value_mm(length)
            .into());
        }
        Ok(CubicSpan { points, length })
    }

    /// The curve between two places of another curve with its tangents and curvatures there; where these admit none
    /// (a cusp, an inflection), with the tangents and through `middle` [mm]. `None` where not even that exists.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::{CubicSpan, InvoluteRecord};
    /// let record = InvoluteRecord::new(100.0, [0.0, 0.0], 0.0, 10.0, 20.0).unwrap();
    /// let span = CubicSpan::touching([record.at(0.0), record.at(8.0)], record.at(4.0).p).unwrap();
    /// assert!((span.points()[1].x - 2.62344513289389).abs() < 1e-12);
    /// ```
    pub fn touching(ends: [PlanarJet; 2], middle: DVec2) -> Option<CubicSpan> {
        let [from, to] = ends;
        let chord = to.p - from.p;
        let [a, b] = handles(&ends).or_else(|| {
            // P(1/2) = (P0 + P3) / 2 + 3/8 (a T0 - b T1).
            let goal = (middle - 0.5 * (from.p + to.p)) * (8.0 / 3.0);
            let across = from.d1.perp_dot(to.d1);
            let pair = [goal.perp_dot(to.d1) / across, goal.perp_dot(from.d1) / across];
            let sound = pair.iter().all(|h| *h > 0.0 && *h <= chord.length());
            let straight = chord.length() / 3.0;
            if sound { Some(pair) } else { (chord.dot(from.d1) > 0.0).then_some([straight; 2]) }
        })?;
        CubicSpan::new([from.p, from.p + from.d1 * a, to.p - to.d1 * b, to.p]).ok()
    }

    /// The control points [mm].
    pub fn points(&self) -> [DVec2; 4] {
        self.points
    }

    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// First point [mm].
    pub fn start(&self) -> DVec2 {
        self.points[0]
    }

    /// Last point [mm].
    pub fn end(&self) -> DVec2 {
        self.points[3]
    }

    /// The symmetric form of four parameters: the point where all are equal, control points where they are not.
    fn blossom(&self, [a, b, c]: [f64; 3]) -> DVec2 {
        // Exact at 0 and 1.
        let mix = |p: DVec2, q: DVec2, t: f64| p * (1.0 - t) + q * t;
        let [p, q, r, s] = self.points;
        let [u, v, w] = [mix(p, q, a), mix(q, r, a), mix(r, s, a)];
        mix(mix(u, v, b), mix(v, w, b), c)
    }

    /// The point at a parameter in `[0, 1]` [mm].
    pub fn point(&self, t: f64) -> DVec2 {
        self.blossom([t; 3])
    }

    /// First derivative by the parameter [mm].
    fn velocity(&self, t: f64) -> DVec2 {
        let [p, q, r, s] = self.points;
        let u = 1.0 - t;
        3.0 * ((q - p) * (u * u) + (r - q) * (2.0 * u * t) + (s - r) * (t * t))
    }

    /// Second derivative by the parameter [mm].
    fn acceleration(&self, t: f64) -> DVec2 {
        let [p, q, r, s] = self.points;
        6.0 * ((p - 2.0 * q + r) * (1.0 - t) + (q - 2.0 * r + s) * t)
    }

    /// Size of the control polygon [mm].
    fn size(&self) -> f64 {
        self.points.windows(2).map(|w| w[0].distance(w[1])).sum()
    }

    /// Arc length between two parameters [mm], never negative.
    pub fn length_between(&self, a: f64, b: f64) -> f64 {
        self.adaptive(a, b, gauss(a, b, 2.0, |t| self.velocity(t).length()), 0).abs()
    }

    fn adaptive(&self, a: f64, b: f64, whole: f64, depth: u32) -> f64 {
        /// Share of the polygon up to which the two halves may differ from the whole.
        const EXACT: f64 = 1e-14;
        /// A cusp is halved down to rounding.
        const DEEPEST: u32 = 40;
        let middle = 0.5 * (a + b);
        let speed = |t: f64| self.velocity(t).length();
        let [left, right] = [gauss(a, middle, 2.0, speed), gauss(middle, b, 2.0, speed)];
        // Not a number ends here too.
        if depth >= DEEPEST || !((left + right - whole).abs() > EXACT * self.size()) {
            return left + right;
        }
        self.adaptive(a, middle, left, depth + 1) + self.adaptive(middle, b, right, depth + 1)
    }

    /// The parameter at an arc length from the start [mm].
    pub fn parameter(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        if s >= self.length {
            return 1.0;
        }
        let f = |t: f64| (self.length_between(0.0, t) - s, self.velocity(t).length());
        /// Newton from the proportion; more steps only where it had to halve (a near-cusp).
        const STEPS: u32 = 60;
        bracketed_newton(f, s / self.length, 0.0, 1.0, STEPS).0
    }

    /// The point as a series about a parameter, in the parameter [mm].
    pub fn series<const N: usize>(&self, t: f64) -> [Taylor<N>; 2] {
        let [p, q, r, s] = self.points;
        let third = (s - p) - 3.0 * (r - q);
        let coefficients = [self.point(t), self.velocity(t), 0.5 * self.acceleration(t), third];
        let along = |axis: usize| {
            let mut c = Taylor::<N>::constant(0.0);
            c.0.iter_mut().zip(coefficients).for_each(|(c, v)| *c = v[axis]);
            c
        };
        [along(0), along(1)]
    }

    /// The point as a series by arc length at a parameter [mm]. Not a number at a cusp, but for the point.
    pub fn arc_series<const N: usize>(&self, t: f64) -> [Taylor<N>; 2] {
        by_arc_length(self.series(t), 1.0)
    }

    /// Unit tangent at a parameter; at a cusp that of what follows (at the end: of what comes before).
    pub fn tangent(&self, t: f64) -> DVec2 {
        let [v, a] = [self.velocity(t), self.acceleration(t)];
        let least = CUSP * self.size();
        let ahead = if t < 1.0 { a } else { -a };
        let [p, _, _, s] = self.points;
        let along = [v, ahead, s - p].into_iter().find(|d| d.length() > least);
        along.and_then(DVec2::try_normalize).unwrap_or(DVec2::X)
    }

    /// Point and derivatives by arc length at a parameter; the tangent angle lies in (-pi, pi]. At a cusp the curvature
    /// is infinite and the higher derivatives are not numbers.
    pub fn at_parameter(&self, t: f64) -> PlanarJet {
        let tangent = self.tangent(t);
        let normal = tangent.perp();
        let [x, y] = self.arc_series::<4>(t);
        let order = |k: usize| DVec2::new(x.derivative(k), y.derivative(k));
        let (mut d2, d3) = (order(2), order(3));
        let mut curvature = d2.dot(normal);
        if self.velocity(t).length() <= CUSP * self.size() || !curvature.is_finite() {
            let step = if t < 1.0 { 1e-3 } else { -1e-3 };
            let side = tangent.perp_dot(self.tangent(t + step)) * step;
            curvature = f64::INFINITY.copysign(side);
            d2 = normal * curvature;
        }
        PlanarJet {
            p: self.point(t),
            d1: tangent,
            d2,
            d3,
            angle: tangent.to_angle(),
            curvature,
            curvature_slope: d3.dot(normal),
        }
    }

    /// Point and derivatives at arc length `s` [mm].
    pub fn at(&self, s: f64) -> PlanarJet {
        self.at_parameter(self.parameter(s))
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> CubicSpan {
        let [p, q, r, s] = self.points;
        CubicSpan { points: [s, r, q, p], ..*self }
    }

    /// The part between two parameters `a <= b`.
    #[must_use]
    pub fn between(&self, a: f64, b: f64) -> CubicSpan {
        let points = [[a, a, a], [a, a, b], [a, b, b], [b, b, b]].map(|t| self.blossom(t));
        CubicSpan { points, length: self.length_between(a, b) }
    }

    /// Under a rigid motion of the plane.
    #[must_use]
    pub fn mapped(&self, motion: impl Fn(DVec2) -> DVec2) -> CubicSpan {
        CubicSpan { points: self.points.map(motion), ..*self }
    }

    /// Moved by a translation [mm].
    #[must_use]
    pub fn shifted(&self, by: DVec2) -> CubicSpan {
        CubicSpan { points: self.points.map(|p| p + by), ..*self }
    }

    /// Sum of the angles turned, whichever way, always positive [rad].
    pub fn turn(&self) -> f64 {
        /// A cubic turns by less than a full turn and has at most two inflections.
        const STEPS: u32 = 32;
        let angles = |i: u32| self.tangent(f64::from(i) / f64::from(STEPS));
        (0..STEPS).map(|i| angles(i).angle_to(angles(i + 1)).abs()).sum()
    }

    /// Points of a polyline that leaves the curve by at most `chord` [mm], both ends included.
    pub fn polyline(&self, chord: f64) -> Vec<DVec2> {
        // The sagitta over a step h of the parameter is at most |P''| h^2 / 8, and P'' is largest at an end.
        let most = self.acceleration(0.0).length().max(self.acceleration(1.0).length());
        /// Beyond it the tolerance is a slip of units.
        const MOST: f64 = 1e7;
        let n = (most / (8.0 * chord)).sqrt().ceil().clamp(1.0, MOST);
        (0..=n as u64).map(|i| self.point(i as f64 / n)).collect()
    }
}

/// Handles that give a cubic the tangents and curvatures of both ends [mm], by Newton from those of a circle; `None`
/// without handles that are positive and no longer than the chord.
fn handles([from, to]: &[PlanarJet; 2]) -> Option<[f64; 2]> {
    let (t0, t1) = (from.d1, to.d1);
    let chord = to.p - from.p;
    let (left, right, across) = (t0.perp_dot(chord), chord.perp_dot(t1), t0.perp_dot(t1));
    let (k0, k1) = (1.5 * from.curvature, 1.5 * to.curvature);
    let turn = t0.angle_to(t1);
    // The circle's handle (4/3) tan(turn/4) radius, by its chord: also for no turn at all.
    let circle = chord.length() / (3.0 * (0.25 * turn).cos().powi(2));
    let [mut a, mut b] = [circle; 2];
    /// Newton converges in four to six; near an inflection in a few more.
    const STEPS: u32 = 30;
    /// Change of a handle that is rounding, as a share of the chord.
    const ROUNDING: f64 = 1e-15;
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let f = [k0 * a * a + across * b - left, k1 * b * b + across * a - right];
        let (p, q) = (2.0 * k0 * a, 2.0 * k1 * b);
        let det = p * q - across * across;
        let step = [(q * f[0] - across * f[1]) / det, (p * f[1] - across * f[0]) / det];
        a -= step[0];
        b -= step[1];
        let change = step[0].abs() + step[1].abs();
        let settled = change <= ROUNDING * chord.length() || change >= before && change < 1e-9 * circle;
        if settled {
            let sound = |h: f64| h > 0.0 && h <= chord.length();
            return (sound(a) && sound(b)).then_some([a, b]);
        }
        if !change.is_finite() {
            return None;
        }
        before = change;
    }
    None
}

#[cfg(test)]
mod tests;
