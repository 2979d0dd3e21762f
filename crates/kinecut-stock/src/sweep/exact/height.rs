//! The height that a tool of fixed axis leaves over a point, for lines, arcs and helices of the tip.
//!
//! Over a point the tip's station `s` gives the height `z(s) + h(rho(s))`. The least one is at an end of the move, where a piece of
//! the underside begins or ends, or where the derivative is zero: on cones and spheres a quadratic, on a torus along a line the
//! root of a monotone function, on a torus along a helix all sign changes of the derivative. All these stations are tried, so
//! that the profile need not be convex.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::lower::{LowerPiece, LowerProfile, LowerShape};
use crate::geom::{Arc, Line};
use crate::num::root::bracketed_newton;

/// Evaluations of a bracketed root.
const LIMIT: u32 = 100;
/// Parts in which signs of a derivative are looked for, where no closed form is known: its waves are those of a few sines.
const PARTS: u32 = 24;
/// Length below which a move goes straight down [mm].
const NO_WAY: f64 = 1e-12;
/// Part of a length or angle that is rounding.
const ROUNDING: f64 = 1e-13;
/// Largest lean of an arc's axis from Z: rounding.
const UPRIGHT: f64 = 1e-9;

/// The least of the heights tried.
struct Least(Option<f64>);

impl Least {
    fn take(&mut self, height: f64) {
        if height.is_finite() && self.0.is_none_or(|least| height < least) {
            self.0 = Some(height);
        }
    }
}

impl LowerProfile {
    /// Height of the underside over a radius with the tip at 0 [mm]; `None` outside the tool.
    pub fn height(&self, rho: f64) -> Option<f64> {
        let mut least = Least(None);
        for piece in self.pieces().iter().filter(|p| rho >= p.from && rho <= p.to) {
            least.take(piece.height(rho));
        }
        least.0
    }

