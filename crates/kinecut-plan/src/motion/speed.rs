//! Speed over a path, and the way over time.

use super::spline::{basis, lengths};
use super::{End, Moment};

/// The square `b` of the rate of a path's parameter: a spline between the cells at rest (`motion/spline.rs`).
///
/// In a cell the acceleration `b'/2` is linear in the way, so that the way over time is a hyperbolic or a circular
/// function: nothing is integrated step by step.
#[derive(Clone, Debug)]
pub struct Speed {
    /// Where the path leaves its rest, and where it comes to rest; an end without rest is a knot [mm].
    stops: [f64; 2],
    knots: Vec<f64>,
    coefficients: Vec<f64>,
    /// Moment of each knot [s].
    moments: Vec<f64>,
    duration: f64,
}

impl Speed {
    pub(super) fn new(stops: [f64; 2], knots: &[f64], coefficients: &[f64]) -> Speed {
        let mut speed = Speed {
            stops,
            knots: knots.to_vec(),
            coefficients: coefficients.to_vec(),
            moments: Vec::with_capacity(knots.len()),
            duration: 0.0,
        };
        let [first, last] = speed.rests();
        let n = speed.cells();
        let at_rest = |h: f64, c: f64| if h > 0.0 { 3.0 * h / c.sqrt() } else { 0.0 };
        let mut time = at_rest(first, coefficients[0]);
        speed.moments.push(time);
        for k in 0..n {
            time += speed.time_to(k, knots[k + 1] - knots[k]);
            speed.moments.push(time);
        }
        speed.duration = time + at_rest(last, coefficients[n + 1]);
        speed
    }

    /// Lengths of the cells at rest [mm].
    fn rests(&self) -> [f64; 2] {
        [self.knots[0] - self.stops[0], self.stops[1] - self.knots[self.cells()]]
    }

    /// Cells between those at rest.
    pub(super) fn cells(&self) -> usize {
        self.knots.len() - 1
    }

    /// The same way in this many times the time.
    pub(super) fn slower(&self, factor: f64) -> Speed {
        let coefficients: Vec<f64> = self.coefficients.iter().map(|c| c / (factor * factor)).collect();
        Speed::new(self.stops, &self.knots, &coefficients)
    }

    /// The same way with the time of each cell about this many times as long.
    pub(super) fn slower_by(&self, factors: &[f64]) -> Speed {
        let n = self.cells();
        let mut coefficients = self.coefficients.clone();
        for (i, c) in coefficients.iter_mut().enumerate() {
            // A coefficient counts most in the middle of its cell; those at the ends follow their neighbours.
            let factor = factors[i.clamp(1, n) - 1];
            *c /= factor * factor;
        }
        Speed::new(self.stops, &self.knots, &coefficients)
    }

    /// The same way in this many times the time, but for the last `way` [mm] to ends that are no rests: there it goes over into
    /// the speed that it has.
    pub(super) fn slower_inside(&self, factor: f64, ends: [End; 2], way: f64) -> Speed {
        let n = self.cells();
        let least = 1.0 / (factor * factor);
        let mut coefficients = self.coefficients.clone();
        for (i, c) in coefficients.iter_mut().enumerate() {
            // A coefficient counts most in the middle of its cell; those at the ends follow their neighbours.
            let k = i.clamp(1, n) - 1;
            let s = 0.5 * (self.knots[k] + self.knots[k + 1]);
            let mut slower = 1.0_f64;
            for (end, distance) in ends.into_iter().zip([s - self.stops[0], self.stops[1] - s]) {
                if end == End::Even {
                    let u = (distance / way).clamp(0.0, 1.0);
                    slower *= u * u * u * (10.0 - u * (15.0 - 6.0 * u));
                }
            }
            *c *= 1.0 - (1.0 - least) * slower;
        }
        Speed::new(self.stops, &self.knots, &coefficients)
    }

    /// Time from rest to rest [s].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Length of the parameter [mm].
    pub fn length(&self) -> f64 {
        self.stops[1] - self.stops[0]
    }

    /// Places where the pieces of the spline meet [mm].
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// `b`, `b'` and `b''` in cell `k` at a distance `u` from its left knot.
    fn cell(&self, k: usize, u: f64) -> [f64; 3] {
        let c = [self.coefficients[k], self.coefficients[k + 1], self.coefficients[k + 2]];
        basis(lengths(&self.knots, k), u).map(|row| row[0] * c[0] + row[1] * c[1] + row[2] * c[2])
    }

