//! Convex bodies about the axis of a tool.

use glam::DVec3;

use super::gap::Convex;
use crate::geom::{Aabb, ProfileElement, Rigid};

/// A convex body about the Z of the tool: an element of a profile, and the cylinder from it to the top of the profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Round {
    /// Circles at the ends of the foot, and at the top: height above the tip and radius [mm].
    circles: [[f64; 2]; 3],
    /// Arc of the foot: distance of its centre from the axis, height of the centre, radius [mm].
    arc: Option<[f64; 3]>,
}

impl Round {
    pub(super) fn new(element: &ProfileElement, above: f64, top: f64) -> Round {
        match *element {
            ProfileElement::Cone { z0, r0, z1, r1 } => {
                Round { circles: [[z0 + above, r0], [z1 + above, r1], [top, r1]], arc: None }
            }
            ProfileElement::Torus { centre_radius, centre_z, radius, z0, z1 } => {
                let [low, high] = [z0, z1].map(|z| element.radius(z));
                Round {
                    circles: [[z0 + above, low], [z1 + above, high], [top, high]],
                    arc: Some([centre_radius, centre_z + above, radius]),
                }
            }
        }
    }

    /// One that is smaller by about so much [mm] but for its top; of a foot without arc along the axis and across it.
    pub(super) fn slimmer(&self, by: f64) -> Round {
        let [[z0, r0], upper, top] = self.circles;
        let thinner = |r: f64| (r - by).max(0.0);
        let arc = self.arc.filter(|arc| arc[2] > by).map(|[centre, z, radius]| [centre, z, radius - by]);
        Round {
            circles: [
                [z0 + by, thinner(r0)],
                [upper[0].max(z0 + by), thinner(upper[1])],
                [top[0], thinner(top[1])],
            ],
            arc,
        }
    }

    /// Radius of the cylinder above the foot [mm].
    pub(super) fn width(&self) -> f64 {
        self.circles[1][1]
    }

    /// Greatest distance from the plane through the tip in a direction, by its components across the axis (not negative) and along
    /// it, which make a unit vector.
    fn reach(&self, radial: f64, axial: f64) -> f64 {
        let mut most = f64::NEG_INFINITY;
        for [z, r] in self.circles {
            most = most.max(z * axial + r * radial);
        }
        if let Some([centre, height, radius]) = self.arc {
            let z = height + radius * axial;
            if z >= self.circles[0][0] && z <= self.circles[1][0] {
                most = most.max(height * axial + centre * radial + radius);
            }
        }
        most
    }

    /// A box that holds it at a pose.
    pub(super) fn bounds(&self, pose: &Rigid) -> Aabb {
        let axis = pose.rotation.z_axis;
        let mut bounds = Aabb { min: pose.translation, max: pose.translation };
        for i in 0..3 {
            let radial = ((1.0 - axis[i]) * (1.0 + axis[i])).max(0.0).sqrt();
            bounds.max[i] += self.reach(radial, axis[i]);
            bounds.min[i] -= self.reach(radial, -axis[i]);
        }
        bounds
    }
}

impl Convex for Round {
    fn farthest(&self, d: DVec3) -> DVec3 {
        let across = d.truncate();
        let radial = across.length();
        let out = if radial > 0.0 { across / radial } else { glam::DVec2::X };
        let mut best = self.circles[0];
        let says = |[z, r]: [f64; 2]| z * d.z + r * radial;
        for circle in &self.circles[1..] {
            if says(*circle) > says(best) {
                best = *circle;
            }
        }
        if let Some([centre, height, radius]) = self.arc {
            let length = radial.hypot(d.z);
            let point = [height + radius * d.z / length, centre + radius * radial / length];
            // Only within the arc; elsewhere an end of it is farther.
            if point[0] >= self.circles[0][0] && point[0] <= self.circles[1][0] && says(point) > says(best) {
                best = point;
            }
        }
        (out * best[1]).extend(best[0])
    }
}
