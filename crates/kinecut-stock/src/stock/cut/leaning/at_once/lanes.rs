//! Swept parts side by side, the gauge of each at a place and a time of its own, without branches.

use super::bundle::Shape;
use super::near::SweptPart;

/// Parts that are asked at once.
pub(super) const LANES: usize = 8;

/// Numbers of a part: tip and axis as cubics, and what its way is bent by.
pub(super) const WAY: usize = 28;

/// Parts, number by number.
pub(super) type Ways = [[f64; LANES]; WAY];

/// Takes the place of what was in a lane.
pub(super) fn put(ways: &mut Ways, lane: usize, part: &SweptPart) {
    for (of, number) in ways.iter_mut().zip(&part.way) {
        of[lane] = *number;
    }
}

/// A vector by its coordinates. Those of a library are called, not inlined, in a body as long as this one, and that ends going through
/// all lanes at once.
pub(super) type Vector = [f64; 3];

#[inline(always)]
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The sum of a vector and a multiple of another.
#[inline(always)]
pub(super) fn along(a: Vector, b: Vector, way: f64) -> Vector {
    [a[0] + b[0] * way, a[1] + b[1] * way, a[2] + b[2] * way]
}

#[inline(always)]
pub(super) fn times(a: Vector, by: f64) -> Vector {
    [a[0] * by, a[1] * by, a[2] * by]
}

/// One of the parts.
#[derive(Clone, Copy)]
pub(super) struct Lane<'a> {
    pub(super) shape: Shape,
    pub(super) ways: &'a Ways,
    pub(super) lane: usize,
}

/// The gauge at a place at one time.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    pub(super) value: f64,
    pub(super) normal: Vector,
    /// Velocity of the tool there, and the rate of the gauge.
    pub(super) velocity: Vector,
    pub(super) rate: f64,
    /// The second derivative by the time of what the tangent plane says, see `SpanPoses::curved`.
    pub(super) second: f64,
    /// Most by which the gauge may be less than value and rate say, half of the time before and after, and all of it before or after;
    /// and what each millimetre beside adds to the latter. See `SpanPoses::nearer`.
    pub(super) half: f64,
    pub(super) whole: f64,
    pub(super) by_way: f64,
    /// Most that the tool turns [rad by the parameter].
    pub(super) turns: f64,
    /// The second derivative of the gauge: the squares of two vectors.
    pub(super) curves: [Vector; 2],
}

impl Lane<'_> {
    #[inline(always)]
    fn vector(&self, n: usize) -> Vector {
        [self.ways[n][self.lane], self.ways[n + 1][self.lane], self.ways[n + 2][self.lane]]
    }

    /// A cubic, whose coefficients begin at a number, and its rate.
    #[inline(always)]
    fn cubic(&self, n: usize, t: f64) -> [Vector; 2] {
        let [a, b, c, d] = [self.vector(n), self.vector(n + 3), self.vector(n + 6), self.vector(n + 9)];
        let value = along(a, along(b, along(c, d, t), t), t);
        let rate = along(b, along(along(c, c, 1.0), d, 3.0 * t), t);
        [value, rate]
    }

    #[inline(always)]
    pub(super) fn at(&self, place: Vector, t: f64) -> Seen {
        let ([tip, tip_rate], [axis, axis_rate]) = (self.cubic(0, t), self.cubic(12, t));
        let from = along(place, tip, -1.0);
        let height = dot(from, axis);
        let beside = along(from, axis, -height);
        let rho = dot(beside, beside).sqrt();
        let (value, radial, axial) = self.shape.gauge(rho, height);
        let near = if rho > 0.0 { 1.0 / rho } else { 0.0 };
        let out = times(beside, near);
        let normal = along(times(out, radial), axis, axial);
        let velocity = along(along(tip_rate, axis_rate, height), axis, -dot(from, axis_rate));
        let turn = cross(axis, axis_rate);
        let turned = cross(turn, normal);
        let second = dot(cross(turn, turned), from) - 2.0 * dot(turned, tip_rate);
        let [tip_bend, by_reach] = [self.ways[24][self.lane], self.ways[25][self.lane]];
        let [way, turns] = [self.ways[26][self.lane], self.ways[27][self.lane]];
        let far = dot(from, from).sqrt() + 2.0 * self.shape.side;
        let bend = tip_bend + by_reach * far;
        let third = turns * turns * (3.0 * way + turns * far) + 24.0 * by_reach * (way + turns * far);
        let closes = if second < 0.0 { -second } else { 0.0 };
        let by_way = 0.5 * turns * turns + 8.0 * by_reach + turns * (turns * turns + 24.0 * by_reach) / 6.0;
        let is_round = (radial > 0.0) & (axial < 0.0) & (self.shape.radius > 0.0);
        let along_section = if is_round { (1.0 / (self.shape.radius + value)).sqrt() } else { 0.0 };
        let curves = [
            times(along(times(axis, radial), out, -axial), along_section),
            times(cross(axis, out), (radial * near).sqrt()),
        ];
        Seen {
            value,
            normal,
            velocity,
            rate: -dot(normal, velocity),
            second,
            half: 0.125 * closes + 2.0 * bend + third / 48.0,
            whole: 0.5 * closes + 8.0 * bend + third / 6.0,
            by_way,
            turns,
            curves,
        }
    }
}
