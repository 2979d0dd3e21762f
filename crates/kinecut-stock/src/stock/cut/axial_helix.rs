//! The lowest reach of a tool part on a helix, over a point.
//!
//! With the path radius P, the point at the distance Q from the helix axis and x the angle from its direction
//! downhill, f(x) = -k x + h(rho(x)), rho^2 = P^2 + Q^2 - 2 P Q cos x, k > 0 the fall per radian. It is not convex:
//! besides the ends of the range all its stationary points are looked at. With G = P Q and c = cos x they are
//!
//! * cone (slope m): m^2 G^2 (1 - c^2) = k^2 (P^2 + Q^2 - 2 G c);
//! * ball (radius r): G^2 (1 - c^2) = k^2 (r^2 - P^2 - Q^2 + 2 G c);
//! * torus: a sextic; its derivative is looked at in steps and each minimum found by bracketed Newton.

use glam::DVec2;

use super::body::{ConvexPart, Foot, Touch};
use super::plan::ArcPlan;
use crate::num::root::bracketed_newton;
use std::f64::consts::{PI, TAU};

/// Steps in which a torus' derivative is looked at over its range of at most half a turn: two minima nearer than
/// 11 degrees count as one.
const STEPS: u32 = 16;

/// Halvings of half a turn down to rounding.
const LIMIT: u32 = 60;

/// Fraction of the path of the lowest reach over `q`, within a window of fractions.
pub(super) fn lowest_on_helix(
    part: &ConvexPart,
    arc: &ArcPlan,
    rise: f64,
    q: DVec2,
    window: (f64, f64),
) -> (f64, Touch) {
    let v = q - arc.centre;
    let (p, far, whole) = (arc.radius, v.length(), arc.sweep.abs());
    let (g, squares) = (p * far, p * p + far * far);
    let k = rise.abs() / whole;
    let down = -1f64.copysign(rise);
    let (from, to) = (window.0 * whole, window.1 * whole);
    let middle = if far > 0.0 { arc.progress(v) } else { 0.0 };
    let middle = middle + TAU * ((0.5 * (from + to) - middle) / TAU).round();
    // Range of x.
    let (a, b) = if down > 0.0 { (from - middle, to - middle) } else { (middle - to, middle - from) };
    let rho = |x: f64| (squares - 2.0 * g * x.cos()).clamp(0.0, f64::INFINITY).sqrt();
    let value = |x: f64| part.height(rho(x).clamp(0.0, part.r1)) - k * x;
    let near = 0f64.clamp(a, b);
    let mut best = (b, value(b), None);
    let mut look = |x: f64, touch: Option<Touch>| {
        if x >= near && x <= b {
            let f = value(x);
            if f < best.1 {
                best = (x, f, touch);
            }
        }
    };
    look(near, None);
    let mut at_cosine = |c: f64, touch: Touch| {
        if c.abs() <= 1.0 {
            look(c.acos(), Some(touch));
        }
    };
    if g > 0.0 && part.r0 > 0.0 && part.has_edge() {
        at_cosine((squares - part.r0 * part.r0) / (2.0 * g), Touch::Edge);
    }
    match part.foot {
        _ if g == 0.0 => {}
        Foot::Flat => {}
        Foot::Cone { rise: m } => {
            // m^2 G^2 c^2 - 2 k^2 G c + k^2 (P^2 + Q^2) - m^2 G^2 = 0
            for c in quadratic(m * m * g * g, -2.0 * k * k * g, k * k * squares - m * m * g * g) {
                at_cosine(c, Touch::Foot);
            }
        }
        Foot::Torus { centre_radius: 0.0, radius, .. } => {
            let free = radius * radius - squares;
            for c in quadratic(g * g, 2.0 * k * k * g, k * k * free - g * g) {
                at_cosine(c, Touch::Foot);
            }
        }
        Foot::Torus { centre_radius, radius, .. } => {
            let slope = |x: f64| {
                let (sin, cos) = x.sin_cos();
                let rho = rho(x).clamp(f64::MIN_POSITIVE, f64::INFINITY);
                let u = (rho - centre_radius).clamp(0.0, radius);
                // The torus is vertical at u = radius; kept a hair off so that slopes stay finite.
                let m2 = ((radius - u) * (radius + u)).clamp(1e-18 * radius * radius, f64::INFINITY);
                let m = m2.sqrt();
                let (d1, h1) = (g * sin / rho, u / m);
                let d2 = (g * cos - d1 * d1) / rho;
                let h2 = if u > 0.0 { radius * radius / (m2 * m) } else { 0.0 };
                (h1 * d1 - k, h2 * d1 * d1 + h1 * d2)
            };
            let end = b.clamp(near, near.clamp(PI, f64::INFINITY));
            let node = |i: u32| near + (end - near) * f64::from(i) / f64::from(STEPS);
            for i in 0..STEPS {
                let (l, r) = (node(i), node(i + 1));
                if slope(l).0 < 0.0 && slope(r).0 > 0.0 {
                    look(bracketed_newton(slope, 0.5 * (l + r), l, r, LIMIT).0, Some(Touch::Foot));
                }
            }
        }
    }
    let (x, _, touch) = best;
    let t = ((middle + down * x) / whole).clamp(window.0, window.1);
    let on_path = t > 0.0 && t < 1.0;
    let touch = touch.unwrap_or(match rho(x) {
        _ if on_path && x == b => Touch::Edge,
        r if r <= part.r0 => Touch::Disc,
        _ => Touch::Foot,
    });
    (t, touch)
}

/// The real roots of a c^2 + b c + q = 0, a > 0, without cancellation.
fn quadratic(a: f64, b: f64, q: f64) -> [f64; 2] {
    let root = (b * b - 4.0 * a * q).sqrt();
    if root.is_nan() {
        return [f64::NAN; 2];
    }
    let s = -0.5 * (b + root.copysign(b));
    if s == 0.0 { [0.0; 2] } else { [s / a, q / s] }
}