    /// Time from the left knot of cell `k` to a distance `u` from it [s].
    ///
    /// The rate `v` of the parameter obeys `dv/dt = b'/2`, linear in `s` with the slope `w = b''/2`. Seen from the middle of
    /// the time, `v0 + v1 = 2 v cosh(r t/2)` and `u = 2 v sinh(r t/2) / r` with `r = sqrt w`: so
    /// `tanh(r t/2) = r u / (v0 + v1)`.
    fn time_to(&self, k: usize, u: f64) -> f64 {
        let ([b0, _, e], [b1, ..]) = (self.cell(k, 0.0), self.cell(k, u));
        let mean = 2.0 * u / (b0.sqrt() + b1.sqrt());
        mean * arc(0.125 * e * mean * mean)
    }

    /// Calls with place [mm] and `b`, `b'`, `b''` at `count` places of cell `k`, the first and the last beside the knots.
    pub(super) fn in_cell(&self, k: usize, count: usize, beside: f64, mut f: impl FnMut(f64, [f64; 3])) {
        let h = self.knots[k + 1] - self.knots[k];
        let [b, b1, b2] = self.cell(k, 0.0);
        for i in 0..count {
            let part = (i as f64 / (count - 1) as f64).clamp(beside, 1.0 - beside);
            let u = part * h;
            f(self.knots[k] + u, [b + u * (b1 + 0.5 * u * b2), b1 + u * b2, b2]);
        }
    }

    /// The same in the cells at rest.
    pub(super) fn at_rest(&self, count: usize, mut f: impl FnMut(f64, [f64; 3])) {
        let [first, last] = self.rests();
        for part in (1..=count).map(|i| i as f64 / count as f64) {
            if first > 0.0 {
                f(self.stops[0] + part * first, self.leaving(part));
            }
            if last > 0.0 {
                f(self.stops[1] - part * last, self.stopping(part));
            }
        }
    }

    /// `b`, `b'` and `b''` at a part of the first cell at rest.
    fn leaving(&self, part: f64) -> [f64; 3] {
        rest(part, self.rests()[0], self.coefficients[0])
    }

    /// The same at a part of the last one, from the stop.
    fn stopping(&self, part: f64) -> [f64; 3] {
        let [b, b1, b2] = rest(part, self.rests()[1], self.coefficients[self.cells() + 1]);
        [b, -b1, b2]
    }

    /// `b`, `b'` and `b''` at a place [mm]: the square of the rate of the parameter and its derivatives by it.
    pub fn square(&self, s: f64) -> [f64; 3] {
        let n = self.cells();
        let [first, last] = self.rests();
        if s < self.knots[0] {
            return self.leaving(((s - self.stops[0]) / first).max(0.0));
        }
        if s > self.knots[n] {
            return self.stopping(((self.stops[1] - s) / last).max(0.0));
        }
        let k = self.knots.partition_point(|t| *t <= s).clamp(1, n) - 1;
        self.cell(k, s - self.knots[k])
    }

    /// Rate of the parameter at the end [mm/s]: zero where the run comes to rest.
    pub(super) fn last(&self) -> f64 {
        if self.rests()[1] > 0.0 { 0.0 } else { self.square(self.stops[1])[0].sqrt() }
    }

    /// Rate of the parameter at the start [mm/s].
    pub(super) fn first(&self) -> f64 {
        if self.rests()[0] > 0.0 { 0.0 } else { self.square(self.stops[0])[0].sqrt() }
    }

    /// Place [mm] at a moment [s] after the start.
    pub fn place(&self, time: f64) -> f64 {
        let n = self.cells();
        let [first, last] = self.rests();
        if time <= self.moments[0] {
            if first == 0.0 {
                return self.stops[0];
            }
            let part = (time / self.moments[0]).max(0.0);
            return self.stops[0] + first * part.powi(3);
        }
        if time >= self.moments[n] {
            if last == 0.0 {
                return self.stops[1];
            }
            let part = ((self.duration - time) / (self.duration - self.moments[n])).max(0.0);
            return self.stops[1] - last * part.powi(3);
        }
        let k = self.moments.partition_point(|t| *t <= time).clamp(1, n) - 1;
        let t = time - self.moments[k];
        let [b, d, e] = self.cell(k, 0.0);
        let (sine, cosine) = waves(0.5 * e * t * t);
        self.knots[k] + b.sqrt() * t * sine + 0.5 * d * t * t * cosine
    }

