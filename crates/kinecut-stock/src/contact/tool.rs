//! A tool with shank and holder: bodies about one axis.

use super::body::Body;
use super::piece::Piece;
use super::round::Round;
use crate::geom::{Profile, Rigid};

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

/// A tool that moves, in coordinates of its own: the tip is the origin, Z goes to the holder.
#[derive(Clone, Debug)]
pub struct MovingTool {
    /// The parts that there are, in the order of [`ToolPart`].
    pub(super) parts: Vec<(ToolPart, Body)>,
}

impl MovingTool {
    /// A tool of profiles, each with its part and its height above the tip [mm].
    pub fn new<'a>(profiles: impl IntoIterator<Item = (ToolPart, &'a Profile, f64)>) -> MovingTool {
        let mut pieces: Vec<(ToolPart, Piece)> = Vec::new();
        for (part, profile, above) in profiles {
            let mut widest = f64::NEG_INFINITY;
            for element in profile.elements() {
                let round = Round::new(element, above, profile.top() + above);
                // An element inside of the cylinder above the one before adds nothing.
                if round.width() > widest {
                    widest = round.width();
                    pieces.push((part, Piece::Round { place: Rigid::IDENTITY, round }));
                }
            }
        }
        let part = |part: ToolPart| {
            let own: Vec<Piece> =
                pieces.iter().filter(|(p, _)| *p == part).map(|(_, piece)| *piece).collect();
            (!own.is_empty()).then(|| (part, Body::convex(String::new(), own, true)))
        };
        let parts = [ToolPart::Cutter, ToolPart::Shank, ToolPart::Holder];
        MovingTool { parts: parts.into_iter().filter_map(part).collect() }
    }

    /// Its parts as bodies.
    pub(super) fn bodies(&self) -> impl Iterator<Item = &Body> + Clone {
        self.parts.iter().map(|(_, body)| body)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::gap::Convex;
    use super::super::piece::Placed;
    use super::*;
    use crate::geom::ProfileElement;

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
        let [(ToolPart::Cutter, body)] = &tool.parts[..] else { panic!() };
        let mut pieces = Vec::new();
        body.pieces_in(body.bounds, |piece| pieces.push(*piece));
        assert_eq!(pieces.len(), 3);
        assert!((body.bounds.max - DVec3::new(10.0, 10.0, 20.0)).length() < 1e-12);
        let pose = Rigid::from_translation(DVec3::new(1.0, 2.0, 3.0));
        for i in 0..1000 {
            let (a, b) = (f64::from(i) * 0.37, (f64::from(i) * 0.73).sin());
            let across = (1.0 - b * b).sqrt();
            let d = DVec3::new(a.cos() * across, a.sin() * across, b);
            let far = |piece: &Piece| Placed { piece, pose }.farthest(d).dot(d);
            let most = pieces.iter().map(far).fold(f64::NEG_INFINITY, f64::max);
            let expected = profile.support(across, b) + pose.translation.dot(d);
            assert!((most - expected).abs() < 1e-12, "{most} {expected}");
        }
        // Its boxes are those of its farthest points.
        for i in 0..100 {
            let turn = DVec3::new(f64::from(i), f64::from(i * i % 17), f64::from(i % 5)) * 0.31;
            let rotation = glam::DMat3::from_quat(glam::DQuat::from_scaled_axis(turn));
            let pose = Rigid { rotation, ..pose };
            for piece in &pieces {
                let bounds = piece.bounds_at(&pose);
                for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                    let [low, high] = [-axis, axis].map(|d| Placed { piece, pose }.farthest(d).dot(axis));
                    assert!((bounds.min.dot(axis) - low).abs() + (bounds.max.dot(axis) - high).abs() < 1e-12);
                }
            }
        }
    }
}
