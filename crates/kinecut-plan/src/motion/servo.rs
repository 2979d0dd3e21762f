//! What position loops make of a motion: a model.
//!
//! Each axis follows its command like a mass on a damped spring, `y'' + 2 d w y' + w^2 y = w^2 q`, with the damping
//! `d = 1/sqrt(2)`, so that a motion of the frequency `w / (2 pi)` passes with `1/sqrt(2)` of its size: the bandwidth. No
//! command is fed forward, no axis pushes another, and the machine is stiff.
//!
//! The lag `e = q - y` is followed exactly for commands whose `q'' + 2 d w q'` is a cubic in each cycle.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use glam::DVec3;
use serde::Serialize;

use super::MotionSample;
use crate::base::{Code, Finding, Result};

/// Position loops of second order, the same for all linear axes.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::motion::Servo;
/// // On a circle of 10 mm radius at 100 mm/s, 1.6 turns a second, loops of 30 Hz lag behind and stay on the circle.
/// let (servo, turns) = (Servo::new(30.0).unwrap(), 100.0 / (2.0 * std::f64::consts::PI * 10.0));
/// assert!((10.0 * (1.0 - servo.gain(turns)) - 3.97e-5).abs() < 1e-7);
/// assert!((servo.gain(30.0) - 0.5f64.sqrt()).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Servo {
    /// Frequency of a motion that passes with 0.707 of its size [Hz].
    pub bandwidth: f64,
}

impl Servo {
    /// Damping of the loops.
    pub const DAMPING: f64 = FRAC_1_SQRT_2;

    /// Loops of a bandwidth [Hz].
    ///
    /// # Errors
    /// `KC0404` for a bandwidth that is not positive and finite.
    pub fn new(bandwidth: f64) -> Result<Servo> {
        if !(bandwidth > 0.0 && bandwidth.is_finite()) {
            return Err(Finding::error(Code::PLAN_VALUE, "the bandwidth of the servos must be positive")
                .value(bandwidth, "Hz")
                .bound(0.0, "Hz")
                .key("servo_bandwidth")
                .into());
        }
        Ok(Servo { bandwidth })
    }

    /// Size of a motion of a frequency [Hz] as a share of that commanded.
    pub fn gain(&self, frequency: f64) -> f64 {
        let ratio = frequency / self.bandwidth;
        (1.0 + ratio.powi(4)).sqrt().recip()
    }

    /// The axes that follow samples `cycle` [s] apart, from rest.
    pub fn following(&self, cycle: f64) -> Following {
        Following::new(self, cycle)
    }
}

/// A place of the tip at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Followed {
    /// The place [mm].
    pub place: DVec3,
    /// Its distance from the commanded path [mm].
    pub off: f64,
}

/// Linear axes that follow a motion.
#[derive(Clone, Debug)]
pub struct Following {
    /// Angular frequency of the loops [rad/s].
    frequency: f64,
    cycle: f64,
    /// Lag and its rate a cycle later, for a lag of 1 and for a rate of 1.
    free: [[f64; 2]; 2],
    /// Lag and its rate [mm, mm/s].
    lag: [DVec3; 2],
    /// At the last sample velocity, acceleration and jerk; and what drives the lag, `q'' + 2 d w q'`, with its rate.
    before: Option<([DVec3; 3], [DVec3; 2])>,
    /// The command so far: places and velocities.
    path: Vec<[DVec3; 2]>,
    /// Number of the last commands among which the nearest to the tip is.
    window: usize,
}

impl Following {
    fn new(servo: &Servo, cycle: f64) -> Following {
        let frequency = TAU * servo.bandwidth;
        let decay = Servo::DAMPING * frequency;
        let swing = (frequency * frequency - decay * decay).sqrt();
        let (sin, cos) = (swing * cycle).sin_cos();
        let left = (-decay * cycle).exp();
        let rate = left * sin / swing;
        let free =
            [[left * cos + decay * rate, -frequency * frequency * rate], [rate, left * cos - decay * rate]];
        let lag = [DVec3::ZERO; 2];
        /// Time constants of the loops: the tip lags behind by the square root of two of them.
        const BEHIND: f64 = 8.0;
        let window = (BEHIND / (frequency * cycle)).ceil() as usize + 2;
        Following { frequency, cycle, free, lag, before: None, path: Vec::new(), window }
    }

