//! A part of a spiral in its place in the plane.

mod places;

use glam::DVec2;

pub(super) use places::Places;

use super::PlanarJet;
use super::spiral_law::SpiralLaw;
use crate::base::{Code, Finding, Result};
use crate::num::root::bracketed_newton;
use crate::num::taylor::Taylor;

/// A part of a [`SpiralLaw`]'s curve, mirrored, turned and shifted to its place; run towards smaller parameters when
/// `to < from`.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{LensOrder, Spiral, Support};
/// // From the circle of radius 10 to that of radius 79, twenty turns, contact G4 with both.
/// let r = 69.0 / (20.0 * std::f64::consts::TAU);
/// let law = Support::Lens { inner: 10.0, base_radius: r, order: LensOrder::One };
/// let spiral = Spiral::new(law.into(), 0.0, 20.0 * std::f64::consts::TAU).unwrap();
/// assert!((spiral.length() - std::f64::consts::PI * 20.0 * 89.0).abs() < 1e-9);
/// assert!((spiral.end().length() - 79.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spiral {
    law: SpiralLaw,
    from: f64,
    to: f64,
    mirrored: bool,
    turned: f64,
    shift: DVec2,
    length: f64,
}

impl Spiral {
    /// The part of a law's curve from parameter `from` to `to` [rad], about the origin.
    ///
    /// # Errors
    /// `KC0801` when a number is not finite or the part has no length.
    pub fn new(law: SpiralLaw, from: f64, to: f64) -> Result<Spiral> {
        let length = law.length(from, to).abs();
        if !(from.is_finite() && to.is_finite() && length.is_finite() && length > 0.0) {
            return Err(Finding::error(Code::GEOMETRY, "a spiral needs a part of positive, finite length")
                .value_mm(length)
                .into());
        }
        Ok(Spiral { law, from, to, mirrored: false, turned: 0.0, shift: DVec2::ZERO, length })
    }

    /// The law.
    pub fn law(&self) -> &SpiralLaw {
        &self.law
    }

    /// Placement of the law's curve: reflected (x -> -x) first if true, then turned about the origin [rad], then
    /// shifted [mm].
    pub fn placement(&self) -> (bool, f64, DVec2) {
        (self.mirrored, self.turned, self.shift)
    }

    /// Parameters at start and end [rad].
    pub fn parameters(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// +1 when it runs towards growing parameters.
    fn direction(&self) -> f64 {
        if self.to < self.from { -1.0 } else { 1.0 }
    }

    /// Arc length from the start to a parameter [mm].
    pub fn length_to(&self, u: f64) -> f64 {
        if u == self.to { self.length } else { self.law.length(self.from, u) * self.direction() }
    }

    /// The parameter at an arc length from the start [mm].
    pub fn parameter(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return self.from;
        }
        if s >= self.length {
            return self.to;
        }
        let d = self.direction();
        // Parameter counted from the start, so that the function grows; the length goes on from the last one.
        let width = (self.to - self.from).abs();
        let (mut last, mut length) = (self.from, 0.0);
        let f = |v: f64| {
            let u = self.from + d * v;
            length += self.law.length(last, u) * d;
            last = u;
            (length - s, self.law.speed(u))
        };
        /// Newton from the proportion; more steps only where it had to halve (a near-cusp).
        const STEPS: u32 = 60;
        let (v, _) = bracketed_newton(f, width * s / self.length, 0.0, width, STEPS);
        self.from + d * v
    }

    fn placed<const N: usize>(&self, [x, y]: [Taylor<N>; 2]) -> [Taylor<N>; 2] {
        let x = if self.mirrored { -x } else { x };
        let (sin, cos) = self.turned.sin_cos();
        [x.scaled(cos) - y.scaled(sin) + self.shift.x, x.scaled(sin) + y.scaled(cos) + self.shift.y]
    }

    /// The point as a series about a parameter, in the law's own parameter [mm].
    pub fn series<const N: usize>(&self, u: f64) -> [Taylor<N>; 2] {
        self.placed(self.law.series(u))
    }

    /// The point at a parameter [mm].
    pub fn point(&self, u: f64) -> DVec2 {
        let [x, y] = self.series::<1>(u);
        DVec2::new(x.value(), y.value())
    }

