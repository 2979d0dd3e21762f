//! Bodies that stand beside the workpiece: fixtures and clamps.

use glam::DVec3;

use super::gap::Convex;
use super::tree::Tree;
use crate::base::Result;
use crate::geom::{Aabb, MeshDistance, Rigid, Solid};

/// A body that stands while the tool moves.
#[derive(Clone, Debug)]
pub struct StandingBody {
    /// Name in words.
    pub name: String,
    /// The least distance that the tool is to keep [mm]; nearer is a warning, zero asks for none.
    pub near: f64,
    pub(super) bounds: Aabb,
    pieces: Pieces,
}

#[derive(Clone, Debug)]
enum Pieces {
    /// A convex body.
    One(Piece),
    /// The triangles of a closed mesh in the coordinates of the moves.
    /// `inside`: the sign of a distance from within, whichever way the triangles turn.
    Triangles {
        triangles: Vec<[DVec3; 3]>,
        tree: Tree,
        distance: Box<MeshDistance>,
        inside: f64,
        back: Rigid,
    },
}

/// A convex piece of a body.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    /// A box in coordinates of its own.
    Box { place: Rigid, bounds: Aabb },
    /// A cylinder along the Z of coordinates of its own, from the height 0.
    Drum { place: Rigid, radius: f64, height: f64 },
    /// A triangle.
    Triangle([DVec3; 3]),
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

impl StandingBody {
    /// A solid at a place in the coordinates of the moves, with the distance that the tool is to keep [mm].
    ///
    /// # Errors
    /// `KC0602` for a mesh that is not closed.
    pub fn new(name: impl Into<String>, solid: &Solid, place: Rigid, near: f64) -> Result<StandingBody> {
        let pieces = match solid {
            Solid::Box(bounds) => Pieces::One(Piece::Box { place, bounds: *bounds }),
            Solid::Cylinder { base, radius, height } => {
                let place = place.after(&Rigid::from_translation(*base));
                Pieces::One(Piece::Drum { place, radius: *radius, height: *height })
            }
            Solid::Mesh(mesh) => {
                let corner = |i: u32| place.point(mesh.vertices[i as usize]);
                let triangles: Vec<_> = mesh.triangles.iter().map(|t| t.map(corner)).collect();
                let tree = Tree::new(triangles.iter().map(|t| Aabb::of_points(*t)).collect());
                let distance = Box::new(MeshDistance::new(mesh)?);
                let inside = -1f64.copysign(mesh.volume());
                Pieces::Triangles { triangles, tree, distance, inside, back: place.inverse() }
            }
        };
        let bounds = match &pieces {
            Pieces::One(piece) => {
                let reach = |axis: DVec3| [piece.farthest(-axis).dot(axis), piece.farthest(axis).dot(axis)];
                let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(reach);
                Aabb { min: [x[0], y[0], z[0]].into(), max: [x[1], y[1], z[1]].into() }
            }
            Pieces::Triangles { triangles, .. } => Aabb::of_points(triangles.iter().flatten().copied()),
        };
        Ok(StandingBody { name: name.into(), near, bounds, pieces })
    }

    /// Calls a function with each piece whose box meets another, until it says that it is enough.
    pub(super) fn pieces_in(&self, region: Aabb, mut each: impl FnMut(&Piece) -> bool) {
        match &self.pieces {
            Pieces::One(piece) => {
                if self.bounds.meets(region) {
                    each(piece);
                }
            }
            Pieces::Triangles { triangles, tree, .. } => {
                tree.each(region, |i| each(&Piece::Triangle(triangles[i])));
            }
        }
    }

    /// Whether a point is within a body of triangles; of others no point has to be asked about.
    pub(super) fn has_inside(&self, p: DVec3) -> bool {
        match &self.pieces {
            Pieces::One(_) => false,
            Pieces::Triangles { distance, inside, back, .. } => {
                let region = Aabb { min: p, max: p };
                self.bounds.meets(region) && distance.signed(back.point(p)) * inside > 0.0
            }
        }
    }
}
