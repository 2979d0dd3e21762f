//! Test that a grazing point is on the boundary of the swept volume, judged by the neighbouring moments.
//!
//! The signed distance F of the moving tool from the point that stays has no slope in time at a grazing point. Its second
//! derivative is `km (V t)^2 + kp (V e)^2 - n (v' + w' p - w x V)` with the curvatures of the tool along and around its profile:
//! positive on the boundary, negative inside of the swept volume, zero at a cusp edge of the envelope.

use glam::{DVec2, DVec3};

use crate::sweep::{ChainPiece, MotionJet, PieceShape};

/// Radius below which a point lies on the axis [mm].
const ON_AXIS: f64 = 1e-12;

/// The second derivative of the distance by time at a grazing point in direction `e` across the axis. Infinite on edges:
/// positive on convex ones, which stay on the boundary, negative on concave ones, which never come to it.
pub(super) fn second(jet: &MotionJet, piece: &ChainPiece, u: f64, e: DVec2) -> f64 {
    let (place, normal, _) = piece.place(u);
    if piece.is_fan() {
        return if piece.is_convex() { f64::INFINITY } else { f64::NEG_INFINITY };
    }
    let p = (e * place.x).extend(place.y);
    let n = (e * normal.x).extend(normal.y);
    let along = (e * -normal.y).extend(normal.x);
    let around = e.perp().extend(0.0);
    let v = jet.twist.velocity(p);
    let bend_along = match piece.shape {
        PieceShape::Line { .. } => 0.0,
        PieceShape::Arc { radius, .. } => 1.0 / radius,
    };
    // On the axis a sphere bends as everywhere, and a disc not at all.
    let bend_around = if place.x > ON_AXIS { normal.x / place.x } else { bend_along };
    let square = |x: DVec3| v.dot(x) * v.dot(x);
    let drift = jet.change.velocity(p) - jet.twist.turn.cross(v);
    bend_along * square(along) + bend_around * square(around) - n.dot(drift)
}
