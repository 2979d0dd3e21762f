//! The convex parts of a tool by their gauges: convex functions, negative inside, that change by no more than the way of the point.

use glam::{DVec2, DVec3};

use crate::geom::{Profile, ProfileElement};

/// A convex part: an element of a profile, and above it the cylinder of its greatest radius up to the top of the profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct GaugePart {
    element: ProfileElement,
    /// Height of its lowest point, and of its top [mm].
    bottom: f64,
    top: f64,
    /// Its greatest radius [mm].
    radius: f64,
}

/// The gauge at a point, in coordinates of the tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gauge {
    /// Not positive inside, no more than the distance outside [mm].
    pub(super) value: f64,
    /// A unit vector: the part lies where `value + normal . (q - p)` is not positive, `p` the point.
    pub(super) normal: DVec3,
}

/// A tool as a union of convex parts.
#[derive(Clone, Debug)]
pub(super) struct Gauges {
    pub(super) parts: Vec<GaugePart>,
    /// Farthest point from the tip [mm].
    pub(super) reach: f64,
}

impl Gauges {
    /// The cutting part of a tool.
    pub(super) fn of(profile: &Profile) -> Gauges {
        let top = profile.top();
        let mut parts: Vec<GaugePart> = Vec::new();
        for element in profile.elements() {
            let part = GaugePart {
                element: *element,
                bottom: element.bottom(),
                top,
                radius: element.radius(element.top()),
            };
            // A cylinder that only goes on with the one below adds nothing.
            let goes_on = |below: &GaugePart| match *element {
                ProfileElement::Cone { r0, r1, .. } => r0 == r1 && r1 <= below.radius + 1e-9,
                ProfileElement::Torus { .. } => false,
            };
            if part.bottom < top && part.radius > 0.0 && !parts.last().is_some_and(goes_on) {
                parts.push(part);
            }
        }
        let far = top.abs().max(profile.bottom().abs());
        Gauges { parts, reach: far.hypot(profile.max_radius()) }
    }

    /// True if the tool is more than one convex part.
    pub(super) fn is_parted(&self) -> bool {
        self.parts.len() > 1
    }

    /// The least gauge of the parts at a point.
    pub(super) fn at(&self, x: DVec3) -> Gauge {
        let least = |a: Gauge, b: Gauge| if b.value < a.value { b } else { a };
        let none = Gauge { value: f64::INFINITY, normal: DVec3::Z };
        self.parts.iter().map(|part| part.at(x)).fold(none, least)
    }
}

impl GaugePart {
    /// Its greatest diameter [mm].
    pub(super) fn width(&self) -> f64 {
        2.0 * self.radius
    }

    /// The gauge at a point from the tip, the axis along Z.
    pub(super) fn at(&self, x: DVec3) -> Gauge {
        let rho = x.truncate().length();
        let radial = if rho > 0.0 { DVec3::new(x.x / rho, x.y / rho, 0.0) } else { DVec3::X };
        // Side, floor and top are planes in the half plane of distance from the axis and height.
        let mut gauge = Gauge { value: rho - self.radius, normal: radial };
        let mut or = |value: f64, normal: DVec3| {
            if value > gauge.value {
                gauge = Gauge { value, normal };
            }
        };
        or(x.z - self.top, DVec3::Z);
        or(self.bottom - x.z, -DVec3::Z);
        match self.element {
            ProfileElement::Cone { z0, r0, z1, r1 } => {
                let (rise, widening) = (z1 - z0, r1 - r0);
                let length = rise.hypot(widening);
                if rise > 0.0 && widening > 0.0 {
                    let (n_r, n_z) = (rise / length, -widening / length);
                    or(n_r * (rho - r0) + n_z * (x.z - z0), radial * n_r + DVec3::Z * n_z);
                }
            }
            ProfileElement::Torus { centre_radius, centre_z, radius, .. } => {
                // Above its centre the arc goes on as the side.
                let (beside, above) = (rho - centre_radius, x.z - centre_z);
                if above < 0.0 {
                    let beside = if centre_radius > 0.0 { beside.max(0.0) } else { beside };
                    let length = DVec2::new(beside, above).length();
                    or(length - radius, (radial * beside + DVec3::Z * above) / length);
                }
            }
        }
        gauge
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tools() -> Vec<Profile> {
        let cone = |z0: f64, r0: f64, z1: f64, r1: f64| ProfileElement::Cone { z0, r0, z1, r1 };
        let torus = |centre_radius: f64, centre_z: f64, radius: f64, z0: f64, z1: f64| {
            ProfileElement::Torus { centre_radius, centre_z, radius, z0, z1 }
        };
        vec![
            Profile::cylinder(6.0, 20.0).unwrap(),
            Profile::bull_nose(6.0, 3.0, 20.0).unwrap(),
            Profile::bull_nose(8.0, 1.0, 20.0).unwrap(),
            Profile::new(vec![cone(0.0, 0.0, 2.0, 3.0), cone(2.0, 3.0, 20.0, 3.0)]).unwrap(),
            Profile::new(vec![cone(0.0, 1.0, 5.0, 1.5), cone(5.0, 4.0, 8.0, 6.0)]).unwrap(),
            // A barrel: its arc is centred beyond the axis.
            Profile::new(vec![torus(-16.0, 12.0, 20.0, 2.0, 12.0), cone(12.0, 4.0, 15.0, 4.0)]).unwrap(),
        ]
    }

    #[test]
    fn the_sign_is_that_of_the_profile_and_the_tangent_plane_holds_the_part() {
        for profile in tools() {
            let tool = Gauges::of(&profile);
            let grid = |i: u32| (f64::from(i) - 20.0) * 0.51 + 0.013;
            for (i, k) in (0..41).flat_map(|i| (0..61).map(move |k| (i, k))) {
                let x = DVec3::new(grid(i), 0.3 * grid(i) + 0.1, grid(k) + 8.0);
                let rho = x.x.hypot(x.y);
                let inside = x.z > profile.bottom() && x.z < profile.top() && rho < profile.radius(x.z);
                let gauge = tool.at(x);
                assert_eq!(gauge.value < 0.0, inside, "{profile:?} {x} {gauge:?}");
                assert!((gauge.normal.length() - 1.0).abs() < 1e-12);
                for part in &tool.parts {
                    let gauge = part.at(x);
                    for (j, l) in (0..41).step_by(5).flat_map(|j| (0..61).step_by(5).map(move |l| (j, l))) {
                        let q = DVec3::new(0.9 * grid(j), -grid(j) + 0.2, grid(l) + 8.0);
                        let tangent = gauge.value + gauge.normal.dot(q - x);
                        assert!(part.at(q).value >= tangent - 1e-12, "{profile:?} {x} {q}");
                    }
                }
            }
        }
    }
}
