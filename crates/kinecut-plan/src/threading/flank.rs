//! The flanks that a thread mill cuts: the envelope of its profile on the helix, in closed form.
//!
//! In the half-plane through the axis of the thread at radius `r` the tool, `phi` away on its helix of radius `rc`, is cut at the
//! radius `rho = sqrt(rc^2 + r^2 - 2 rc r cos phi)`, and has climbed by `P phi / 2 pi`. A straight flank reaches
//! farthest where `k phi - rho` is greatest, `k = P / (2 pi tan alpha)`: there `cos phi = (k^2 + sqrt((rc^2 - k^2)(r^2 - k^2)))
//! / (rc r)`, `rho = |sqrt(r^2 - k^2) - sqrt(rc^2 - k^2)|`, `phi = |asin(k / rc) - asin(k / r)|`. So with
//! `S(x) = k asin(k / x) + sqrt(x^2 - k^2)` the radius `r` at which a tool of radius `a` at its pitch line leaves the pitch line
//! is that of `S(r) = S(rc) + a` inside, `S(r) = S(rc) - a` outside. To second order `r` is off by `k^2 a / (2 rc r)`.

use std::f64::consts::TAU;

use super::ThreadSide;
use crate::num::root::bracketed_newton;

/// Newton's steps at most: the root is simple but at `x = k`, where halving the bracket takes over.
const STEPS: u32 = 80;

/// Flanks of a thread, as a tool with straight edges cuts them on its helix [mm].
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::threading::{Flank, ThreadSide::Inside};
/// // M20x2.5 with a tool of 14 mm.
/// let flank = Flank::new(2.5, 30f64.to_radians());
/// let gain = flank.gain(Inside, 3.0, 6.188101183952089).unwrap();
/// assert!((gain - 0.05380391251193117).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flank {
    /// Climb of the helix by angle over the tangent of the half angle.
    k: f64,
}

impl Flank {
    /// Of a pitch [mm] and the angle between flank and a plane across the axis [rad].
    pub fn new(pitch: f64, half_angle: f64) -> Flank {
        Flank { k: pitch / (TAU * half_angle.tan()) }
    }

    /// Way by which the pitch line lies deeper in the material than the tool's section says [mm], of a tool with a radius at its
    /// pitch line [mm] on a helix of a radius [mm]; `None` where the helix is so steep that no flank stays.
    pub fn gain(&self, side: ThreadSide, centre_radius: f64, tool_radius: f64) -> Option<f64> {
        let from = self.rolled(centre_radius)?;
        Some(match side {
            ThreadSide::Inside => self.radius_of(from + tool_radius)? - (centre_radius + tool_radius),
            ThreadSide::Outside => (centre_radius - tool_radius) - self.radius_of(from - tool_radius)?,
        })
    }

    /// The same to second order [mm], as tables have it.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::{Flank, ThreadSide::Inside};
    /// let flank = Flank::new(2.5, 30f64.to_radians());
    /// assert!((flank.gain_second_order(Inside, 3.0, 6.188101183952089) - 0.0533).abs() < 5e-5);
    /// ```
    pub fn gain_second_order(&self, side: ThreadSide, centre_radius: f64, tool_radius: f64) -> f64 {
        let local = match side {
            ThreadSide::Inside => centre_radius + tool_radius,
            ThreadSide::Outside => centre_radius - tool_radius,
        };
        self.k * self.k * tool_radius / (2.0 * centre_radius * local)
    }

    /// Radius of the helix on which a tool with a radius at its pitch line leaves a pitch line of a radius [mm]; `None` where
    /// the helix would be too steep.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::{Flank, ThreadSide::Inside};
    /// let flank = Flank::new(2.5, 30f64.to_radians());
    /// let radius = flank.centre_radius(Inside, 9.188101183952089, 6.188101183952089).unwrap();
    /// // Less by 0.0552, the overcut on that radius; on the nominal one it is 0.0538.
    /// assert!((radius - 2.944844).abs() < 1e-6);
    /// ```
    pub fn centre_radius(&self, side: ThreadSide, pitch_radius: f64, tool_radius: f64) -> Option<f64> {
        let at = self.rolled(pitch_radius)?;
        match side {
            ThreadSide::Inside => self.radius_of(at - tool_radius),
            ThreadSide::Outside => self.radius_of(at + tool_radius),
        }
    }

    /// Height above the pitch line of the tool at which its edge cuts the pitch line of the thread, on a helix of a radius
    /// through a pitch line of a radius [mm].
    pub fn contact(&self, centre_radius: f64, pitch_radius: f64) -> Option<f64> {
        if !(centre_radius > self.k && pitch_radius > self.k) {
            return None;
        }
        Some(self.k * ((self.k / centre_radius).asin() - (self.k / pitch_radius).asin()).abs())
    }

    /// `S(x)`, which grows with `x`; `None` below `k`.
    fn rolled(&self, x: f64) -> Option<f64> {
        let k = self.k;
        (x > k).then(|| k * (k / x).asin() + ((x - k) * (x + k)).sqrt())
    }

    /// The radius of `S`.
    fn radius_of(&self, rolled: f64) -> Option<f64> {
        let k = self.k;
        let least = k * std::f64::consts::FRAC_PI_2;
        if !(rolled > least && rolled.is_finite()) {
            return None;
        }
        // S(x) - x falls from (pi / 2 - 1) k to 0.
        let low = rolled - (least - k);
        let low = if low > k { low } else { k };
        let value = |x: f64| (self.rolled(x).unwrap_or(least) - rolled, ((x - k) * (x + k)).sqrt() / x);
        Some(bracketed_newton(value, rolled, low, rolled, STEPS).0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_of_the_helix_undoes_the_gain() {
        for pitch in [0.25, 1.0, 2.5, 6.0] {
            for half_angle in [27.5_f64, 30.0] {
                let flank = Flank::new(pitch, half_angle.to_radians());
                for side in [ThreadSide::Inside, ThreadSide::Outside] {
                    for (radius, tool) in [(4.0, 2.0), (9.0, 6.3), (30.0, 10.0)] {
                        let Some(helix) = flank.centre_radius(side, radius, tool) else { continue };
                        let gain = flank.gain(side, helix, tool).unwrap();
                        let reached = match side {
                            ThreadSide::Inside => helix + tool + gain,
                            ThreadSide::Outside => helix - tool - gain,
                        };
                        assert!(gain > 0.0 && (reached - radius).abs() < 1e-12, "{pitch} {side:?} {radius}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_helix_that_is_too_steep_has_no_flank() {
        // k = 0.689 for M20.
        let flank = Flank::new(2.5, 30f64.to_radians());
        assert_eq!(flank.gain(ThreadSide::Inside, 0.68, 8.0), None);
        assert_eq!(flank.gain(ThreadSide::Inside, f64::NAN, 8.0), None);
        assert_eq!(flank.centre_radius(ThreadSide::Inside, 9.0, 8.5), None);
        assert_eq!(flank.contact(0.5, 9.0), None);
    }
}
