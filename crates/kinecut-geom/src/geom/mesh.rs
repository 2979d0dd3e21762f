//! Triangle meshes.

use glam::DVec3;

use super::Aabb;

/// A triangle mesh with shared vertices; triangles run counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices [mm].
    pub vertices: Vec<DVec3>,
    /// Triangles as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Signed volume [mm^3]; positive for a closed mesh oriented outwards.
    pub fn volume(&self) -> f64 {
        // About a vertex of the mesh, so that a part far from the origin loses no digits.
        let o = self.vertices.first().copied().unwrap_or(DVec3::ZERO);
        self.triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| self.vertices[i as usize] - o);
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    /// The box of all vertices.
    pub fn bounds(&self) -> Aabb {
        Aabb::of_points(self.vertices.iter().copied())
    }
}