    /// Tangent angle in the direction of travel at a parameter [rad], continuous.
    pub fn angle(&self, u: f64) -> f64 {
        let forward = self.law.tangent_angle(u);
        let placed = if self.mirrored { std::f64::consts::PI - forward } else { forward } + self.turned;
        if self.to < self.from { placed + std::f64::consts::PI } else { placed }
    }

    /// The point as a series by arc length, in the direction of travel, at a parameter [mm]. Not a number at a cusp,
    /// but for the point.
    pub fn arc_series<const N: usize>(&self, u: f64) -> [Taylor<N>; 2] {
        by_arc_length(self.series(u), self.direction())
    }

    /// Point and derivatives at a parameter. At a cusp the curvature is infinite and the higher derivatives are not
    /// numbers.
    pub fn at_parameter(&self, u: f64) -> PlanarJet {
        let angle = self.angle(u);
        let (sin, cos) = angle.sin_cos();
        let (t, n) = (DVec2::new(cos, sin), DVec2::new(-sin, cos));
        let [x, y] = self.arc_series::<4>(u);
        let order = |k: usize| DVec2::new(x.derivative(k), y.derivative(k));
        let (mut d2, d3) = (order(2), order(3));
        let mut curvature = d2.dot(n);
        if !curvature.is_finite() {
            let turn = self.angle(u + self.direction()) - angle;
            curvature = f64::INFINITY.copysign(turn);
            d2 = n * curvature;
        }
        PlanarJet { p: order(0), d1: t, d2, d3, angle, curvature, curvature_slope: d3.dot(n) }
    }

    /// Point and derivatives at arc length `s` [mm].
    pub fn at(&self, s: f64) -> PlanarJet {
        self.at_parameter(self.parameter(s))
    }

    /// First point [mm].
    pub fn start(&self) -> DVec2 {
        self.point(self.from)
    }

    /// Last point [mm].
    pub fn end(&self) -> DVec2 {
        self.point(self.to)
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> Spiral {
        Spiral { from: self.to, to: self.from, ..*self }
    }

    /// The reflection x -> -x.
    #[must_use]
    pub fn mirrored(&self) -> Spiral {
        Spiral {
            mirrored: !self.mirrored,
            turned: -self.turned,
            shift: DVec2::new(-self.shift.x, self.shift.y),
            ..*self
        }
    }

    /// Moved by a translation [mm].
    #[must_use]
    pub fn shifted(&self, by: DVec2) -> Spiral {
        Spiral { shift: self.shift + by, ..*self }
    }

    /// Turned about the origin [rad].
    #[must_use]
    pub fn rotated(&self, angle: f64) -> Spiral {
        Spiral { turned: self.turned + angle, shift: DVec2::from_angle(angle).rotate(self.shift), ..*self }
    }

    /// The part between two parameters of this part [rad].
    #[must_use]
    pub fn between(&self, from: f64, to: f64) -> Spiral {
        Spiral { from, to, length: self.law.length(from, to).abs(), ..*self }
    }

    /// The parts of at most `most` [rad] each, in equal steps of the parameter, in the direction of travel.
    pub fn parts(&self, most: f64) -> Vec<Spiral> {
        /// A whole number of parts must not become one more by rounding.
        const SLACK: f64 = 1e-9;
        let n = ((self.to - self.from).abs() / most - SLACK).ceil().max(1.0);
        let at = |i: f64| if i == n { self.to } else { self.from + (self.to - self.from) * (i / n) };
        (0..n as u64).map(|i| self.between(at(i as f64), at((i + 1) as f64))).collect()
    }
}

/// A curve's series by a parameter turned into one by arc length; `direction` -1 for travel towards smaller
/// parameters.
pub(super) fn by_arc_length<const D: usize, const N: usize>(
    curve: [Taylor<N>; D],
    direction: f64,
) -> [Taylor<N>; D] {
    let mut squared = Taylor::<N>::constant(0.0);
    for c in &curve {
        let d = c.differentiated();
        squared = squared + d * d;
    }
    let length = squared.sqrt().integrated(0.0).scaled(direction);
    let parameter = length.inverted(0.0);
    curve.map(|c| c.compose(&parameter))
}

#[cfg(test)]
mod tests;