    /// Height that is left over a point when the tip goes along a line; none where the tool does not come.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::{DVec2, DVec3};
    /// use kinecut::geom::Line;
    /// use kinecut::sweep::LowerProfile;
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let ball = Contour::new(vec![
    ///     ContourElement::arc([0.0, 5.0], 5.0, -std::f64::consts::FRAC_PI_2, 0.0, ElementRole::Cutting),
    ///     ContourElement::line([5.0, 5.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ]);
    /// let line = Line { start: DVec3::ZERO, end: DVec3::new(40.0, 0.0, 30.0) };
    /// let z = LowerProfile::new(&ball.unwrap()).over_line(&line, DVec2::new(20.0, 0.0)).unwrap();
    /// assert!((z - (15.0 + 5.0 - 5.0 * 1.25)).abs() < 1e-14); // R sqrt(1 + k^2) under the centre
    /// ```
    pub fn over_line(&self, line: &Line, at: DVec2) -> Option<f64> {
        let (way, rise) = ((line.end - line.start).truncate(), line.end.z - line.start.z);
        let from = at - line.start.truncate();
        let length = way.length();
        let mut least = Least(None);
        if length < NO_WAY {
            least.take(self.height(from.length())? + line.start.z.min(line.end.z));
            return least.0;
        }
        let (along, slope) = (way / length, rise / length);
        let (tau, side) = (from.dot(along), from.perp_dot(along).abs());
        for piece in self.pieces().iter().filter(|p| side <= p.to) {
            let ends = [(piece.to - side) * (piece.to + side), (piece.from - side) * (piece.from + side)]
                .map(|square| square.max(0.0).sqrt());
            let mut take = |offset: f64| {
                let s = tau + offset;
                let rho = side.hypot(offset).clamp(piece.from, piece.to);
                let slack = ROUNDING * (length + tau.abs());
                if s >= -slack && s <= length + slack {
                    least.take(line.start.z + slope * s.clamp(0.0, length) + piece.height(rho));
                }
            };
            // The lowest station lies on the side to which the move falls.
            let sense = if slope > 0.0 { -1.0 } else { 1.0 };
            for end in ends {
                take(end);
                take(-end);
            }
            for y in stationary_on_line(piece, side, slope.abs()).into_iter().flatten() {
                if y <= ends[0] && y >= ends[1] {
                    take(sense * y);
                }
            }
            // The ends of the move, if the piece is over the point there.
            for offset in [-tau, length - tau] {
                let rho = side.hypot(offset);
                if rho >= piece.from && rho <= piece.to {
                    take(offset);
                }
            }
        }
        least.0
    }

    /// Height that is left over a point when the tip goes along an arc or helix about an axis along Z; none where the tool does
    /// not come, and for arcs about other axes.
    pub fn over_arc(&self, arc: &Arc, at: DVec2) -> Option<f64> {
        if arc.axis.truncate().length() > UPRIGHT {
            return None;
        }
        let sense = arc.axis.z.signum();
        let radial = (arc.start - arc.centre).truncate();
        let from = at - arc.centre.truncate();
        let (radius, far) = (radial.length(), from.length());
        // Angles from the start in the sense of the sweep; the rise goes along the axis.
        let turn = if arc.sweep < 0.0 { -sense } else { sense };
        let sweep = arc.sweep.abs();
        let slope = if sweep > 0.0 { arc.rise * sense / sweep } else { 0.0 };
        let nearest = turn * radial.perp_dot(from).atan2(radial.dot(from));
        let mut least = Least(None);
        let product = radius * far;
        let rho = |delta: f64| {
            let half = (0.5 * delta).sin();
            ((radius - far) * (radius - far) + 4.0 * product * half * half).sqrt()
        };
        let first = ((-PI - nearest) / TAU).floor();
        let last = ((sweep + PI - nearest) / TAU).ceil();
        for piece in self.pieces() {
            let place = Bend { piece, radius, far, product, slope: slope.abs() };
            let mut offsets = vec![0.0];
            for limit in [piece.from, piece.to] {
                let cos = (radius * radius + far * far - limit * limit) / (2.0 * product);
                offsets.extend((cos.abs() <= 1.0).then(|| cos.acos()));
            }
            offsets.extend(place.stationary());
            let mut k = first;
            while k <= last {
                let centre = nearest + TAU * k;
                let mut take = |delta: f64| {
                    let angle = centre + delta;
                    let rho = rho(delta);
                    // Limits of the piece and ends of the move are met but for rounding.
                    let slack = ROUNDING * (radius + far);
                    let about = ROUNDING * (sweep + PI);
                    if angle >= -about
                        && angle <= sweep + about
                        && rho >= piece.from - slack
                        && rho <= piece.to + slack
                    {
                        least.take(
                            arc.start.z + slope * angle + piece.height(rho.clamp(piece.from, piece.to)),
                        );
                    }
                };
                for &delta in &offsets {
                    take(delta);
                    take(-delta);
                }
                for end in [-centre, sweep - centre] {
                    if end.abs() <= PI {
                        take(end);
                    }
                }
                k += 1.0;
            }
        }
        least.0
    }
}

/// Distances along the track from the point, at which a piece is lowest on a line of this slope.
fn stationary_on_line(piece: &LowerPiece, side: f64, slope: f64) -> [Option<f64>; 1] {
    let found = match piece.shape {
        LowerShape::Cone { slope: cone, .. } => {
            // cone y / rho = slope
            let square = (cone - slope) * (cone + slope);
            (cone > 0.0 && square > 0.0).then(|| slope * side / square.sqrt())
        }
        LowerShape::Arc { centre, radius } if radius > 0.0 => {
            let (d, k2) = (centre.x, slope * slope);
            let sine = if d == 0.0 {
                ((side * side / (radius * radius) + k2) / (1.0 + k2)).sqrt()
            } else {
                // (d + r S)^2 ((1 + k^2) - k^2 / S^2) = side^2 grows with S where the radius is positive.
                let low = (slope / (1.0 + k2).sqrt()).max(-d / radius);
                let f = |s: f64| {
                    let (rho, rest) = (d + radius * s, (1.0 + k2) - k2 / (s * s));
                    let value = rho * rho * rest - side * side;
                    (value, 2.0 * radius * rho * rest + 2.0 * rho * rho * k2 / (s * s * s))
                };
                if low >= 1.0 {
                    return [None];
                }
                bracketed_newton(f, 1.0, low.max(f64::MIN_POSITIVE), 1.0, LIMIT).0
            };
            let rho = d + radius * sine.min(1.0);
            let square = (rho - side) * (rho + side);
            (square >= 0.0).then(|| square.sqrt())
        }
        // A hollow arc falls to its ends.
        LowerShape::Arc { .. } => None,
    };
    [found]
}

/// A piece of the underside while the tip goes round an axis.
struct Bend<'a> {
    piece: &'a LowerPiece,
    radius: f64,
    far: f64,
    /// Product of the two.
    product: f64,
    /// Rise by angle, without its sign.
    slope: f64,
}

impl Bend<'_> {
    /// Angles from the nearest station at which the height may be stationary; either sign is to be tried.
    fn stationary(&self) -> Vec<f64> {
        let (g, k2) = (self.product, self.slope * self.slope);
        let apart = self.radius * self.radius + self.far * self.far;
        match self.piece.shape {
            // c^2 g^2 (1 - x^2) = k^2 (apart - 2 g x)
            LowerShape::Cone { slope, .. } => {
                let c2 = slope * slope * g * g;
                cosines(c2, -2.0 * k2 * g, k2 * apart - c2)
            }
            LowerShape::Arc { centre, radius } if centre.x == 0.0 => {
                // g^2 (1 - x^2) = k^2 (r^2 - apart + 2 g x)
                cosines(g * g, 2.0 * g * k2, k2 * (radius * radius - apart) - g * g)
            }
            LowerShape::Arc { .. } => self.searched(),
        }
    }

