//! Loops of a cutter along a slot, each around a centre a pitch ahead of the one before.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Places along a loop at which the engagement is looked at before the best is refined.
const LOOKS: u32 = 192;
/// Steps of the refinement, and of the search for a pitch.
const STEPS: u32 = 60;

/// Loops of a trochoid.
///
/// Ahead of a loop all within the circle of the one before is cleared; the cutter's circle meets that circle in closed form.
/// The largest engagement is not at the front of the loop but before it.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::clearing::Trochoid;
/// // A slot of 16 mm, a cutter of radius 5, a pitch of 1 mm: 54.9 degrees at the front, 60.0 at -34 degrees.
/// let loops = Trochoid { cutter: 5.0, around: 3.0 };
/// assert!((loops.engagement(1.0, 0.0).to_degrees() - 54.9).abs() < 0.05);
/// assert!((loops.largest(1.0).to_degrees() - 60.0).abs() < 0.05);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trochoid {
    /// Radius of the cutter [mm].
    pub cutter: f64,
    /// Radius of the circle of its centre [mm].
    pub around: f64,
}

impl Trochoid {
    /// Engagement [rad] at a polar angle of the loop [rad], from the way ahead counter-clockwise, for a pitch [mm].
    pub fn engagement(&self, pitch: f64, at: f64) -> f64 {
        self.beyond(self.cutter + self.around, DVec2::X * pitch + self.around * DVec2::from_angle(at), at)
    }

    /// Engagement [rad] of the cutter at a place seen from the middle of a cleared circle of a radius [mm]; `right`: direction of
    /// the right normal of its travel [rad].
    fn beyond(&self, cleared: f64, at: DVec2, right: f64) -> f64 {
        let (a, away) = (self.cutter, at.length());
        if away == 0.0 {
            return 0.0;
        }
        // Points of the cutter's circle so far around the way out are beyond the cleared circle.
        let beyond = ((cleared * cleared - away * away - a * a) / (2.0 * away * a)).clamp(-1.0, 1.0).acos();
        let out = at.to_angle() - right;
        let front = |turn: f64| ((out + turn + beyond).min(PI) - (out + turn - beyond).max(0.0)).max(0.0);
        front(-TAU) + front(0.0) + front(TAU)
    }

    /// The polar angle of a loop at which it leaves what the loop before has cleared [rad]: behind, on the right; a half turn
    /// where all of it cuts.
    pub fn leaves(&self, pitch: f64) -> f64 {
        -(-0.5 * pitch / self.around).max(-1.0).acos()
    }

    /// Largest engagement on a loop [rad].
    pub fn largest(&self, pitch: f64) -> f64 {
        let step = TAU / f64::from(LOOKS);
        let look = |i: u32| -PI + step * f64::from(i);
        let of = |at: f64| self.engagement(pitch, at);
        let best = (0..=LOOKS).map(look).max_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap_or(0.0);
        let (mut low, mut high) = (best - step, best + step);
        for _ in 0..STEPS {
            let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            if of(a) < of(b) { low = a } else { high = b }
        }
        of(0.5 * (low + high)).max(of(best))
    }

    /// The pitch with a largest engagement [mm, rad]; the cutter's diameter at most.
    pub fn pitch(&self, wanted: f64) -> f64 {
        let (mut low, mut high) = (0.0, 2.0 * self.cutter);
        if self.largest(high) <= wanted {
            return high;
        }
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            if self.largest(middle) <= wanted { low = middle } else { high = middle }
        }
        low
    }

    /// Radius of the circle about which the cutter's centre may go next, from a cleared circle of a radius [mm] around the
    /// same centre, within an engagement [rad], also on the half circle that leads there.
    pub(super) fn ring(&self, cleared: f64, wanted: f64) -> f64 {
        // By the law of cosines in the triangle of both centres and the point where the circles meet.
        let a = self.cutter;
        let (sin, cos) = wanted.sin_cos();
        let from = cleared - a;
        let largest = |to: f64| {
            let (middle, radius) = (0.5 * (from - to), 0.5 * (from + to));
            let look = |k: u32| {
                let angle = PI * f64::from(k) / f64::from(LOOKS);
                self.beyond(cleared, DVec2::X * middle + radius * DVec2::from_angle(angle), angle)
            };
            (0..=LOOKS).map(look).fold(0.0, f64::max)
        };
        let (mut low, mut high) = (from, -a * cos + (cleared * cleared - a * a * sin * sin).max(0.0).sqrt());
        if largest(high) <= wanted {
            return high;
        }
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            if largest(middle) <= wanted { low = middle } else { high = middle }
        }
        low
    }
}
