//! The load of a cut on the spindle.

/// The load of a cut: without the losses of the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CuttingLoad {
    /// Torque at the spindle (N m).
    pub torque: f64,
    /// Power (W).
    pub power: f64,
    /// Of milling the mean force along the cut, of drilling the thrust of the lips (N).
    pub force: f64,
}
