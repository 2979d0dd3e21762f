//! Numbers that look random and are the same in each run.

use std::f64::consts::TAU;

use glam::DVec3;

/// A generator.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A number in [0, 1).
    pub(crate) fn share(&mut self) -> f64 {
        let mut random = kinecut::num::random::Random(self.0);
        let share = random.share();
        self.0 = random.0;
        share
    }

    /// A number in [-1, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        2.0 * self.share() - 1.0
    }

    /// A number between two.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    /// A whole number below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.share() * count as f64) as usize
    }

    /// A vector whose coordinates lie between -`size` and `size`.
    pub(crate) fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }

    /// A unit vector, any direction as likely as any other.
    pub(crate) fn direction(&mut self) -> DVec3 {
        let z = self.unit();
        let (sin, cos) = (TAU * self.share()).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(r * cos, r * sin, z)
    }
}
