//! Passages of a drill through a part given as a triangle mesh, anywhere on it and in any direction.
//!
//! The triangles under the drill, found in a tree of boxes, are joined to sheets; each sheet is a passage with its
//! exact transient (every candidate of every triangle, no sampling) and the exact share of the annulus that it covers.
//! The cost is linear in the triangles under the drill. A mesh is taken as the faceted body; of a cylinder of radius R
//! in chords of length c the facets lie up to c^2 / (8 R) inside.

mod facet;
mod share;
mod sheets;
mod tree;

use glam::DVec3;
use rayon::prelude::*;

use self::sheets::Sheets;
use self::tree::Tree;
use super::Passage;
use crate::base::{Code, Finding, Result};
use crate::geom::{EdgeProfile, Mesh};

/// Reach of the tree's search beyond the drill, as a share of its radius: rounding of the boxes.
const ROUNDING: f64 = 1e-9;

/// The closed surface of a part, prepared for drills.
#[derive(Clone, Debug)]
pub struct PartMesh {
    /// Its triangles in the order of the tree.
    mesh: Mesh,
    tree: Tree,
}

/// A hole through a mesh: its passages and its first contact.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshHole {
    /// The surfaces on the way, the one met first at the front; Z = 0 where the tool's reference point is at the point
    /// of the axis by which the hole was given.
    pub passages: Vec<Passage>,
    /// The point of the part that the edge touches first [mm], in the frame of the mesh.
    pub contact: DVec3,
}

impl PartMesh {
    /// Prepares a mesh. One that is turned inside out (a negative volume) is turned round.
    ///
    /// # Errors
    /// `KC0602` with the place when the mesh is open, its triangles run in opposite directions, or a vertex is not
    /// finite; `KC0801` when it has no triangles or no volume.
    pub fn new(mesh: &Mesh) -> Result<PartMesh> {
        mesh.check_closed()?;
        let mut mesh = mesh.clone();
        let volume = mesh.volume();
        if volume == 0.0 || !volume.is_finite() {
            return Err(Finding::error(Code::GEOMETRY, "a mesh to drill has no volume")
                .value(volume, "mm^3")
                .bound(0.0, "mm^3")
                .help("give the surface of a solid body, in mm")
                .into());
        }
        if volume < 0.0 {
            mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let tree = Tree::new(&mut mesh);
        Ok(PartMesh { mesh, tree })
    }

    /// Surface that an edge meets when its axis runs through `at` [mm] along `direction`, the way of the feed (of any
    /// length). The whole of the line counts, also the part before the point.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use glam::DVec3;
    /// use kinecut::drilling::{PartMesh, Side};
    /// use kinecut::geom::Mesh;
    /// use kinecut::tool::DrillPoint;
    /// let corners = [[0.0, 0.0, 0.0], [90.0, 0.0, 0.0], [0.0, 90.0, 0.0], [0.0, 0.0, 90.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// let part = PartMesh::new(&Mesh { vertices: corners.map(Into::into).to_vec(), triangles })?;
    /// let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(20.0)?;
    /// let hole = part.passages(&edge, DVec3::new(20.0, 20.0, 0.0), DVec3::NEG_Z)?;
    /// // In by a face that rises by sqrt(2): the corner first, 10 sqrt(2) - 6.0086 above the tip; out by a level one.
    /// let [entry, exit] = hole.passages[..] else { panic!() };
    /// assert!((entry.transient.first - 58.133529).abs() < 1e-6 && entry.side == Side::Entry);
    /// assert!((exit.transient.last - -6.008606).abs() < 1e-6 && (exit.share - 1.0).abs() < 1e-12);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    ///
    /// # Errors
    /// `KC0901` when the point or the direction is not usable, `KC0904` when nothing of the part lies on the way.
    pub fn passages(&self, edge: &EdgeProfile, at: DVec3, direction: DVec3) -> Result<MeshHole> {
        let up = (-direction).try_normalize().filter(|_| direction.is_finite() && at.is_finite());
        let Some(up) = up else {
            return Err(Finding::error(
                Code::DRILL_CASE,
                "the point or the direction of a hole is not usable",
            )
            .help("give a point of finite coordinates and a direction that is not zero")
            .into());
        };
        let (e, f) = up.any_orthonormal_pair();
        // Right-handed about the axis, so that what faces the drill runs counter-clockwise.
        let f = if e.cross(f).dot(up) > 0.0 { f } else { -f };
        let mut sheets = Sheets::new(edge);
        let reach = edge.outer_radius() * (1.0 + ROUNDING);
        self.tree.near_line(at, [e, f], reach, &mut |range| {
            for t in &self.mesh.triangles[range] {
                let places = t.map(|i| {
                    let p = self.mesh.vertices[i as usize] - at;
                    DVec3::new(e.dot(p), f.dot(p), up.dot(p))
                });
                sheets.add(*t, places);
            }
        });
        let (passages, touch) = sheets.passages();
        let Some(touch) = touch.filter(|_| !passages.is_empty()) else {
            return Err(Finding::error(Code::DRILL_MISSES, "the hole lies beside the part")
                .point(at.to_array())
                .help("move the hole onto the part, or turn its direction")
                .into());
        };
        Ok(MeshHole { passages, contact: at + e * touch.at.x + f * touch.at.y + up * touch.height })
    }

    /// Many holes at once, each by the point on its axis and its direction, by index. An error of one leaves the others
    /// as they are.
    pub fn passages_of_many(&self, edge: &EdgeProfile, holes: &[(DVec3, DVec3)]) -> Vec<Result<MeshHole>> {
        holes.par_iter().map(|&(at, direction)| self.passages(edge, at, direction)).collect()
    }
}
