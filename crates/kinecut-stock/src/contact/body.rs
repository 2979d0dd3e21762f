//! Bodies: clamps, a vise, parts of a tool, of a machine.

use glam::DVec3;

use super::gap::Convex;
use super::motion::{Ball, Moment, Standing};
use super::pair::Pair;
use super::piece::{Between, Piece, Placed};
use super::tree::Tree;
use crate::base::Result;
use crate::geom::{Aabb, MeshDistance, Rigid, Solid};

/// A body that stands or moves, made of convex pieces.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name in words.
    pub name: String,
    /// The least distance that others are to keep [mm]; nearer is a warning, zero asks for none.
    pub near: f64,
    /// Distance by which it may be off its place, or others off theirs [mm]: bodies that come nearer may meet it. Zero where all is where it is said to be.
    pub off: f64,
    pub(super) bounds: Aabb,
    /// A ball that holds it.
    pub(super) ball: Ball,
    /// A turn about its Z changes nothing.
    pub(super) round: bool,
    pieces: Pieces,
}

#[derive(Clone, Debug)]
enum Pieces {
    /// Convex pieces, few.
    Convex(Vec<Piece>),
    /// The triangles of a closed mesh.
    /// `inside`: the sign of a distance from within, whichever way the triangles turn.
    Triangles {
        triangles: Vec<Piece>,
        tree: Tree,
        distance: Box<MeshDistance>,
        inside: f64,
        /// Into the coordinates of the mesh.
        back: Rigid,
    },
}

impl Body {
    /// A solid at a place, with the distance that others are to keep [mm].
    ///
    /// # Errors
    /// `KC0602` for a mesh that is not closed.
    pub fn new(name: impl Into<String>, solid: &Solid, place: Rigid, near: f64) -> Result<Body> {
        let pieces = match solid {
            Solid::Box(bounds) => Pieces::Convex(vec![Piece::Box { place, bounds: *bounds }]),
            Solid::Cylinder { base, radius, height } => {
                let place = place.after(&Rigid::from_translation(*base));
                Pieces::Convex(vec![Piece::Drum { place, radius: *radius, height: *height }])
            }
            Solid::Mesh(mesh) => {
                let corner = |i: u32| place.point(mesh.vertices[i as usize]);
                let triangles: Vec<_> =
                    mesh.triangles.iter().map(|t| Piece::Triangle(t.map(corner))).collect();
                let boxes = triangles.iter().map(|t| t.bounds_at(&Rigid::IDENTITY)).collect();
                let distance = Box::new(MeshDistance::new(mesh)?);
                let inside = -1f64.copysign(mesh.volume());
                Pieces::Triangles {
                    triangles,
                    tree: Tree::new(boxes),
                    distance,
                    inside,
                    back: place.inverse(),
                }
            }
        };
        Ok(Body::of(name.into(), near, pieces, false))
    }

    /// Memory that a body of a solid needs [bytes].
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::contact::Body;
    /// use kinecut::geom::{Aabb, Mesh, Solid};
    /// let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    /// let mesh = Mesh { vertices: corners.map(Into::into).to_vec(), triangles };
    /// assert!((400..800).contains(&(Body::memory(&Solid::Mesh(mesh)) / 4)));
    /// ```
    pub fn memory(solid: &Solid) -> u64 {
        match solid {
            Solid::Box(_) | Solid::Cylinder { .. } => size_of::<Piece>() as u64,
            Solid::Mesh(mesh) => Body::memory_of_mesh(mesh.triangles.len()),
        }
    }

    /// Memory that a body of so many triangles needs [bytes].
    pub fn memory_of_mesh(triangles: usize) -> u64 {
        (triangles * size_of::<Piece>()) as u64 + Tree::memory(triangles) + MeshDistance::memory(triangles)
    }

    /// Memory that its pieces hold [bytes].
    pub fn memory_held(&self) -> u64 {
        match &self.pieces {
            Pieces::Convex(all) => (all.capacity() * size_of::<Piece>()) as u64,
            Pieces::Triangles { triangles, tree, distance, .. } => {
                let own = (triangles.capacity() * size_of::<Piece>()) as u64;
                own + tree.memory_held() + distance.memory_held()
            }
        }
    }

    /// A body of convex pieces.
    pub(super) fn convex(name: String, pieces: Vec<Piece>, round: bool) -> Body {
        Body::of(name, 0.0, Pieces::Convex(pieces), round)
    }

    fn of(name: String, near: f64, pieces: Pieces, round: bool) -> Body {
        let (Pieces::Convex(all) | Pieces::Triangles { triangles: all, .. }) = &pieces;
        let whole = |sum: Aabb, piece: &Piece| sum.union(piece.bounds_at(&Rigid::IDENTITY));
        let bounds = all.iter().fold(Aabb::EMPTY, whole);
        let ball = Ball { centre: 0.5 * (bounds.min + bounds.max), radius: 0.5 * bounds.size().length() };
        Body { name, near, off: 0.0, bounds, ball, round, pieces }
    }

    /// The body where it, or what passes it, may be so far off [mm].
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::contact::Body;
    /// use kinecut::geom::{Aabb, Rigid, Solid};
    /// let cube = Solid::Box(Aabb { min: DVec3::ZERO, max: DVec3::splat(10.0) });
    /// let body = Body::new("cube", &cube, Rigid::IDENTITY, 0.5).unwrap();
    /// assert_eq!((body.off, body.off_by(0.07).off), (0.0, 0.07));
    /// ```
    #[must_use]
    pub fn off_by(self, off: f64) -> Body {
        Body { off, ..self }
    }

