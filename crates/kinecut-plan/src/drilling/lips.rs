//! Uneven load of the lips of a point while it enters.
//!
//! A cone of slope k on a plane of slope t cuts along a conic with its focus on the tool axis, r = d / (k - t cos theta),
//! of eccentricity t / k = tan(alpha) tan(phi). Below 1 the tip leads and the lips cut to different radii; from 1 on the
//! corner touches first and one lip has all the load. (Specification of the case in `docs/drilling.md`.)

use super::BoundarySurface;
use crate::geom::EdgeProfile;

/// The imbalance of two opposite lips while the point enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LipBalance {
    /// Eccentricity of the engaged edge: 0 balanced, 1 and above one-sided.
    pub eccentricity: f64,
    /// Largest difference of the radii to which two opposite lips cut [mm].
    pub difference: f64,
}

/// The imbalance of an edge at a surface, with the plane that touches the surface on the tool axis.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::{BoundarySurface, lip_balance};
/// use kinecut::tool::DrillPoint;
/// let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(20.0).unwrap();
/// let face = BoundarySurface::Plane { height: 0.0, slope: 12f64.to_radians().tan() };
/// let balance = lip_balance(&edge, &face);
/// assert!((balance.eccentricity - 0.353754).abs() < 1e-6 && (balance.difference - 5.226262).abs() < 1e-6);
/// ```
pub fn lip_balance(edge: &EdgeProfile, surface: &BoundarySurface) -> LipBalance {
    let t = surface.slope().abs();
    let inner = edge.segments()[0];
    let radius = edge.outer_radius();
    // The slope of the whole edge: of a cone its own.
    let k = (inner.height(inner.range()[1]) - inner.height(inner.range()[0]))
        / (inner.range()[1] - inner.range()[0]);
    if t == 0.0 {
        return LipBalance { eccentricity: 0.0, difference: 0.0 };
    }
    if !(k > t) {
        let eccentricity = if k > 0.0 { t / k } else { f64::INFINITY };
        return LipBalance { eccentricity, difference: radius };
    }
    // Greatest just before the longer lip reaches the corner, d = R (k - t): 2 d t / (k^2 - t^2).
    LipBalance { eccentricity: t / k, difference: 2.0 * radius * t / (k + t) }
}
