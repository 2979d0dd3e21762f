//! Circular arcs and helices about any axis.

use glam::DVec3;

use super::{Jet, Rigid};
use crate::base::{Code, Finding, Result};
use crate::num::taylor::Taylor;

/// A circular arc or a helix: the start point turned about an axis while it rises along it.
///
/// A full circle has a sweep of 2 pi, two turns of a helix 4 pi; the sign follows the right-hand rule about
/// `axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// First point [mm].
    pub start: DVec3,
    /// Centre, in the plane of the start point normal to the axis [mm].
    pub centre: DVec3,
    /// Unit vector of the axis.
    pub axis: DVec3,
    /// Angle turned, right-handed about the axis [rad].
    pub sweep: f64,
    /// Movement along the axis over the whole sweep [mm].
    pub rise: f64,
}

impl Arc {
    /// A checked arc; the centre is moved along the axis into the plane of the start point.
    ///
    /// # Errors
    /// `KC0801` when a number is not finite, the axis is no direction, or the radius is zero.
    pub fn new(start: DVec3, centre: DVec3, axis: DVec3, sweep: f64, rise: f64) -> Result<Arc> {
        let axis = axis
            .try_normalize()
            .ok_or_else(|| Finding::error(Code::GEOMETRY, "the axis of an arc is zero"))?;
        if !(start.is_finite() && centre.is_finite() && sweep.is_finite() && rise.is_finite()) {
            return Err(Finding::error(Code::GEOMETRY, "an arc has a number that is not finite").into());
        }
        let centre = centre + axis * axis.dot(start - centre);
        let arc = Arc { start, centre, axis, sweep, rise };
        if arc.radius() <= 0.0 {
            return Err(Finding::error(Code::GEOMETRY, "the radius of an arc is zero").value_mm(0.0).into());
        }
        Ok(arc)
    }

    /// Radius [mm].
    pub fn radius(&self) -> f64 {
        (self.start - self.centre).length()
    }

    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        (self.radius() * self.sweep).hypot(self.rise)
    }

    /// Point at the fraction `u` of the sweep.
    pub fn point(&self, u: f64) -> DVec3 {
        let (sin, cos) = (self.sweep * u).sin_cos();
        let radial = self.start - self.centre;
        self.centre + radial * cos + self.axis.cross(radial) * sin + self.axis * (self.rise * u)
    }

    /// Point and derivatives at arc length `s` [mm].
    pub fn at(&self, s: f64) -> Jet {
        let length = self.length();
        if length == 0.0 {
            return Jet { p: self.start, d1: DVec3::ZERO, d2: DVec3::ZERO, d3: DVec3::ZERO };
        }
        let w = self.sweep / length;
        let (sin, cos) = (w * s).sin_cos();
        let radial = self.start - self.centre;
        let across = self.axis.cross(radial);
        let (e, f) = (radial * cos + across * sin, across * cos - radial * sin);
        let climb = self.axis * (self.rise / length);
        Jet { p: self.centre + e + climb * s, d1: f * w + climb, d2: -e * (w * w), d3: -f * (w * w * w) }
    }

    /// The point as a series by arc length, at arc length `s` [mm].
    pub fn series<const N: usize>(&self, s: f64) -> [Taylor<N>; 3] {
        let length = self.length();
        let (w, climb) = if length > 0.0 { (self.sweep / length, self.rise / length) } else { (0.0, 0.0) };
        let linear = |start: f64, slope: f64| {
            let mut c = Taylor::<N>::constant(start);
            if N > 1 {
                c.0[1] = slope;
            }
            c
        };
        let (sin, cos) = linear(w * s, w).sin_cos();
        let up = linear(climb * s, climb);
        let radial = self.start - self.centre;
        let across = self.axis.cross(radial);
        [0, 1, 2]
            .map(|i| cos.scaled(radial[i]) + sin.scaled(across[i]) + up.scaled(self.axis[i]) + self.centre[i])
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> Arc {
        Arc {
            start: self.point(1.0),
            centre: self.centre + self.axis * self.rise,
            axis: self.axis,
            sweep: -self.sweep,
            rise: -self.rise,
        }
    }

    /// The part between arc lengths `a <= b` [mm].
    #[must_use]
    pub fn part(&self, a: f64, b: f64) -> Arc {
        let (u, v) = (a / self.length(), b / self.length());
        Arc {
            start: self.point(u),
            centre: self.centre + self.axis * (self.rise * u),
            axis: self.axis,
            sweep: self.sweep * (v - u),
            rise: self.rise * (v - u),
        }
    }

    /// The arc moved by a rigid motion.
    #[must_use]
    pub fn moved(&self, motion: &Rigid) -> Arc {
        Arc {
            start: motion.point(self.start),
            centre: motion.point(self.centre),
            axis: motion.vector(self.axis),
            ..*self
        }
    }
}
