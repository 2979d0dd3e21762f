//! Load of milling cutters.

use std::f64::consts::TAU;

use super::{CuttingForce, CuttingLoad, MilledChip};

/// A cutter with a cylindrical edge on a straight way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MillingCut {
    /// Diameter [mm].
    pub diameter: f64,
    /// Teeth.
    pub teeth: u32,
    /// Speed of the spindle (rad/s).
    pub speed: f64,
    /// Feed in a second [mm].
    pub feed: f64,
    /// Depth of cut [mm].
    pub depth: f64,
    /// Width of cut [mm].
    pub width: f64,
}

impl MillingCut {
    /// Feed per tooth [mm].
    pub fn feed_per_tooth(&self) -> f64 {
        self.feed * TAU / (self.speed * f64::from(self.teeth.max(1)))
    }

    /// Its chip.
    pub fn chip(&self) -> MilledChip {
        MilledChip::of(self.feed_per_tooth(), self.width, self.diameter)
    }

    /// Volume removed in a second [mm3].
    pub fn rate(&self) -> f64 {
        self.depth * self.width * self.feed
    }

    /// Its load at the mean chip: 2 to 4.5 % more than the integral over the arc of engagement gives.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::{CuttingForce, MillingCut};
    /// let speed = 4000.0 * std::f64::consts::TAU / 60.0;
    /// let cut = MillingCut { diameter: 10.0, teeth: 4, speed, feed: 1600.0 / 60.0, depth: 10.0, width: 1.0 };
    /// let load = cut.load(&CuttingForce { kc11: 2110.0, mc: 0.17 });
    /// assert!((load.power - 1015.1).abs() < 0.1 && (load.torque - 2.423).abs() < 1e-3);
    /// ```
    pub fn load(&self, force: &CuttingForce) -> CuttingLoad {
        let power = force.at(self.chip().mean) * self.rate() / 1000.0;
        let edge = 0.5 * self.diameter * self.speed / 1000.0;
        CuttingLoad { power, torque: power / self.speed, force: power / edge }
    }
}
