//! The laws of spirals that are no circle involutes: support functions, the Archimedean spiral, trochoidal loops.
//!
//! Most are *support curves*: with the tangent `t = (cos th, sin th)` and the outward normal `u = (sin th, -cos th)`
//! at the tangent angle `th` the point is `p = q u + q' t`, its radius of curvature `q + q''`. A circle about the
//! origin is `q = R`; the order to which the derivatives of `q` vanish is the order of contact with it.
//!
//! The *lens* weight `W_j(th)` (an angle that grows by a turn in a turn, with `2 + 2 j` derivatives that vanish at
//! whole turns) makes every law here touch its circles, or the ellipse, with contact G2, G4 or G6 for j = 0, 1, 2.
//! It comes from the theorem that the involute of any closed convex oval of perimeter H has the constant normal step
//! H: the oval of radius of curvature `C_j r sin^(2j) th`. For j = 0 it is the circle involute of Sorokin, But,
//! Kombarov 2013.
//!
//! All laws run counter-clockwise about the origin with growing parameter. Series are exact ([`Taylor`]).

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;
use serde::Serialize;

use crate::num::quadrature::{gauss, gauss_short};
use crate::num::series::one_minus_cos;
use crate::num::taylor::Taylor;

/// Order of a lens weight: `2 + 2 j` vanishing derivatives at whole turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LensOrder {
    /// j = 0: the circle involute, contact G2.
    Zero,
    /// j = 1: contact G4.
    One,
    /// j = 2: contact G6.
    Two,
}

impl LensOrder {
    /// `(k, c)`: the weight is `W(th) = th + sum of c sin(k th)`.
    fn terms(self) -> &'static [(f64, f64)] {
        match self {
            LensOrder::Zero => &[(1.0, -1.0)],
            LensOrder::One => &[(1.0, -4.0 / 3.0), (2.0, 1.0 / 6.0)],
            LensOrder::Two => &[(1.0, -64.0 / 45.0), (2.0, 2.0 / 9.0), (4.0, -1.0 / 180.0)],
        }
    }

    /// The weight and its derivative by the tangent angle.
    fn weight<const N: usize>(self, theta: f64) -> (Taylor<N>, Taylor<N>) {
        let th = Taylor::<N>::variable(theta);
        let (mut w, mut slope) = (th, Taylor::constant(1.0));
        for &(k, c) in self.terms() {
            let (sin, cos) = th.scaled(k).sin_cos();
            w = w + sin.scaled(c);
            slope = slope + cos.scaled(c * k);
        }
        (w, slope)
    }

    /// The order of contact, 2, 4 or 6.
    pub fn contact(self) -> u8 {
        match self {
            LensOrder::Zero => 2,
            LensOrder::One => 4,
            LensOrder::Two => 6,
        }
    }
}

/// A law: a plane curve about the origin as a function of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpiralLaw {
    /// A support curve; parameter: tangent angle [rad].
    Support(Support),
    /// Archimedean spiral: radius `growth` times the parameter, which is the polar angle.
    Archimedes {
        /// Growth of the radius by angle [mm/rad].
        growth: f64,
    },
    /// Trochoidal loops along a ring: `carrier e^(i u) + loop_radius e^(i w u)`.
    Trochoid {
        /// Radius of the carrier circle [mm].
        carrier: f64,
        /// Radius of the loops [mm].
        loop_radius: f64,
        /// Turns of the loop vector in a turn of the carrier (w).
        rate: f64,
    },
}

