//! Distance from the hyperboloid of one sheet.
//!
//! In the half-plane of a point the foot `(x, z)` on `x^2/a^2 - z^2/c^2 = 1` satisfies `x = a^2 r/(a^2+t)`,
//! `z = c^2 h/(c^2-t)` with Lagrange's `t` between `-a^2` and `c^2`. There the equation of the hyperbola falls from
//! plus to minus infinity, so it has one root, which is bracketed; on the axis and in the plane of the throat the
//! factor goes to an end of the interval and the foot is written down.

use glam::{DVec2, DVec3};

use super::Distance;
use crate::num::root::bracketed_newton;

/// The body inside a hyperboloid of one sheet about Z, with its throat at the height zero.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::machine::generation::{Distance, Hyperboloid};
/// let sheet = Hyperboloid { throat: 20.0, slope: 0.5 };
/// assert!((sheet.signed(DVec3::new(23.0, 0.0, 0.0)) - 3.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hyperboloid {
    /// Radius of the throat [mm].
    pub throat: f64,
    /// Slope of the asymptotes, dr/dz; the tangent of the angle of its straight lines to the axis.
    pub slope: f64,
}

impl Distance for Hyperboloid {
    fn signed(&self, p: DVec3) -> f64 {
        let at = DVec2::new(p.truncate().length(), p.z.abs());
        let (a, slope) = (self.throat.abs(), self.slope.abs());
        if slope == 0.0 || a == 0.0 {
            // A cylinder, or a cone of two nappes.
            let across = DVec2::new(1.0, -slope) / 1f64.hypot(slope);
            let along = DVec2::new(slope, 1.0).dot(at).max(0.0) / 1f64.hypot(slope);
            return if a == 0.0 && along == 0.0 { at.length() } else { across.dot(at) - a };
        }
        let foot = foot(at, a, a / slope);
        let outside = at.x > (a * a + (slope * at.y).powi(2)).sqrt();
        let distance = at.distance(foot);
        if outside { distance } else { -distance }
    }
}

/// The foot of a point of the first quadrant on the hyperbola with half-axes `a` and `c`.
fn foot(at: DVec2, a: f64, c: f64) -> DVec2 {
    let (aa, cc) = (a * a, c * c);
    let on_curve = |z: f64| DVec2::new(a * (1.0 + z * z / cc).sqrt(), z);
    if at.x == 0.0 {
        return on_curve(cc * at.y / (aa + cc));
    }
    if at.y == 0.0 {
        let x = (aa * at.x / (aa + cc)).max(a);
        return DVec2::new(x, c * ((x / a).powi(2) - 1.0).max(0.0).sqrt());
    }
    // Negative, so that it rises.
    let lack = |t: f64| {
        let (x, z) = (a * at.x / (aa + t), c * at.y / (cc - t));
        (1.0 + z * z - x * x, 2.0 * (x * x / (aa + t) + z * z / (cc - t)))
    };
    let (t, _) = bracketed_newton(lack, 0.0, -aa, cc, EVALUATIONS);
    on_curve(cc * at.y / (cc - t))
}

/// More than bisection alone needs for any two numbers.
const EVALUATIONS: u32 = 200;
