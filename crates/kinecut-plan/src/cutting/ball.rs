//! The diameter at which a ball-nosed cutter cuts.

use std::f64::consts::FRAC_PI_2;

/// Largest diameter at which a ball of a diameter [mm] cuts that goes in by a depth [mm], with its axis tilted by an angle [rad]
/// from the normal of the surface: `D sin(tilt + acos(1 - 2 depth / D))`, and `D` beyond a right angle. It is the diameter from
/// which a cutting speed follows.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::cutting::effective_diameter;
/// // Untilted 2 sqrt(depth (D - depth)).
/// assert!((effective_diameter(10.0, 0.5, 0.0) - 2.0 * 4.75_f64.sqrt()).abs() < 1e-12);
/// ```
pub fn effective_diameter(diameter: f64, depth: f64, tilt: f64) -> f64 {
    let contact = (1.0 - 2.0 * depth / diameter).clamp(-1.0, 1.0).acos();
    diameter * (tilt.abs() + contact).min(FRAC_PI_2).sin()
}
