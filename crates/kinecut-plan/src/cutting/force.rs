//! The force of a cut.

/// Spread of forces, powers and torques from [`CuttingForce`]: a quarter to either side, with a sharp edge.
pub const FORCE_SPREAD: f64 = 0.25;
/// Spread of the torque of a tap.
pub const TAPPING_SPREAD: f64 = 0.5;

/// The specific cutting force of a material after Kienzle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CuttingForce {
    /// For a chip 1 mm wide and 1 mm thick (N/mm2).
    pub kc11: f64,
    /// Exponent by which it grows for thinner chips.
    pub mc: f64,
}

impl CuttingForce {
    /// At a thickness of the chip [mm]: `kc1.1 h^-mc` (N/mm2).
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::CuttingForce;
    /// let c45 = CuttingForce { kc11: 2110.0, mc: 0.17 };
    /// assert!((c45.at(1.0) - 2110.0).abs() < 1e-9 && (c45.at(0.1) - 3120.9).abs() < 0.1);
    /// ```
    pub fn at(&self, thickness: f64) -> f64 {
        self.kc11 * thickness.powf(-self.mc)
    }
}
