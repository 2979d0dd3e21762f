//! Turns of support curves one around the other: exact engagement of a cutter on a turn against the wall that the turn
//! before has left, and the distance between them.
//!
//! The wall before is the parallel of the former turn at the cutter's radius `a`; its point with the normal at `phi`
//! is `X = (q + a) u + q' t`. The cutter about `p` meets it ahead where `|X - p| = a`: one root, in the half turn ahead
//! of `p`.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use crate::geom::Support;
use crate::num::root::bracketed_newton;

/// Support curves one after the other, each over whole turns; before the first, the circle on which it starts.
pub(super) struct Turns<'a> {
    /// Radius of the circle before the first turn [mm].
    pub inner: f64,
    /// Each curve with its turns; it starts at its parameter zero.
    pub parts: &'a [(Support, f64)],
}

/// Zero for a value that is small enough: a root is wanted to nanometres, not to the last bit.
fn unless_done(value: f64, size: f64) -> f64 {
    const ENOUGH: f64 = 1e-10;
    if value.abs() <= ENOUGH * size { 0.0 } else { value }
}

impl Turns<'_> {
    /// Support function, its derivative and the radius of curvature [mm] at the tangent angle `theta` from the start
    /// of the first curve [rad].
    fn at(&self, theta: f64) -> [f64; 3] {
        if theta <= 0.0 {
            return [self.inner, 0.0, self.inner];
        }
        let mut angle = theta;
        let mut jet = [self.inner, 0.0, self.inner];
        for (i, (support, turns)) in self.parts.iter().enumerate() {
            if angle <= turns * TAU || i + 1 == self.parts.len() {
                let (q, slope) = support.series::<2>(angle);
                jet = [q.0[0], slope.0[0], q.0[0] + slope.0[1]];
                break;
            }
            angle -= turns * TAU;
        }
        jet
    }

    /// Engagement [rad] of a cutter of radius `a` [mm] at a tangent angle [rad].
    pub(super) fn engagement(&self, a: f64, theta: f64) -> f64 {
        let frame = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            (DVec2::new(sin, -cos), DVec2::new(cos, sin))
        };
        let (u, t) = frame(theta);
        let [q, slope, _] = self.at(theta);
        let p = u * q + t * slope;
        let from_centre = |phi: f64| {
            let ([q, slope, radius], (u, t)) = (self.at(phi - TAU), frame(phi));
            (u * (q + a) + t * slope - p, t * (radius + a))
        };
        let distance = |phi: f64| {
            let (x, growth) = from_centre(phi);
            (unless_done(x.length_squared() - a * a, a * a), 2.0 * x.dot(growth))
        };
        /// Newton from a quarter turn ahead: six to ten.
        const STEPS: u32 = 60;
        let (phi, _) = bracketed_newton(distance, theta + 0.5, theta, theta + PI, STEPS);
        let (x, _) = from_centre(phi);
        x.dot(t).atan2(x.dot(u)).abs()
    }

    /// Distance [mm] of the curve at a tangent angle [rad] from the turn before.
    fn step(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let [q, slope, _] = self.at(theta);
        let p = DVec2::new(sin, -cos) * q + DVec2::new(cos, sin) * slope;
        let foot = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            let (u, t) = (DVec2::new(sin, -cos), DVec2::new(cos, sin));
            let [q, slope, radius] = self.at(phi - TAU);
            (unless_done(slope - p.dot(t), q), p.dot(u) - q + radius)
        };
        /// Newton from the same tangent angle: four to six.
        const STEPS: u32 = 60;
        let (phi, _) = bracketed_newton(foot, theta, theta - FRAC_PI_2, theta + FRAC_PI_2, STEPS);
        let (sin, cos) = phi.sin_cos();
        p.dot(DVec2::new(sin, -cos)) - self.at(phi - TAU)[0]
    }

    /// The largest distance of neighbouring turns [mm] between two tangent angles, at `count` places in each turn.
    pub(super) fn largest_step(&self, from: f64, to: f64, count: u32) -> f64 {
        let places = ((to - from) / TAU * f64::from(count)).ceil().max(1.0);
        (0..=places as u32).map(|i| self.step(from + (to - from) * f64::from(i) / places)).fold(0.0, f64::max)
    }

    /// The largest engagement [rad] between two tangent angles, at `count` places in each turn.
    pub(super) fn largest_engagement(&self, a: f64, from: f64, to: f64, count: u32) -> f64 {
        let places = ((to - from) / TAU * f64::from(count)).ceil().max(1.0);
        (0..=places as u32)
            .map(|i| self.engagement(a, from + (to - from) * f64::from(i) / places))
            .fold(0.0, f64::max)
    }
}