/// A support curve, by its support function `q` of the tangent angle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Support {
    /// Lens involute: `q = inner + r W(th)`. Constant normal step `2 pi r`. With `r = 0` the circle of radius
    /// `inner`.
    Lens {
        /// Radius of the circle touched at parameter 0 [mm].
        inner: f64,
        /// Growth of the radius by angle, the mean radius of the evolute [mm].
        base_radius: f64,
        /// Order of the weight.
        order: LensOrder,
    },
    /// Spiral of constant engagement.
    ConstantEngagement(ConstantEngagement),
    /// From a circle to an ellipse: `q = inner + W(th)/(2 pi turns) (Q(th) - inner)` with the support function
    /// `Q = sqrt(a^2 sin^2 th + b^2 cos^2 th) - offset` of an inner parallel of the ellipse.
    Morph {
        /// Radius of the circle at parameter 0 [mm].
        inner: f64,
        /// Half axes of the ellipse along X and Y [mm].
        half_axes: [f64; 2],
        /// Distance of the path from the ellipse [mm].
        offset: f64,
        /// Turns from circle to ellipse.
        turns: f64,
        /// Order of the weight.
        order: LensOrder,
    },
    /// The inner parallel of an ellipse itself.
    Ellipse {
        /// Half axes along X and Y [mm].
        half_axes: [f64; 2],
        /// Distance of the path from the ellipse [mm].
        offset: f64,
    },
}

/// The spiral on which a cutter's engagement is the same on every turn, as closed as it gets: the step `h(q)` of
/// equal engagement at path radius `q` gives the number of turns `G(q)` by an elementary integral, and
/// `G(q(th)) = G(inner) + W(th) / 2 pi`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ConstantEngagement {
    inner: f64,
    outer: f64,
    cutter: f64,
    #[serde(rename = "cos_engagement")]
    cos: f64,
    order: LensOrder,
    /// G at `inner`, and turns from there to `outer`.
    #[serde(skip)]
    start: f64,
    turns: f64,
}

impl ConstantEngagement {
    /// From path radius `inner` to `outer` [mm] with the engagement `angle` [rad] of a cutter of radius `cutter`
    /// [mm]; all positive, `inner < outer`, the angle below pi: the caller's to check.
    pub fn new(inner: f64, outer: f64, cutter: f64, angle: f64, order: LensOrder) -> ConstantEngagement {
        let mut law =
            ConstantEngagement { inner, outer, cutter, cos: angle.cos(), order, start: 0.0, turns: 0.0 };
        law.start = law.count(inner);
        law.turns = law.count(outer) - law.start;
        law
    }

    /// Turns from the inner to the outer circle.
    pub fn turns(&self) -> f64 {
        self.turns
    }

    /// Inner and outer path radius [mm].
    pub fn radii(&self) -> [f64; 2] {
        [self.inner, self.outer]
    }

    /// Engagement [rad].
    pub fn angle(&self) -> f64 {
        self.cos.acos()
    }

    /// The normal step at path radius `q` [mm].
    pub fn step(&self, q: f64) -> f64 {
        let a = self.cutter;
        let side = (q * q + a * a + 2.0 * q * a * self.cos).sqrt();
        2.0 * a * (1.0 - self.cos) * q / (q + a + side)
    }

    /// The integral of `dq / h(q)`, to a constant.
    fn count(&self, q: f64) -> f64 {
        let a = self.cutter;
        let b = a * self.cos;
        let side = (q * q + 2.0 * b * q + a * a).sqrt();
        let sum = q + side + b * (q + b + side).ln() - a * ((a * a + b * q + a * side) / (q * q)).ln();
        sum / (2.0 * a * (1.0 - self.cos))
    }

    /// The path radius at which [`Self::count`] is `wanted`, from the straight line between the circles at `share`:
    /// the series of the inverse function to the third power, as `dq/dG = h(q)`, inside a shrinking bracket.
    fn radius_of_count(&self, wanted: f64, share: f64) -> f64 {
        /// A step so small, relative, leaves an error of its fourth power.
        const LAST: f64 = 1e-4;
        /// Three to five steps; more only where it had to halve.
        const STEPS: u32 = 60;
        // Beyond the ends a little is allowed: rounding of the last turn.
        let (mut lo, mut hi) = (0.5 * self.inner, 1.5 * self.outer);
        let (a, b) = (self.cutter, self.cutter * self.cos);
        let mut q = (self.inner + (self.outer - self.inner) * share).clamp(lo, hi);
        for _ in 0..STEPS {
            let missing = wanted - self.count(q);
            if missing > 0.0 {
                lo = q;
            } else {
                hi = q;
            }
            let side = (q * q + 2.0 * b * q + a * a).sqrt();
            let h = self.step(q);
            let (h1, h2) = (1.0 - (q + b) / side, -(a * a - b * b) / (side * side * side));
            let step = h * missing * (1.0 + missing * (0.5 * h1 + missing * (h1 * h1 + h * h2) / 6.0));
            let next = q + step;
            if !(next >= lo && next <= hi) {
                // Also at the last ulp, where the bracket ends in q itself.
                let half = 0.5 * (lo + hi);
                if (half - q).abs() <= f64::EPSILON * q || step.abs() <= f64::EPSILON * q {
                    return q;
                }
                q = half;
                continue;
            }
            q = next;
            if step.abs() <= LAST * q {
                break;
            }
        }
        q
    }

