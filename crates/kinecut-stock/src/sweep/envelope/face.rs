//! A piece of the tool as a face of its half-section: distance of a nearby point from it.

use glam::DVec2;

use crate::sweep::{ChainPiece, PieceShape};

/// Distance of a point from a piece where it is nearest to the point's own normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    /// Signed distance, positive outside [mm].
    pub distance: f64,
    /// Normal through the point: away from the axis and along it.
    pub normal: DVec2,
    /// Bend of the surface of equal distance through the point, along the profile [1/mm].
    pub bend: f64,
}

/// A piece with what its ends are.
#[derive(Clone, Copy, Debug)]
pub(super) enum EnvelopeFace {
    Line {
        start: DVec2,
        tangent: DVec2,
        normal: DVec2,
        length: f64,
    },
    /// A piece with its ends.
    Arc {
        centre: DVec2,
        radius: f64,
        normals: [DVec2; 2],
    },
    /// A concave edge, to which nothing outside of the tool is nearest.
    Hollow,
}

/// Length beyond its ends to which a piece is still taken: by way [mm] of a line, by sine of the angle of an arc.
const BEYOND: f64 = 1e-9;

impl EnvelopeFace {
    pub(super) fn new(piece: &ChainPiece) -> EnvelopeFace {
        match piece.shape {
            PieceShape::Line { start, tangent, normal } => {
                EnvelopeFace::Line { start, tangent, normal, length: piece.to }
            }
            _ if piece.is_fan() && !piece.is_convex() => EnvelopeFace::Hollow,
            PieceShape::Arc { centre, radius } => {
                let normals = [piece.from.min(piece.to), piece.from.max(piece.to)].map(DVec2::from_angle);
                EnvelopeFace::Arc { centre, radius, normals }
            }
        }
    }

    /// The distance of a point of the half-plane; none where the piece ends before the point's normal meets it.
    #[inline]
    pub(super) fn beside(&self, q: DVec2) -> Option<Beside> {
        match *self {
            EnvelopeFace::Line { start, tangent, normal, length } => {
                let r = q - start;
                let along = r.dot(tangent);
                (along >= -BEYOND && along <= length + BEYOND).then(|| Beside {
                    distance: r.dot(normal),
                    normal,
                    bend: 0.0,
                })
            }
            EnvelopeFace::Arc { centre, radius, normals } => {
                let sense = if radius < 0.0 { -1.0 } else { 1.0 };
                let r = q - centre;
                let far = r.length();
                if far == 0.0 {
                    // The edge itself.
                    let normal = (normals[0] + normals[1]).try_normalize().unwrap_or(normals[0].perp());
                    return (radius == 0.0).then_some(Beside { distance: 0.0, normal, bend: f64::INFINITY });
                }
                let normal = r * (sense / far);
                let inside = normals[0].perp_dot(normal) >= -BEYOND && normal.perp_dot(normals[1]) >= -BEYOND;
                inside.then(|| Beside { distance: sense * far - radius, normal, bend: sense / far })
            }
            EnvelopeFace::Hollow => None,
        }
    }
}