    /// Motion of the parameter at a moment [s] after the start; its way is the place [mm].
    pub fn at(&self, time: f64) -> Moment {
        let [first, last] = self.rests();
        if first > 0.0 && time <= self.moments[0] {
            let at = from_rest(first, self.moments[0], time);
            return Moment { way: self.stops[0] + at.way, ..at };
        }
        let left = self.duration - time;
        let last_moment = self.moments[self.cells()];
        if last > 0.0 && time >= last_moment {
            let at = from_rest(last, self.duration - last_moment, left);
            return Moment { way: self.stops[1] - at.way, acceleration: -at.acceleration, ..at };
        }
        let way = self.place(time);
        let [b, b1, b2] = self.square(way);
        let velocity = b.max(0.0).sqrt();
        Moment { way, velocity, acceleration: 0.5 * b1, jerk: 0.5 * velocity * b2 }
    }

    /// Moment [s] at which the path reaches a place [mm].
    pub fn moment(&self, s: f64) -> f64 {
        let n = self.cells();
        let [first, last] = self.rests();
        if s <= self.knots[0] {
            if first == 0.0 {
                return 0.0;
            }
            return self.moments[0] * ((s - self.stops[0]).max(0.0) / first).cbrt();
        }
        if s >= self.knots[n] {
            if last == 0.0 {
                return self.duration;
            }
            let part = (self.stops[1] - s).max(0.0) / last;
            return self.duration - (self.duration - self.moments[n]) * part.cbrt();
        }
        let k = self.knots.partition_point(|t| *t <= s).clamp(1, n) - 1;
        self.moments[k] + self.time_to(k, s - self.knots[k])
    }
}

/// Motion in a cell at rest of length `h` that takes a time: its jerk is constant.
fn from_rest(h: f64, duration: f64, time: f64) -> Moment {
    let part = (time / duration).max(0.0);
    let rate = h / duration;
    Moment {
        way: h * part.powi(3),
        velocity: 3.0 * rate * part * part,
        acceleration: 6.0 * rate / duration * part,
        jerk: 6.0 * rate / (duration * duration),
    }
}

/// `b`, `b'` and `b''` at a part of a cell at rest of length `h` whose end has the square `c`.
fn rest(part: f64, h: f64, c: f64) -> [f64; 3] {
    let third = part.cbrt();
    [c * third.powi(4), 4.0 / 3.0 * c / h * third, 4.0 / 9.0 * c / (h * h) / (third * third)]
}

/// `artanh(sqrt x) / sqrt x`, and `arctan(sqrt -x) / sqrt -x` where `x` is negative.
fn arc(x: f64) -> f64 {
    if x.abs() < 1e-3 {
        return 1.0 + x * (1.0 / 3.0 + x * (0.2 + x * (1.0 / 7.0 + x * (1.0 / 9.0 + x / 11.0))));
    }
    let root = x.abs().sqrt();
    if x > 0.0 { root.atanh() / root } else { root.atan() / root }
}

/// `sinh(r)/r` and `(cosh(r) - 1)/r^2` with `r = sqrt z`; those of the circle where `z` is negative.
fn waves(z: f64) -> (f64, f64) {
    if z.abs() < 1e-3 {
        let sine = 1.0 + z / 6.0 * (1.0 + z / 20.0 * (1.0 + z / 42.0 * (1.0 + z / 72.0)));
        let cosine = 0.5 * (1.0 + z / 12.0 * (1.0 + z / 30.0 * (1.0 + z / 56.0 * (1.0 + z / 90.0))));
        return (sine, cosine);
    }
    let r = z.abs().sqrt();
    // 1 - cos r = 2 sin^2(r/2), without cancellation.
    if z > 0.0 {
        (r.sinh() / r, 2.0 * (0.5 * r).sinh().powi(2) / (r * r))
    } else {
        (r.sin() / r, 2.0 * (0.5 * r).sin().powi(2) / (r * r))
    }
}