    /// Support function and derivative at a tangent angle.
    fn support<const N: usize>(&self, theta: f64) -> (Taylor<N>, Taylor<N>) {
        let (weight, slope) = self.order.weight::<N>(theta);
        let wanted = self.start + weight.value() / TAU;
        let q0 = self.radius_of_count(wanted, weight.value() / (TAU * self.turns));
        // q' = h(q) w / 2 pi gives one coefficient after the other.
        let (a, rate) = (self.cutter, slope.scaled(1.0 / TAU));
        let mut q = Taylor::<N>::constant(q0);
        let mut growth = q;
        for k in 1..=N {
            let side = (q * q + q.scaled(2.0 * a * self.cos) + a * a).sqrt();
            let step = q.scaled(2.0 * a * (1.0 - self.cos)) * (q + side + a).recip();
            growth = step * rate;
            if k < N {
                q.0[k] = growth.0[k - 1] / k as f64;
            }
        }
        (q, growth)
    }
}

/// Support function of an inner parallel of an ellipse, with its derivative by the tangent angle.
fn ellipse<const N: usize>([a, b]: [f64; 2], offset: f64, theta: f64) -> (Taylor<N>, Taylor<N>) {
    let (sin, cos) = Taylor::<N>::variable(theta).sin_cos();
    let whole = ((sin * sin).scaled(a * a) + (cos * cos).scaled(b * b)).sqrt();
    let slope = (sin * cos).scaled(a * a - b * b) * whole.recip();
    (whole + -offset, slope)
}

impl Support {
    /// The support function and its derivative as series about a tangent angle.
    pub fn series<const N: usize>(&self, theta: f64) -> (Taylor<N>, Taylor<N>) {
        match *self {
            Support::Lens { inner, base_radius, order } => {
                let (w, slope) = order.weight(theta);
                (w.scaled(base_radius) + inner, slope.scaled(base_radius))
            }
            Support::ConstantEngagement(law) => law.support(theta),
            Support::Morph { inner, half_axes, offset, turns, order } => {
                let (w, w1) = order.weight::<N>(theta);
                let (share, share1) = (w.scaled(1.0 / (TAU * turns)), w1.scaled(1.0 / (TAU * turns)));
                let (q, q1) = ellipse::<N>(half_axes, offset + inner, theta);
                (share * q + inner, share1 * q + share * q1)
            }
            Support::Ellipse { half_axes, offset } => ellipse(half_axes, offset, theta),
        }
    }

    /// The support function [mm] and its derivative by the tangent angle.
    pub fn at(&self, theta: f64) -> [f64; 2] {
        let (q, slope) = self.series::<1>(theta);
        [q.value(), slope.value()]
    }

    /// Radius of curvature at a tangent angle [mm].
    pub fn radius(&self, theta: f64) -> f64 {
        let (q, slope) = self.series::<2>(theta);
        q.0[0] + slope.0[1]
    }

    fn length(&self, a: f64, b: f64) -> f64 {
        if let Support::Lens { inner, base_radius, order } = *self {
            let part = |th: f64| {
                let sum: f64 =
                    order.terms().iter().map(|(k, c)| c * (1.0 - k * k) / k * one_minus_cos(k * th)).sum();
                inner * th + base_radius * (0.5 * th * th + sum)
            };
            return part(b) - part(a);
        }
        // The speed is q + q'': only q needs quadrature.
        gauss(a, b, FRAC_PI_2, |th| self.at(th)[0]) + self.at(b)[1] - self.at(a)[1]
    }
}

impl From<Support> for SpiralLaw {
    fn from(support: Support) -> SpiralLaw {
        SpiralLaw::Support(support)
    }
}

