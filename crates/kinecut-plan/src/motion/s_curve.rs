//! The fastest move of one length from rest to rest: seven phases in closed form.

use super::AxisLimit;

/// A straight move from rest to rest in the least time: jerk, acceleration, jerk, speed, and the mirror image.
///
/// The optimum for one coordinate under limits of speed, acceleration and jerk; with an infinite jerk the trapezoid.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::motion::{AxisLimit, SCurve};
/// let limit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };
/// // 1000 mm: 2 s at 500 mm/s; each ramp takes 0.2 s, half of it lost.
/// assert!((SCurve::new(1000.0, limit).duration() - 2.2).abs() < 1e-12);
/// // 0.1 mm: jerk only, four phases of (L / 2J)^(1/3).
/// assert!((SCurve::new(0.1, limit).duration() - 4.0 * 1e-6_f64.cbrt()).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SCurve {
    length: f64,
    jerk: f64,
    /// Time of a phase of jerk, of constant acceleration, of constant speed [s].
    phases: [f64; 3],
    /// Largest acceleration and speed.
    peaks: [f64; 2],
}

/// Motion of one coordinate at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Way from the start [mm or rad].
    pub way: f64,
    /// Speed.
    pub velocity: f64,
    /// Acceleration.
    pub acceleration: f64,
    /// Jerk.
    pub jerk: f64,
}

impl Moment {
    /// The same place on the way of a motion that is `factor` times as slow.
    pub(super) fn slower(self, factor: f64) -> Moment {
        Moment {
            way: self.way,
            velocity: self.velocity / factor,
            acceleration: self.acceleration / factor.powi(2),
            jerk: self.jerk / factor.powi(3),
        }
    }
}

impl SCurve {
    /// The move of this length [mm or rad], not negative; the limits are positive ([`AxisLimit::check`]).
    pub fn new(length: f64, limit: AxisLimit) -> SCurve {
        let AxisLimit { velocity: v, acceleration: a, jerk: j } = limit;
        if length <= 0.0 {
            return SCurve { length: 0.0, jerk: j, phases: [0.0; 3], peaks: [0.0; 2] };
        }
        if j.is_infinite() {
            let peak = v.min((a * length).sqrt());
            let phases = [0.0, peak / a, (length - peak * peak / a).max(0.0) / peak];
            return SCurve { length, jerk: j, phases, peaks: [a, peak] };
        }
        // Phases of a ramp to a speed: those of jerk, and the one of constant acceleration.
        let ramp = |v: f64| if v * j < a * a { [(v / j).sqrt(), 0.0] } else { [a / j, v / a - a / j] };
        let way = |v: f64| v * 0.5 * (2.0 * ramp(v)[0] + ramp(v)[1]);
        let (peak, cruise) = if 2.0 * way(v) <= length {
            (v, (length - 2.0 * way(v)) / v)
        } else if length <= 2.0 * a * a * a / (j * j) {
            let t = (0.5 * length / j).cbrt();
            (j * t * t, 0.0)
        } else {
            let b = a * a / j;
            // The positive root of v^2 + b v = a L, without cancellation.
            (2.0 * a * length / (b + (b * b + 4.0 * a * length).sqrt()), 0.0)
        };
        let [jerking, steady] = ramp(peak);
        SCurve { length, jerk: j, phases: [jerking, steady, cruise], peaks: [j * jerking, peak] }
    }

    /// Time [s].
    pub fn duration(&self) -> f64 {
        let [jerking, steady, cruise] = self.phases;
        4.0 * jerking + 2.0 * steady + cruise
    }

    /// Largest speed that it reaches [mm/s or rad/s].
    pub fn peak(&self) -> f64 {
        self.peaks[1]
    }

    /// The motion at a moment `time` [s] after the start; at rest before and after.
    pub fn at(&self, time: f64) -> Moment {
        let total = self.duration();
        if time <= 0.0 || time >= total {
            let way = if time <= 0.0 { 0.0 } else { self.length };
            return Moment { way, velocity: 0.0, acceleration: 0.0, jerk: 0.0 };
        }
        // The second half is the first one, seen from the end.
        if time > 0.5 * total {
            let back = self.first_half(total - time);
            return Moment {
                way: self.length - back.way,
                velocity: back.velocity,
                acceleration: -back.acceleration,
                jerk: back.jerk,
            };
        }
        self.first_half(time)
    }

    /// Moment [s] at which it is at a way from the start [mm or rad].
    pub fn moment(&self, way: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.duration());
        if way <= 0.0 || way >= self.length {
            return if way <= 0.0 { low } else { high };
        }
        // The way grows with time: halving ends when nothing lies between.
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return middle;
            }
            if self.at(middle).way < way {
                low = middle;
            } else {
                high = middle;
            }
        }
    }

    fn first_half(&self, time: f64) -> Moment {
        let [jerking, steady, _] = self.phases;
        let j = if self.jerk.is_finite() { self.jerk } else { 0.0 };
        let mut at = Moment { way: 0.0, velocity: 0.0, acceleration: 0.0, jerk: 0.0 };
        let mut left = time;
        if !self.jerk.is_finite() {
            at.acceleration = self.peaks[0];
        }
        for (long, jerk) in [(jerking, j), (steady, 0.0), (jerking, -j), (f64::INFINITY, 0.0)] {
            if long.is_infinite() {
                (at.acceleration, at.velocity) = (0.0, self.peaks[1]);
            }
            let t = left.min(long);
            at.way += t * (at.velocity + t * (at.acceleration / 2.0 + t * jerk / 6.0));
            at.velocity += t * (at.acceleration + t * jerk / 2.0);
            at.acceleration += t * jerk;
            at.jerk = jerk;
            left -= t;
            if left <= 0.0 {
                break;
            }
        }
        at
    }
}
