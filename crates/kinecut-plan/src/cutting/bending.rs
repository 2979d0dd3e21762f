//! Bending of a tool by a force at its tip.

use std::f64::consts::PI;

/// A stretch of a tool with one diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundPart {
    /// Length along the axis [mm].
    pub length: f64,
    /// Diameter [mm]; of a fluted stretch about 0.8 of the cutter's.
    pub diameter: f64,
}

/// Deflection at the tip [mm] of a tool held in its holder, by a force (N) across its axis at the tip; `parts` from the holder to the
/// tip, `modulus` (N/mm2): about 600 000 of carbide, 210 000 of steel.
///
/// `sum F (u0^3 - u1^3) / (3 E I)` with the distances `u` of each part's ends to the tip and `I = pi d^4 / 64`: shear and the give
/// of holder and spindle are not in it.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::cutting::{RoundPart, tip_deflection};
/// let shank = RoundPart { length: 40.0, diameter: 10.0 };
/// assert!((tip_deflection(200.0, 600_000.0, &[shank]) - 0.014487).abs() < 1e-6);
/// ```
pub fn tip_deflection(force: f64, modulus: f64, parts: &[RoundPart]) -> f64 {
    let mut to_tip: f64 = parts.iter().map(|part| part.length).sum();
    let mut deflection = 0.0;
    for part in parts {
        let next = to_tip - part.length;
        let inertia = PI * part.diameter.powi(4) / 64.0;
        deflection += force * (to_tip.powi(3) - next.powi(3)) / (3.0 * modulus * inertia);
        to_tip = next;
    }
    deflection
}

/// Share of its feed per tooth that a tool of a diameter [mm] takes which sticks out by a length [mm]: `(4 D / L)^1.5` beyond four
/// diameters, a rule of this program.
///
/// ```
/// # use kinecut_plan as kinecut;
/// assert_eq!(kinecut::cutting::stickout_share(10.0, 40.0), 1.0);
/// assert!((kinecut::cutting::stickout_share(10.0, 60.0) - 0.5443).abs() < 1e-4);
/// ```
pub fn stickout_share(diameter: f64, stickout: f64) -> f64 {
    /// Lengths up to which a tool is stiff, in diameters.
    const STIFF: f64 = 4.0;
    (STIFF * diameter / stickout).powf(1.5).min(1.0)
}