impl SpiralLaw {
    /// The point as a series about the parameter `u` [mm].
    pub fn series<const N: usize>(&self, u: f64) -> [Taylor<N>; 2] {
        let (sin, cos) = Taylor::<N>::variable(u).sin_cos();
        match self {
            SpiralLaw::Support(support) => {
                let (q, slope) = support.series::<N>(u);
                [q * sin + slope * cos, slope * sin - q * cos]
            }
            SpiralLaw::Archimedes { growth } => {
                let radius = Taylor::<N>::variable(u).scaled(*growth);
                [radius * cos, radius * sin]
            }
            SpiralLaw::Trochoid { carrier, loop_radius, rate } => {
                let (fast_sin, fast_cos) = Taylor::<N>::variable(u).scaled(*rate).sin_cos();
                [
                    cos.scaled(*carrier) + fast_cos.scaled(*loop_radius),
                    sin.scaled(*carrier) + fast_sin.scaled(*loop_radius),
                ]
            }
        }
    }

    /// Tangent angle at a parameter, for growing parameters [rad]; continuous.
    pub fn tangent_angle(&self, u: f64) -> f64 {
        match *self {
            SpiralLaw::Support(_) => u,
            SpiralLaw::Archimedes { .. } => u + u.atan(),
            SpiralLaw::Trochoid { carrier, loop_radius, rate } => {
                let (fast, phase) = (loop_radius * rate, (rate - 1.0) * u);
                let base = u + FRAC_PI_2;
                if fast.abs() > carrier {
                    let v = DVec2::new(fast, 0.0) + DVec2::from_angle(-phase) * carrier;
                    base + phase + v.to_angle()
                } else {
                    let v = DVec2::new(carrier, 0.0) + DVec2::from_angle(phase) * fast;
                    base + v.to_angle()
                }
            }
        }
    }

    /// Speed: arc length by parameter [mm]; the radius of curvature of a support curve.
    pub fn speed(&self, u: f64) -> f64 {
        match *self {
            SpiralLaw::Support(support) => support.radius(u),
            SpiralLaw::Archimedes { growth } => growth * 1f64.hypot(u),
            SpiralLaw::Trochoid { carrier, loop_radius, rate } => {
                let fast = loop_radius * rate;
                let squared =
                    carrier * carrier + fast * fast + 2.0 * carrier * fast * ((rate - 1.0) * u).cos();
                squared.clamp(0.0, f64::INFINITY).sqrt()
            }
        }
    }

    /// A part of the parameter that is short: [`Self::short_length`] is exact to rounding on it, and the parameter nearly a
    /// cubic of the arc length.
    pub(super) fn short(&self) -> f64 {
        const SHORT: f64 = 0.06;
        match *self {
            SpiralLaw::Trochoid { rate, .. } => SHORT / (rate - 1.0).abs().max(1.0),
            _ => SHORT,
        }
    }

    /// Arc length on a short part from `a` to `b` [mm], negative when `b < a`.
    pub(super) fn short_length(&self, a: f64, b: f64) -> f64 {
        match self {
            SpiralLaw::Support(Support::Lens { .. }) | SpiralLaw::Archimedes { .. } => self.length(a, b),
            _ => gauss_short(a, b, |u| self.speed(u)),
        }
    }

    /// Arc length from parameter `a` to `b` [mm], negative when `b < a`. Closed forms where there are any,
    /// otherwise quadrature to rounding.
    pub fn length(&self, a: f64, b: f64) -> f64 {
        match *self {
            SpiralLaw::Support(support) => support.length(a, b),
            SpiralLaw::Archimedes { growth } => {
                let part = |u: f64| 0.5 * growth * (u * 1f64.hypot(u) + u.asinh());
                part(b) - part(a)
            }
            SpiralLaw::Trochoid { rate, .. } => {
                // A loop passes the near-cusp of its inner side: eight panels a loop follow it to rounding.
                let panel = PI / (4.0 * (rate - 1.0).abs().clamp(1.0, f64::INFINITY));
                gauss(a, b, panel, |u| self.speed(u))
            }
        }
    }
}
