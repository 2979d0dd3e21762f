//! Convex pieces that bodies and tools are made of.

use glam::DVec3;

use super::gap::Convex;
use super::round::Round;
use crate::geom::{Aabb, Rigid};

/// A convex piece of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// A box in coordinates of its own.
    Box { place: Rigid, bounds: Aabb },
    /// A cylinder along the Z of coordinates of its own, from the height 0.
    Drum { place: Rigid, radius: f64, height: f64 },
    /// A part of a tool.
    Round { place: Rigid, round: Round },
    /// A triangle.
    Triangle([DVec3; 3]),
}

impl Piece {
    /// A box that holds it when the coordinates in which it is given are moved.
    pub(super) fn bounds_at(&self, pose: &Rigid) -> Aabb {
        match self {
            Piece::Round { place, round } => round.bounds(&pose.after(place)),
            Piece::Triangle(corners) => Aabb::of_points(corners.map(|p| pose.point(p))),
            Piece::Box { .. } | Piece::Drum { .. } => {
                let moved = Placed { piece: self, pose: *pose };
                let reach = |axis: DVec3| [-axis, axis].map(|d| moved.farthest(d).dot(axis));
                let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(reach);
                Aabb { min: [x[0], y[0], z[0]].into(), max: [x[1], y[1], z[1]].into() }
            }
        }
    }
}

impl Convex for Piece {
    fn farthest(&self, d: DVec3) -> DVec3 {
        match self {
            Piece::Box { place, bounds } => {
                let own = place.rotation.transpose() * d;
                place.point(DVec3::select(own.cmpge(DVec3::ZERO), bounds.max, bounds.min))
            }
            Piece::Drum { place, radius, height } => {
                let own = place.rotation.transpose() * d;
                let rim = own.truncate().normalize_or_zero() * *radius;
                place.point(rim.extend(if own.z > 0.0 { *height } else { 0.0 }))
            }
            Piece::Round { place, round } => place.point(round.farthest(place.rotation.transpose() * d)),
            Piece::Triangle(corners) => {
                let mut best = corners[0];
                for corner in &corners[1..] {
                    if corner.dot(d) > best.dot(d) {
                        best = *corner;
                    }
                }
                best
            }
        }
    }
}

/// A piece that has moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    pub(super) piece: &'a Piece,
    pub(super) pose: Rigid,
}

impl Convex for Placed<'_> {
    fn farthest(&self, direction: DVec3) -> DVec3 {
        self.pose.point(self.piece.farthest(self.pose.rotation.transpose() * direction))
    }
}

/// The hull of two places of a piece: what lies between them if it goes straight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between<'a>(pub(super) [Placed<'a>; 2]);

impl Convex for Between<'_> {
    fn farthest(&self, direction: DVec3) -> DVec3 {
        let [p, q] = self.0.map(|placed| placed.farthest(direction));
        if p.dot(direction) >= q.dot(direction) { p } else { q }
    }
}
