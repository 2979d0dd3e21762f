//! Load of drills and taps.

use super::{CuttingForce, CuttingLoad};

/// A drill in the solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrillingCut {
    /// Diameter [mm].
    pub diameter: f64,
    /// Feed per revolution [mm].
    pub feed: f64,
    /// Lips.
    pub lips: u32,
    /// Full angle of the point [rad].
    pub point: f64,
    /// Speed of the spindle (rad/s).
    pub speed: f64,
}

impl DrillingCut {
    /// Thickness of the chip [mm]: `f / z sin(s / 2)`.
    pub fn chip(&self) -> f64 {
        self.feed / f64::from(self.lips.max(1)) * (0.5 * self.point).sin()
    }

    /// Volume removed in a second [mm3].
    pub fn rate(&self) -> f64 {
        0.125 * self.diameter * self.diameter * self.feed * self.speed
    }

    /// Its load: torque `kc f D^2 / 8`; the force is the thrust of the lips, `kc f D / 4 sin(s / 2)`. What the chisel edge adds,
    /// which may be as much again, is not in it.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::{CuttingForce, DrillingCut};
    /// let speed = 3000.0 * std::f64::consts::TAU / 60.0;
    /// let cut = DrillingCut { diameter: 10.0, feed: 0.2, lips: 2, point: 140f64.to_radians(), speed };
    /// let load = cut.load(&CuttingForce { kc11: 2110.0, mc: 0.17 });
    /// assert!((load.torque - 7.885).abs() < 1e-3 && (load.force - 1481.9).abs() < 0.1);
    /// ```
    pub fn load(&self, force: &CuttingForce) -> CuttingLoad {
        let kc = force.at(self.chip());
        let torque = kc * self.feed * self.diameter * self.diameter / 8000.0;
        let thrust = 0.25 * kc * self.feed * self.diameter * (0.5 * self.point).sin();
        CuttingLoad { torque, power: torque * self.speed, force: thrust }
    }
}

/// A tap that cuts its thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TappingCut {
    /// Diameter of the thread [mm].
    pub diameter: f64,
    /// Pitch [mm].
    pub pitch: f64,
    /// Flutes.
    pub flutes: u32,
    /// Length of the lead, in pitches.
    pub lead: f64,
    /// Speed of the spindle (rad/s).
    pub speed: f64,
}

impl TappingCut {
    /// Thickness of the chip from which its force follows [mm]: `P / (2 z lead)`.
    pub fn chip(&self) -> f64 {
        self.pitch / (2.0 * f64::from(self.flutes.max(1)) * self.lead)
    }

    /// Its load: torque `kc P^2 D / 8`, right within [`TAPPING_SPREAD`](super::TAPPING_SPREAD); no force is known.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::{CuttingForce, TappingCut};
    /// let cut = TappingCut { diameter: 8.0, pitch: 1.25, flutes: 3, lead: 2.5, speed: 50.0 };
    /// let load = cut.load(&CuttingForce { kc11: 2110.0, mc: 0.17 });
    /// // kc 3110 N/mm2 x 1.25^2 x 8 / 8000.
    /// assert!((cut.chip() - 0.08333).abs() < 1e-5 && (load.torque - 5.03).abs() < 0.01);
    /// ```
    pub fn load(&self, force: &CuttingForce) -> CuttingLoad {
        let torque = force.at(self.chip()) * self.pitch * self.pitch * self.diameter / 8000.0;
        CuttingLoad { torque, power: torque * self.speed, force: 0.0 }
    }
}