    /// Whether it touches another body, both where they are.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::contact::Body;
    /// use kinecut::geom::{Aabb, Rigid, Solid};
    /// let cube = Solid::Box(Aabb { min: DVec3::ZERO, max: DVec3::splat(10.0) });
    /// let at = |x: f64| Body::new("cube", &cube, Rigid::from_translation(DVec3::X * x), 0.0).unwrap();
    /// assert!(at(0.0).touches(&at(9.9)) && !at(0.0).touches(&at(10.1)));
    /// ```
    pub fn touches(&self, other: &Body) -> bool {
        let motion = Standing(Rigid::IDENTITY);
        let here = [Moment::of(&motion, 0.0); 2];
        Pair { motion: &motion, moving: self, standing: other }.touch(&here, 0.0).is_some()
    }

    /// A box that holds it at a place.
    pub(super) fn bounds_at(&self, pose: &Rigid) -> Aabb {
        match &self.pieces {
            Pieces::Convex(all) => all.iter().fold(Aabb::EMPTY, |sum, p| sum.union(p.bounds_at(pose))),
            Pieces::Triangles { .. } => moved_box(self.bounds, pose),
        }
    }

    /// Calls a function with each of its pieces that may meet another body between two places; `margin`: its pieces may be that far
    /// from the hull of the places at the moment. The function has a box about the piece.
    pub(super) fn pieces_between(
        &self,
        ends: &[Rigid; 2],
        margin: impl Fn() -> f64,
        other: &Body,
        mut each: impl FnMut(&Piece, Aabb),
    ) {
        let region = |of: &dyn Fn(&Rigid) -> Aabb| of(&ends[0]).union(of(&ends[1])).grown(margin());
        match &self.pieces {
            Pieces::Convex(all) => {
                for piece in all {
                    let region = region(&|pose| piece.bounds_at(pose));
                    if region.meets(other.bounds) {
                        each(piece, region);
                    }
                }
            }
            Pieces::Triangles { triangles, tree, .. } => {
                let near = |own: Aabb| other.has_in(region(&|pose| moved_box(own, pose)));
                tree.each_of(near, |i| {
                    let piece = &triangles[i];
                    each(piece, region(&|pose| piece.bounds_at(pose)));
                    false
                });
            }
        }
    }

    /// Whether a box of its pieces meets another.
    fn has_in(&self, region: Aabb) -> bool {
        let mut found = false;
        match &self.pieces {
            Pieces::Convex(_) => found = self.bounds.meets(region),
            Pieces::Triangles { tree, .. } => tree.each_of(
                |own| own.meets(region),
                |_| {
                    found = true;
                    true
                },
            ),
        }
        found
    }

    /// Calls a function with each piece whose box meets another.
    pub(super) fn pieces_in(&self, region: Aabb, mut each: impl FnMut(&Piece)) {
        self.find_in(region, |piece| {
            each(piece);
            None::<()>
        });
    }

    /// The first answer of a function about pieces whose box meets another.
    pub(super) fn find_in<T>(&self, region: Aabb, mut answer: impl FnMut(&Piece) -> Option<T>) -> Option<T> {
        match &self.pieces {
            Pieces::Convex(_) if !self.bounds.meets(region) => None,
            Pieces::Convex(all) => all.iter().find_map(answer),
            Pieces::Triangles { triangles, tree, .. } => {
                let mut found = None;
                tree.each_of(
                    |own| own.meets(region),
                    |i| {
                        found = answer(&triangles[i]);
                        found.is_some()
                    },
                );
                found
            }
        }
    }

    /// Whether a point is within a body of triangles; of others no point has to be asked about.
    pub(super) fn has_inside(&self, p: DVec3) -> bool {
        match &self.pieces {
            Pieces::Convex(_) => false,
            Pieces::Triangles { distance, inside, back, .. } => {
                let region = Aabb { min: p, max: p };
                self.bounds.meets(region) && distance.signed(back.point(p)) * inside > 0.0
            }
        }
    }

    /// A point of it.
    pub(super) fn a_point(&self) -> DVec3 {
        match &self.pieces {
            Pieces::Convex(all) | Pieces::Triangles { triangles: all, .. } => {
                all.first().map_or(self.ball.centre, |piece| piece.farthest(DVec3::NEG_Z))
            }
        }
    }

    /// Its lowest coordinate along a direction between two places [mm].
    pub(super) fn lowest(&self, ends: &[Rigid; 2], up: DVec3) -> f64 {
        match &self.pieces {
            Pieces::Convex(all) => {
                let low = |piece: &Piece| {
                    let placed = ends.map(|pose| Placed { piece, pose });
                    Between(placed).farthest(-up).dot(up)
                };
                all.iter().map(low).fold(f64::INFINITY, f64::min)
            }
            Pieces::Triangles { .. } => {
                let low = |pose: &Rigid| {
                    let bounds = moved_box(self.bounds, pose);
                    DVec3::select(up.cmpge(DVec3::ZERO), bounds.min, bounds.max).dot(up)
                };
                low(&ends[0]).min(low(&ends[1]))
            }
        }
    }
}

/// A box that holds a box that has moved.
fn moved_box(bounds: Aabb, pose: &Rigid) -> Aabb {
    let (centre, half) = (pose.point(0.5 * (bounds.min + bounds.max)), 0.5 * bounds.size());
    let r = pose.rotation;
    let reach = r.x_axis.abs() * half.x + r.y_axis.abs() * half.y + r.z_axis.abs() * half.z;
    Aabb { min: centre - reach, max: centre + reach }
}