    /// The derivative by the angle, for a move that falls.
    fn derivative(&self, delta: f64) -> f64 {
        let half = (0.5 * delta).sin();
        let rho =
            ((self.radius - self.far) * (self.radius - self.far) + 4.0 * self.product * half * half).sqrt();
        let inside = rho.clamp(self.piece.from, self.piece.to);
        self.piece.slope(inside) * self.product * delta.sin() / rho - self.slope
    }

    /// All sign changes of the derivative found between the limits of the piece.
    fn searched(&self) -> Vec<f64> {
        let limit = |rho: f64| {
            let cos = (self.radius * self.radius + self.far * self.far - rho * rho) / (2.0 * self.product);
            cos.clamp(-1.0, 1.0).acos()
        };
        let (low, high) = (limit(self.piece.from), limit(self.piece.to));
        let mut found = Vec::new();
        let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(PARTS);
        for k in 0..PARTS {
            let (a, b) = (at(k), at(k + 1));
            let (fa, fb) = (self.derivative(a), self.derivative(b));
            if (fa < 0.0) != (fb < 0.0) {
                let sense = if fa < 0.0 { 1.0 } else { -1.0 };
                // Without a slope it is halved: the derivative is infinite at the end of an arc.
                let f = |delta: f64| (sense * self.derivative(delta), 0.0);
                found.push(bracketed_newton(f, 0.5 * (a + b), a, b, LIMIT).0);
            }
        }
        found
    }
}

/// Angles whose cosines solve `a x^2 + b x + c = 0`.
fn cosines(a: f64, b: f64, c: f64) -> Vec<f64> {
    let square = b * b - 4.0 * a * c;
    if a == 0.0 || square < 0.0 {
        return Vec::new();
    }
    let q = -0.5 * (b + square.sqrt().copysign(if b == 0.0 { 1.0 } else { b }));
    [q / a, c / q].into_iter().filter(|x| x.abs() <= 1.0).map(f64::acos).collect()
}