    /// The tip at the next sample, a cycle after the last one.
    pub fn follow(&mut self, sample: &MotionSample) -> Followed {
        let axes = &sample.axes;
        let of = |pick: fn(&super::AxisMoment) -> f64| DVec3::from_array([0, 1, 2].map(|a| pick(&axes[a])));
        let (place, velocity) = (of(|a| a.position), of(|a| a.velocity));
        let (acceleration, jerk) = (of(|a| a.acceleration), of(|a| a.jerk));
        let damped = 2.0 * Servo::DAMPING * self.frequency;
        let drive = [acceleration + damped * velocity, jerk + damped * acceleration];
        let now = [velocity, acceleration, jerk];
        if let Some((before, driven)) = self.before {
            // A velocity that jumps within the cycle: half of it at each end.
            let h = self.cycle;
            let even = before[0] + h * (0.5 * (before[1] + now[1]) + h / 12.0 * (before[2] - now[2]));
            let jump = 0.5 * (velocity - even);
            self.lag[1] += jump;
            self.lag = self.after(driven, drive);
            self.lag[1] += jump;
        }
        self.before = Some((now, drive));
        // A command that stands is one place.
        match self.path.last_mut() {
            Some(last) if last[0] == place => last[1] = velocity,
            _ => self.path.push([place, velocity]),
        }
        let tip = place - self.lag[0];
        Followed { place: tip, off: self.off(tip) }
    }

    /// Lag and its rate after a cycle driven from one end to the other.
    fn after(&self, [from, from_rate]: [DVec3; 2], [to, to_rate]: [DVec3; 2]) -> [DVec3; 2] {
        let (h, w) = (self.cycle, self.frequency);
        let (damped, stiff) = (2.0 * Servo::DAMPING * w, w * w);
        // The drive as a cubic in time, and the lag that goes with it.
        let slope = (to - from) / h;
        let drive = [
            from,
            from_rate,
            (3.0 * slope - 2.0 * from_rate - to_rate) / h,
            (from_rate + to_rate - 2.0 * slope) / (h * h),
        ];
        let third = drive[3] / stiff;
        let second = (drive[2] - 3.0 * damped * third) / stiff;
        let first = (drive[1] - 2.0 * damped * second - 6.0 * third) / stiff;
        let zeroth = (drive[0] - damped * first - 2.0 * second) / stiff;
        let end = zeroth + h * (first + h * (second + h * third));
        let end_rate = first + h * (2.0 * second + 3.0 * h * third);
        let [lag, rate] = [self.lag[0] - zeroth, self.lag[1] - first];
        [
            end + self.free[0][0] * lag + self.free[1][0] * rate,
            end_rate + self.free[0][1] * lag + self.free[1][1] * rate,
        ]
    }

