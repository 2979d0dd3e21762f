//! A tool with shank and holder as convex parts about one axis.

use glam::DVec3;

use super::gap::Convex;
use crate::geom::{Aabb, Profile, ProfileElement, Rigid};

/// A part of a tool, as a finding names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ToolPart {
    /// From the tip to the end of the cutting edges.
    Cutter,
    /// From there to the holder.
    Shank,
    /// The holder.
    Holder,
}

/// A convex body about the Z of the tool: an element of a profile, and the cylinder from it to the top of the profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Round {
    pub(super) part: ToolPart,
    /// Circles at the ends of the foot, and at the top: height above the tip and radius [mm].
    circles: [[f64; 2]; 3],
    /// Arc of the foot: distance of its centre from the axis, height of the centre, radius [mm].
    arc: Option<[f64; 3]>,
}

/// A tool that moves: its convex parts.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingTool {
    pub(super) rounds: Vec<Round>,
    /// Farthest point from the tip [mm].
    pub(super) reach: f64,
}

impl MovingTool {
    /// A tool of profiles, each with its part and its height above the tip [mm].
    pub fn new<'a>(profiles: impl IntoIterator<Item = (ToolPart, &'a Profile, f64)>) -> MovingTool {
        let mut rounds = Vec::new();
        for (part, profile, above) in profiles {
            let mut widest = f64::NEG_INFINITY;
            for element in profile.elements() {
                let round = Round::new(part, element, above, profile.top() + above);
                // An element inside of the cylinder above the one before adds nothing.
                if round.circles[1][1] > widest {
                    widest = round.circles[1][1];
                    rounds.push(round);
                }
            }
        }
        let far = |round: &Round| round.circles.iter().map(|[z, r]| z.hypot(*r)).fold(0.0, f64::max);
        let reach = rounds.iter().map(far).fold(0.0, f64::max);
        MovingTool { rounds, reach }
    }
}

impl Round {
    fn new(part: ToolPart, element: &ProfileElement, above: f64, top: f64) -> Round {
        match *element {
            ProfileElement::Cone { z0, r0, z1, r1 } => {
                Round { part, circles: [[z0 + above, r0], [z1 + above, r1], [top, r1]], arc: None }
            }
            ProfileElement::Torus { centre_radius, centre_z, radius, z0, z1 } => {
                let [low, high] = [z0, z1].map(|z| element.radius(z));
                Round {
                    part,
                    circles: [[z0 + above, low], [z1 + above, high], [top, high]],
                    arc: Some([centre_radius, centre_z + above, radius]),
                }
            }
        }
    }

    /// Height of its lowest circle above the tip [mm].
    pub(super) fn lowest(&self) -> f64 {
        self.circles[0][0]
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

    /// The farthest point in a direction of the tool's own coordinates.
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

/// A part of a tool at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    pub(super) round: &'a Round,
    pub(super) pose: Rigid,
}

impl Convex for Placed<'_> {
    fn farthest(&self, direction: DVec3) -> DVec3 {
        let own = self.pose.rotation.transpose() * direction;
        self.pose.point(self.round.farthest(own))
    }
}

/// The hull of two places of a part: what lies between them if it goes straight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between<'a>(pub(super) [Placed<'a>; 2]);

impl Convex for Between<'_> {
    fn farthest(&self, direction: DVec3) -> DVec3 {
        let [p, q] = self.0.map(|placed| placed.farthest(direction));
        if p.dot(direction) >= q.dot(direction) { p } else { q }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_point_is_that_of_the_profile() {
        let profile = Profile::new(vec![
            ProfileElement::Torus { centre_radius: 3.0, centre_z: 2.0, radius: 2.0, z0: 0.0, z1: 2.0 },
            ProfileElement::Cone { z0: 2.0, r0: 5.0, z1: 9.0, r1: 5.0 },
            ProfileElement::Cone { z0: 9.0, r0: 5.0, z1: 12.0, r1: 8.0 },
            ProfileElement::Cone { z0: 12.0, r0: 10.0, z1: 20.0, r1: 10.0 },
        ])
        .unwrap();
        let tool = MovingTool::new([(ToolPart::Cutter, &profile, 0.0)]);
        assert_eq!(tool.rounds.len(), 3);
        assert!((tool.reach - 20f64.hypot(10.0)).abs() < 1e-12);
        let pose = Rigid::from_translation(DVec3::new(1.0, 2.0, 3.0));
        for i in 0..1000 {
            let (a, b) = (f64::from(i) * 0.37, (f64::from(i) * 0.73).sin());
            let across = (1.0 - b * b).sqrt();
            let d = DVec3::new(a.cos() * across, a.sin() * across, b);
            let far = |round: &Round| Placed { round, pose }.farthest(d).dot(d);
            let most = tool.rounds.iter().map(far).fold(f64::NEG_INFINITY, f64::max);
            let expected = profile.support(across, b) + pose.translation.dot(d);
            assert!((most - expected).abs() < 1e-12, "{most} {expected}");
        }
        // Its boxes are those of its farthest points.
        for i in 0..100 {
            let turn = DVec3::new(f64::from(i), f64::from(i * i % 17), f64::from(i % 5)) * 0.31;
            let rotation = glam::DMat3::from_quat(glam::DQuat::from_scaled_axis(turn));
            let pose = Rigid { rotation, ..pose };
            for round in &tool.rounds {
                let bounds = round.bounds(&pose);
                for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                    let [low, high] = [-axis, axis].map(|d| Placed { round, pose }.farthest(d).dot(axis));
                    assert!((bounds.min.dot(axis) - low).abs() + (bounds.max.dot(axis) - high).abs() < 1e-12);
                }
            }
        }
    }
}
