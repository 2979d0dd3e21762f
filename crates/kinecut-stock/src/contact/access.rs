//! Whether a tool comes to a place of a surface without meeting anything.

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};

use super::body::Body;
use super::gap::{Convex, Gap, gap};
use super::pair::TOUCH;
use super::piece::{Piece, Placed};
use super::tool::{MovingTool, ToolPart};
use crate::geom::Rigid;

/// Angle [rad] up to which a surface counts as level or as upright to a tool: the noise of facets.
const TILT: f64 = 1e-4;
/// Times that a tool is moved away from what it meets, each by an equal part of what it may be off.
const PUSHES: u32 = 8;
/// Places about the axis of a flat end at which it is tried on a level surface.
const AROUND: u32 = 16;

/// The answer for a tool and a place, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Access {
    /// Its cutting part comes to the place, and no part of it meets the body.
    Free,
    /// Its cutting part would be free there, but shank or holder meets the body.
    Hindered(ToolPart),
    /// Its cutting part meets the body, or it has none.
    Closed,
}

impl MovingTool {
    /// Whether the cutting part can touch the plane through a place [mm] with an outward normal, so that nothing of the tool
    /// comes within 0.01 mm of a body; it may be `off` by as much [mm]: where it meets the body, it is moved away by that, so
    /// that a cutter goes into a corner of its own radius. `axis` goes from tip to holder; both are unit vectors in the
    /// coordinates of the body.
    ///
    /// On a plane square to the axis the end of a flat tool is tried about the place, in the middle and at its rim; on one
    /// along the axis the lowest place of the cylinder touches, so that the tool is as high as it can be.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::contact::{Access, Body, MovingTool, ToolPart};
    /// use kinecut::geom::{Aabb, Profile, Rigid, Solid};
    /// // A wall at X 20 over a floor at Z 0.
    /// let wall = Aabb { min: DVec3::new(20.0, -50.0, 0.0), max: DVec3::new(40.0, 50.0, 30.0) };
    /// let wall = Body::new("wall", &Solid::Box(wall), Rigid::IDENTITY, 0.0).unwrap();
    /// let access = |corner: f64, x: f64| {
    ///     let cutter = Profile::bull_nose(10.0, corner, 40.0).unwrap();
    ///     let tool = MovingTool::new([(ToolPart::Cutter, &cutter, 0.0)]);
    ///     tool.access(DVec3::new(x, 0.0, 0.0), DVec3::Z, DVec3::Z, 0.0, &wall)
    /// };
    /// // The floor 2 mm from the wall: an end mill comes there with its rim, a ball nose of radius 5 only up to 5 mm.
    /// assert_eq!((access(0.0, 18.0), access(5.0, 18.0), access(5.0, 14.9)), (Access::Free, Access::Closed, Access::Free));
    /// ```
    pub fn access(&self, place: DVec3, normal: DVec3, axis: DVec3, off: f64, body: &Body) -> Access {
        let rotation = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis));
        // Towards the surface, in coordinates of the tool; a little to the tip, so that an upright wall is touched low.
        let towards = rotation.transpose() * -normal;
        let mut best = Access::Closed;
        let mut tried = |touching: DVec3| {
            let pose = Rigid { rotation, translation: place - rotation * touching };
            best = best.min(self.at(pose, off, body));
            best == Access::Free
        };
        let Some((_, cutter)) = self.parts.iter().find(|(part, _)| *part == ToolPart::Cutter) else {
            return Access::Closed;
        };
        if towards.truncate().length() > TILT {
            if let Some(touching) = cutter.farthest(towards - TILT * DVec3::Z) {
                tried(touching);
            }
            return best;
        }
        let rim = (0..AROUND).filter_map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(AROUND)).sin_cos();
            cutter.farthest(towards + TILT * TILT * DVec3::new(cos, sin, 0.0))
        });
        let mut rim = rim.peekable();
        let middle = rim.peek().map(|p| DVec3::Z * p.z);
        middle.into_iter().chain(rim).any(tried);
        best
    }

    /// The answer where the tool is, or where it is moved by no more than `off`.
    fn at(&self, mut pose: Rigid, off: f64, body: &Body) -> Access {
        let mut best = Access::Closed;
        let axis = pose.rotation.z_axis;
        for push in 0..=PUSHES {
            // In the order of the parts: the cutter first.
            let met = self.parts.iter().find(|(_, moving)| meets(moving, &pose, body));
            let Some((part, moving)) = met else { return Access::Free };
            if *part != ToolPart::Cutter {
                best = best.min(Access::Hindered(*part));
            }
            if push == PUSHES || off <= 0.0 {
                break;
            }
            let Some(place) = nearest(moving, &pose, off, body) else { break };
            let from = pose.translation - place;
            let Some(away) = (from - axis * from.dot(axis)).try_normalize() else { break };
            pose.translation += away * (off / f64::from(PUSHES));
        }
        best
    }
}

/// Whether a body at a pose touches one that stands.
fn meets(moving: &Body, pose: &Rigid, standing: &Body) -> bool {
    let touches = |piece: &Piece| {
        let placed = Placed { piece, pose: *pose };
        let one = |other: &Piece| (gap(&placed, other, TOUCH, TOUCH).least <= TOUCH).then_some(());
        standing.find_in(piece.bounds_at(pose).grown(TOUCH), one)
    };
    standing.has_inside(pose.point(moving.a_point())) || moving.find_in(moving.bounds, touches).is_some()
}

/// The place of a standing body that is nearest to one at a pose, which goes into it no deeper than `off`; none where it
/// does.
fn nearest(moving: &Body, pose: &Rigid, off: f64, standing: &Body) -> Option<DVec3> {
    let mut best: Option<Gap> = None;
    let overlaps = |piece: &Piece| {
        let Piece::Round { place, round } = piece else { return None };
        let piece = Piece::Round { place: *place, round: round.slimmer(2.0 * off) };
        let placed = Placed { piece: &piece, pose: *pose };
        let one = |other: &Piece| {
            let found = gap(&placed, other, 0.0, best.map_or(f64::INFINITY, |b| b.most));
            if best.is_none_or(|b| found.most < b.most) {
                best = Some(found);
            }
            (found.most <= 0.0).then_some(())
        };
        standing.find_in(piece.bounds_at(pose).grown(2.0 * off + TOUCH), one)
    };
    let overlap = moving.find_in(moving.bounds, overlaps);
    best.filter(|_| overlap.is_none()).map(|b| b.place)
}

impl Body {
    /// Its farthest point in a direction of its own coordinates.
    fn farthest(&self, direction: DVec3) -> Option<DVec3> {
        let mut best: Option<DVec3> = None;
        self.pieces_in(self.bounds, |piece| {
            let point = piece.farthest(direction);
            if best.is_none_or(|b| point.dot(direction) > b.dot(direction)) {
                best = Some(point);
            }
        });
        best
    }
}