    /// Distance of the tip from the path commanded of late [mm].
    fn off(&self, tip: DVec3) -> f64 {
        let Some(last) = self.path.len().checked_sub(2) else {
            return self.path.first().map_or(0.0, |[place, _]| (tip - *place).length());
        };
        // The nearest place of the last ones, and the part beside it in which the foot lies.
        let first = (last + 2).saturating_sub(self.window);
        let far = |i: usize| (tip - self.path[i][0]).length_squared();
        let nearest = (first..last + 2).min_by(|a, b| far(*a).total_cmp(&far(*b))).unwrap_or(first);
        let share = |i: usize| {
            let ([from, _], [to, _]) = (self.path[i], self.path[i + 1]);
            ((tip - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0)
        };
        let i = if nearest > 0 && (nearest > last || share(nearest) == 0.0) { nearest - 1 } else { nearest };
        let mut share = share(i);
        let ([from, from_rate], [to, to_rate]) = (self.path[i], self.path[i + 1]);
        // The path between two places as a cubic in time, and the foot on it.
        let slopes = [from_rate * self.cycle, to_rate * self.cycle];
        let along = to - from;
        let cubic =
            [from, slopes[0], 3.0 * along - 2.0 * slopes[0] - slopes[1], slopes[0] + slopes[1] - 2.0 * along];
        let at = |t: f64| cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
        /// More than three only beside a rest, where the path begins with no speed.
        const STEPS: usize = 12;
        /// Step after which another changes nothing.
        const SMALL: f64 = 1e-7;
        for _ in 0..STEPS {
            let rate = cubic[1] + share * (2.0 * cubic[2] + 3.0 * share * cubic[3]);
            let step = (tip - at(share)).dot(rate) / rate.length_squared();
            if !step.is_finite() {
                break;
            }
            share = (share + step).clamp(0.0, 1.0);
            if step.abs() < SMALL {
                break;
            }
        }
        (tip - at(share)).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::AxisMoment;

    const CYCLE: f64 = 1e-3;

    /// A sample of X and Y: place, velocity, acceleration and jerk of each.
    fn sample(time: f64, axes: [[f64; 4]; 2]) -> MotionSample {
        let mut all = [AxisMoment::default(); 6];
        for (axis, [position, velocity, acceleration, jerk]) in all.iter_mut().zip(axes) {
            *axis = AxisMoment { position, velocity, acceleration, jerk };
        }
        MotionSample { time, item: 0, segment: None, feed: 0.0, axes: all }
    }

    #[test]
    fn a_circle_becomes_smaller_as_the_gain_says() {
        for (bandwidth, radius, speed) in [(30.0, 10.0, 100.0), (30.0, 1.0, 100.0), (50.0, 79.0, 600.0)] {
            let servo = Servo::new(bandwidth).unwrap();
            let mut following = servo.following(CYCLE);
            let turn = speed / radius;
            let mut last = Followed::default();
            for k in 0..1000 {
                let time = f64::from(k) * CYCLE;
                let (sin, cos) = (turn * time).sin_cos();
                let of =
                    |a: f64, b: f64| [a, b * turn, -a * turn * turn, -b * turn.powi(3)].map(|v| v * radius);
                last = following.follow(&sample(time, [of(cos, -sin), of(sin, cos)]));
            }
            let expected = radius * servo.gain(turn / TAU);
            assert!((last.place.length() - expected).abs() < 1e-7, "{} {expected}", last.place.length());
            assert!((last.off - (radius - expected)).abs() < 1e-6, "{} {}", last.off, radius - expected);
        }
    }

    #[test]
    fn the_lag_behind_an_even_acceleration_is_the_closed_form() {
        const PULL: f64 = 2000.0;
        let servo = Servo::new(25.0).unwrap();
        let w = TAU * 25.0;
        let (decay, swing) = (Servo::DAMPING * w, w * (1.0 - Servo::DAMPING * Servo::DAMPING).sqrt());
        let first = 2.0 * Servo::DAMPING * PULL / w;
        let zeroth = (PULL - 2.0 * Servo::DAMPING * w * first) / (w * w);
        let mut following = servo.following(CYCLE);
        for k in 0..200 {
            let t = f64::from(k) * CYCLE;
            let way = 0.5 * PULL * t * t;
            let followed = following.follow(&sample(t, [[way, PULL * t, PULL, 0.0], [0.0; 4]]));
            let free = (-decay * t).exp()
                * (-zeroth * (swing * t).cos() + (-decay * zeroth - first) / swing * (swing * t).sin());
            let lag = zeroth + first * t + free;
            assert!((way - followed.place.x - lag).abs() < 1e-10, "{t}");
            assert!(followed.off < 1e-9, "on a straight line the tip only lags: {t} {}", followed.off);
        }
    }

    #[test]
    fn a_velocity_that_jumps_is_followed_and_overshoots() {
        // 100 mm/s to the right, then at once 100 mm/s up.
        let servo = Servo::new(30.0).unwrap();
        let mut following = servo.following(CYCLE);
        let mut most = 0.0_f64;
        let mut last = Followed::default();
        for k in 0..1000 {
            let t = f64::from(k) * CYCLE;
            let along = 100.0 * t.min(0.5);
            let up = 100.0 * (t - 0.5).max(0.0);
            let is_first = t < 0.5 - 0.5 * CYCLE;
            let [vx, vy] = if is_first { [100.0, 0.0] } else { [0.0, 100.0] };
            last = following.follow(&sample(t, [[along, vx, 0.0, 0.0], [up, vy, 0.0, 0.0]]));
            most = most.max(last.off);
        }
        // The lag of each axis goes by e(t) = 2 d v/w (1 - ...): cut inside by some tenths of 0.75 mm, straight again after.
        assert!(most > 0.1 && most < 0.4, "{most}");
        assert!(last.off < 1e-9 && (last.place.x - 50.0).abs() < 1e-9, "{last:?}");
        let lag = 2.0 * Servo::DAMPING * 100.0 / (TAU * 30.0);
        assert!((last.place.y - (100.0 * 0.499 - lag)).abs() < 1e-6, "{last:?}");
    }

    #[test]
    fn a_bandwidth_that_is_none_is_refused() {
        for bandwidth in [0.0, -3.0, f64::NAN, f64::INFINITY] {
            let error = Servo::new(bandwidth).unwrap_err();
            assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some("servo_bandwidth")));
        }
    }
}
