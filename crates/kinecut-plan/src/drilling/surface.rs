//! The surfaces that a drill enters and leaves: planes and cylinders across its axis.

use std::f64::consts::FRAC_PI_2;

use crate::base::{Code, Error, Finding, Result};

/// Sense in which the drill passes a surface: into the part or out of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// Into the part.
    Entry,
    /// Out of it.
    Exit,
}

/// A face of the part as drawn, in its own frame [mm, rad]. The origin of a plane's frame is a point of the
/// plane, that of a cylinder's a point of its axis, which is level; `offset` is the signed distance of the tool axis
/// from the origin, for a plane along the direction in which a positive inclination rises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PartFace {
    /// A plane.
    Plane {
        /// Angle to the plane square to the tool; positive rises along the offset.
        inclination: f64,
        /// Offset of the tool axis.
        offset: f64,
    },
    /// The outside of a cylinder: a shaft.
    OuterCylinder {
        /// Radius.
        radius: f64,
        /// Offset of the tool axis.
        offset: f64,
    },
    /// The inside of a cylinder: a bore.
    InnerCylinder {
        /// Radius.
        radius: f64,
        /// Offset of the tool axis.
        offset: f64,
    },
}

impl PartFace {
    /// The surface over the tool's disc, its frame's origin at a height [mm].
    ///
    /// # Errors
    /// `KC0902` with the key of a number that is not finite, an inclination of 90 degrees or more, a radius that is
    /// not positive.
    pub fn surface(&self, side: Side, height: f64) -> Result<BoundarySurface> {
        let fail = |key: &str, what: &str, value: f64, bound: f64, unit: &str| {
            let finding = Finding::error(Code::DRILL_SURFACE, what).value(value, unit).bound(bound, unit);
            Error::from(finding.key(key))
        };
        let place = |offset: f64| {
            if offset.is_finite() && height.is_finite() {
                return Ok(());
            }
            Err(fail("offset", "the place of a surface is not finite", offset, 0.0, "mm"))
        };
        let (radius, offset) = match *self {
            PartFace::Plane { inclination, offset } => {
                place(offset)?;
                if !(inclination.abs() < FRAC_PI_2) {
                    let what = "the inclination of a plane must lie between -90 and 90 degrees";
                    return Err(fail("inclination", what, inclination.to_degrees(), 90.0, "deg"));
                }
                let slope = inclination.tan();
                return Ok(BoundarySurface::Plane { height: height + offset * slope, slope });
            }
            PartFace::OuterCylinder { radius, offset } | PartFace::InnerCylinder { radius, offset } => {
                (radius, offset)
            }
        };
        place(offset)?;
        if !(radius.is_finite() && radius > 0.0) {
            return Err(fail("radius", "the radius of a cylinder must be positive", radius, 0.0, "mm"));
        }
        // Seen along the feed, a shaft's top and a bore's roof are ridges.
        let outer = matches!(self, PartFace::OuterCylinder { .. });
        Ok(if outer == (side == Side::Entry) {
            BoundarySurface::Ridge { radius, offset, height }
        } else {
            BoundarySurface::Valley { radius, offset, height }
        })
    }
}

/// A boundary of the part as a height over the tool's disc; u runs level, across a cylinder's axis or up a plane, and
/// is counted from the tool axis [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoundarySurface {
    /// Height `height + slope u`.
    Plane {
        /// Height on the tool axis.
        height: f64,
        /// Rise per length.
        slope: f64,
    },
    /// The upper half of a cylinder: `height + sqrt(radius^2 - (offset + u)^2)`.
    Ridge {
        /// Radius.
        radius: f64,
        /// Offset of the tool axis from the cylinder's.
        offset: f64,
        /// Height of the cylinder's axis.
        height: f64,
    },
    /// The lower half of a cylinder.
    Valley {
        /// Radius.
        radius: f64,
        /// Offset of the tool axis from the cylinder's.
        offset: f64,
        /// Height of the cylinder's axis.
        height: f64,
    },
}

impl BoundarySurface {
    /// Height at a distance u from the tool axis [mm]; a cylinder ends where its side is upright.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::drilling::BoundarySurface;
    /// let shaft = BoundarySurface::Ridge { radius: 40.0, offset: 7.0, height: 0.0 };
    /// assert!((shaft.height(-7.0) - 40.0).abs() < 1e-12);
    /// ```
    pub fn height(&self, u: f64) -> f64 {
        let half = |radius: f64, w: f64| ((radius - w) * (radius + w)).clamp(0.0, f64::INFINITY).sqrt();
        match *self {
            BoundarySurface::Plane { height, slope } => height + slope * u,
            BoundarySurface::Ridge { radius, offset, height } => height + half(radius, offset + u),
            BoundarySurface::Valley { radius, offset, height } => height - half(radius, offset + u),
        }
    }

    /// Greatest height on a circle about the tool axis [mm].
    pub fn greatest(&self, radius: f64) -> f64 {
        match *self {
            BoundarySurface::Plane { height, slope } => height + radius * slope.abs(),
            // The highest line of a ridge, the side of a valley, within the circle.
            BoundarySurface::Ridge { offset, .. } if offset.abs() <= radius => self.height(-offset),
            BoundarySurface::Ridge { offset, .. } => self.height(-radius.copysign(offset)),
            BoundarySurface::Valley { offset, .. } => self.height(radius.copysign(offset)),
        }
    }

    /// Slope on the tool axis; infinite where a cylinder's side is upright.
    pub fn slope(&self) -> f64 {
        match *self {
            BoundarySurface::Plane { slope, .. } => slope,
            BoundarySurface::Ridge { radius, offset, .. } => {
                -offset / ((radius - offset) * (radius + offset)).sqrt()
            }
            BoundarySurface::Valley { radius, offset, .. } => {
                offset / ((radius - offset) * (radius + offset)).sqrt()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_height_on_a_circle_is_that_of_its_points() {
        for surface in [
            BoundarySurface::Plane { height: 1.0, slope: -0.3 },
            BoundarySurface::Ridge { radius: 40.0, offset: 7.0, height: 2.0 },
            BoundarySurface::Ridge { radius: 40.0, offset: -25.0, height: 0.0 },
            BoundarySurface::Valley { radius: 30.0, offset: 7.0, height: 0.0 },
            BoundarySurface::Valley { radius: 30.0, offset: -7.0, height: -5.0 },
        ] {
            for radius in [0.0, 3.0, 10.0] {
                let of = |i: u32| surface.height(radius * (f64::from(i) * 1e-3 * std::f64::consts::PI).cos());
                let most = (0..=1000).map(of).fold(f64::NEG_INFINITY, f64::max);
                assert!((surface.greatest(radius) - most).abs() < 1e-4, "{surface:?} {radius}");
            }
        }
    }
}
