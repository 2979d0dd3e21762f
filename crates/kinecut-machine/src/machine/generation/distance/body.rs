//! Distances of the elementary bodies in closed form.

use glam::{DVec2, DVec3};

use super::Distance;

/// An elementary body. Axes need not be unit vectors; one without length counts as Z.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::machine::generation::{ElementaryBody, Distance};
/// let torus = ElementaryBody::Torus { centre: DVec3::ZERO, axis: DVec3::Z, major: 40.0, minor: 10.0 };
/// assert_eq!(torus.signed(DVec3::new(40.0, 0.0, 25.0)), 15.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementaryBody {
    /// The points behind a plane: the flank of a rack, a face.
    HalfSpace {
        /// A point of the plane [mm].
        point: DVec3,
        /// Normal, out of the material.
        normal: DVec3,
    },
    /// A ball; of radius zero a point.
    Ball {
        /// Centre [mm].
        centre: DVec3,
        /// Radius [mm].
        radius: f64,
    },
    /// An endless cylinder; of radius zero a line.
    Cylinder {
        /// A point of the axis [mm].
        point: DVec3,
        /// Direction of the axis.
        axis: DVec3,
        /// Radius [mm].
        radius: f64,
    },
    /// One nappe of a cone, endless.
    Cone {
        /// Apex [mm].
        apex: DVec3,
        /// Direction from the apex into the cone.
        axis: DVec3,
        /// Angle between the axis and the flank [rad], up to a right angle.
        half_angle: f64,
    },
    /// A ring.
    Torus {
        /// Centre [mm].
        centre: DVec3,
        /// Direction of the axis.
        axis: DVec3,
        /// Radius of the circle of centres [mm].
        major: f64,
        /// Radius of the section [mm].
        minor: f64,
    },
}

/// Distance from an axis, and height along it.
fn polar(p: DVec3, on_axis: DVec3, axis: DVec3) -> DVec2 {
    let (a, v) = (axis.try_normalize().unwrap_or(DVec3::Z), p - on_axis);
    DVec2::new(a.cross(v).length(), a.dot(v))
}

impl Distance for ElementaryBody {
    fn signed(&self, p: DVec3) -> f64 {
        match *self {
            ElementaryBody::HalfSpace { point, normal } => {
                normal.try_normalize().unwrap_or(DVec3::Z).dot(p - point)
            }
            ElementaryBody::Ball { centre, radius } => (p - centre).length() - radius,
            ElementaryBody::Cylinder { point, axis, radius } => polar(p, point, axis).x - radius,
            ElementaryBody::Cone { apex, axis, half_angle } => {
                let at = polar(p, apex, axis);
                let flank = DVec2::from_angle(std::f64::consts::FRAC_PI_2 - half_angle);
                let along = at.dot(flank);
                // Beyond the apex the apex is nearest.
                if along <= 0.0 { at.length() } else { flank.y * at.x - flank.x * at.y }
            }
            ElementaryBody::Torus { centre, axis, major, minor } => {
                let at = polar(p, centre, axis);
                (at.x - major).hypot(at.y) - minor
            }
        }
    }
}
