//! Intervals of a piece of the chain with grazing points: the sign of a quadratic in its parameter.
//!
//! Of the normal velocity `A cos theta + B sin theta + C` the discriminant is `D = A^2 + B^2 - C^2`: two grazing points where it
//! is positive, none where it is negative, a fold at its roots. On a line it is a quadratic in the way along it, on an arc one
//! in the tangent of the normal angle, whose radius is not in it. Near its roots it is evaluated as a product: the sum loses
//! half of the digits.

use std::f64::consts::PI;

use glam::DVec2;

use super::normal_velocity::PieceVelocity;

/// Relative size of a difference that rounding explains: some hundred units in the last place of a product of two.
const NOTHING: f64 = 1e-13;
/// The same of a value that is a sum of squares.
const NOTHING_SQUARED: f64 = 1e-14;

/// Number and kind of the roots of a discriminant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Roots {
    /// It is zero everywhere.
    Zero,
    /// It has this sign everywhere: no root at all.
    None { positive: bool },
    /// It touches zero at this parameter, and has this sign elsewhere. (On arcs modulo pi.)
    Double { at: f64, positive: bool },
    /// It changes sign at these parameters, in order. (On arcs modulo pi.)
    Two([f64; 2]),
}

/// The discriminant of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Discriminant {
    velocity: PieceVelocity,
    pub(super) roots: Roots,
    /// Leading coefficient of a line, amplitude of an arc.
    leading: f64,
    line: bool,
}

impl Discriminant {
    pub(super) fn new(velocity: PieceVelocity, length: f64) -> Discriminant {
        let (roots, leading, line) = match velocity {
            PieceVelocity::Line { fixed, lever, mean } => {
                let (roots, leading) = on_line(fixed, lever, mean, length);
                (roots, leading, true)
            }
            PieceVelocity::Arc { centre, lever, axial } => {
                let (roots, leading) = on_arc(centre, lever, axial);
                (roots, leading, false)
            }
        };
        Discriminant { velocity, roots, leading, line }
    }

    /// Its value.
    pub(super) fn at(&self, u: f64) -> f64 {
        match (self.roots, self.line) {
            (Roots::Zero, _) => 0.0,
            (Roots::Two([a, b]), true) => self.leading * (u - a) * (u - b),
            (Roots::Two([a, b]), false) => self.leading * (u - a).sin() * (u - b).sin(),
            (Roots::Double { at, .. }, true) => self.leading * (u - at) * (u - at),
            (Roots::Double { at, .. }, false) => {
                let sin = (u - at).sin();
                self.leading * sin * sin
            }
            (Roots::None { .. }, _) => self.velocity.at(u).discriminant(),
        }
    }

    /// Its value at a small way `by` from a root `u`, without loss of digits.
    pub(super) fn beside(&self, u: f64, by: f64) -> f64 {
        match (self.roots, self.line) {
            (Roots::Two([a, b]), true) => {
                let other = if (u - a).abs() <= (u - b).abs() { b } else { a };
                self.leading * by * (u + by - other)
            }
            (Roots::Two([a, b]), false) => {
                // Roots repeat after half a turn, in which the sine changes sign.
                let nearer = (u - a).sin().abs() <= (u - b).sin().abs();
                let (own, other) = if nearer { (a, b) } else { (b, a) };
                let sign = (u - own).cos().signum();
                self.leading * sign * by.sin() * (u + by - other).sin()
            }
            _ => self.at(u + by),
        }
    }
}

fn on_line(fixed: DVec2, lever: DVec2, mean: f64, length: f64) -> (Roots, f64) {
    let (q2, q0) = (lever.length_squared(), fixed.length_squared() - mean * mean);
    let size = fixed.length().max(mean.abs());
    if lever.length() * length <= NOTHING_SQUARED * size || q2 == 0.0 {
        let roots = match q0.abs() <= NOTHING_SQUARED * size * size {
            true => Roots::Zero,
            false => Roots::None { positive: q0 > 0.0 },
        };
        return (roots, 0.0);
    }
    // The middle between the roots is where the amplitude is least; there it is all across the lever.
    let least = fixed.perp_dot(lever).abs() / q2.sqrt();
    let middle = -fixed.dot(lever) / q2;
    let (above, sum) = (mean.abs() - least, mean.abs() + least);
    let rounding = NOTHING * (mean.abs() + fixed.length());
    if above < -rounding {
        return (Roots::None { positive: true }, q2);
    }
    if above <= rounding {
        return (Roots::Double { at: middle, positive: true }, q2);
    }
    // Half of the distance between the roots.
    let half = (above * sum / q2).sqrt();
    (Roots::Two([middle - half, middle + half]), q2)
}

fn on_arc(centre: DVec2, lever: DVec2, axial: f64) -> (Roots, f64) {
    // D = pa cos^2 + 2 pb sin cos + pc sin^2.
    let pa = centre.length_squared();
    let pb = -centre.dot(lever);
    let (l, v) = (lever.length(), axial.abs());
    let pc = (l - v) * (l + v);
    let size = pa + l * l + v * v;
    let (mean, half) = (0.5 * (pa + pc), 0.5 * (pa - pc));
    let amplitude = half.hypot(pb);
    if amplitude <= NOTHING_SQUARED * size {
        let roots = match mean.abs() <= NOTHING_SQUARED * size {
            true => Roots::Zero,
            false => Roots::None { positive: mean > 0.0 },
        };
        return (roots, 0.0);
    }
    // pb^2 - pa pc as a product: the two terms are what the centre's velocity does along and across the axis.
    let along = pa.sqrt() * v;
    let across = centre.perp_dot(lever).abs();
    let product = (along - across) * (along + across);
    let rounding = NOTHING * (along + pa.sqrt() * l);
    if along - across < -rounding {
        return (Roots::None { positive: mean > 0.0 }, 0.0);
    }
    if along - across <= rounding {
        let delta = pb.atan2(half);
        let positive = mean > 0.0;
        let at = if positive { 0.5 * (delta + PI) } else { 0.5 * delta };
        return (Roots::Double { at, positive }, if positive { 2.0 } else { -2.0 } * amplitude);
    }
    let root = product.sqrt();
    let q = if pb >= 0.0 { -(pb + root) } else { root - pb };
    // tan phi = q / pc and pa / q.
    let (first, second) = (q.atan2(pc), pa.atan2(q));
    // D = -2 K sin(phi - f1) sin(phi - f2) up to the sign that the half turns of f1 and f2 bring: taken from D itself.
    let mut roots = [first.rem_euclid(PI), second.rem_euclid(PI)];
    roots.sort_by(f64::total_cmp);
    let between = 0.5 * (roots[0] + roots[1]);
    let (sin, cos) = between.sin_cos();
    let there = pa * cos * cos + 2.0 * pb * sin * cos + pc * sin * sin;
    let leading = if there > 0.0 { -2.0 * amplitude } else { 2.0 * amplitude };
    (Roots::Two(roots), leading)
}
