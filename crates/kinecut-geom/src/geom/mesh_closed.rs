//! Check that a mesh is the closed, consistently oriented surface of a solid.

use super::Mesh;
use crate::base::{Code, Finding, Result};

impl Mesh {
    /// Checks that each edge belongs to exactly two triangles which run along it in opposite directions, that no
    /// triangle names a vertex twice or one that is not there, and that all vertices are finite. An empty mesh is
    /// closed.
    ///
    /// # Errors
    /// `KC0602` with the place of the first edge that breaks the rule.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::{base::Code, geom::Mesh};
    /// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let mut mesh = Mesh {
    ///     vertices: corners.map(Into::into).to_vec(),
    ///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    /// };
    /// assert!(mesh.check_closed().is_ok() && mesh.volume() == 1.0 / 6.0);
    /// mesh.triangles.pop();
    /// assert_eq!(mesh.check_closed().unwrap_err().code(), Code::MESH_OPEN);
    /// ```
    pub fn check_closed(&self) -> Result<()> {
        const REPAIR: &str = "repair the mesh in the program that wrote it";
        let open = |what: &str, a: u32, b: u32| {
            let at = |i: u32| self.vertices.get(i as usize).copied().unwrap_or_default();
            let middle = (at(a) + at(b)) * 0.5;
            Err(Finding::error(Code::MESH_OPEN, what).point(middle.to_array()).help(REPAIR).into())
        };
        if let Some(bad) = self.vertices.iter().position(|v| !v.is_finite()) {
            let what = format!("vertex {bad} of a mesh is not finite");
            return Err(Finding::error(Code::MESH_OPEN, what).help(REPAIR).into());
        }
        let mut edges = Vec::with_capacity(self.triangles.len() * 3);
        for t in &self.triangles {
            if t.iter().any(|&i| i as usize >= self.vertices.len()) {
                let what = "a triangle names a vertex that the mesh does not have";
                return Err(Finding::error(Code::MESH_OPEN, what).help(REPAIR).into());
            }
            for i in 0..3 {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                if a == b {
                    return open("a triangle of a mesh has two equal corners", a, b);
                }
                edges.push(key(a, b));
            }
        }
        edges.sort_unstable();
        if let Some(twice) = edges.windows(2).find(|w| w[0] == w[1]) {
            let (a, b) = ends(twice[0]);
            return open("two triangles of a mesh run along an edge in the same direction", a, b);
        }
        // In the order of the triangles, so that the place is the first one in the file.
        for t in &self.triangles {
            for i in 0..3 {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                if edges.binary_search(&key(b, a)).is_err() {
                    return open("a mesh is open at an edge", a, b);
                }
            }
        }
        Ok(())
    }
}

fn key(a: u32, b: u32) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

fn ends(key: u64) -> (u32, u32) {
    ((key >> 32) as u32, key as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Mesh {
        Mesh {
            vertices: [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(Into::into)
                .to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        }
    }

    fn place(mesh: &Mesh) -> Option<[f64; 3]> {
        let error = mesh.check_closed().unwrap_err();
        assert_eq!(error.code(), Code::MESH_OPEN);
        error.0.point
    }

    #[test]
    fn open_turned_and_degenerate_meshes_are_refused_with_the_place() {
        assert!(tetrahedron().check_closed().is_ok());
        assert!(Mesh::default().check_closed().is_ok());
        let mut mesh = tetrahedron();
        mesh.triangles.remove(2);
        assert_eq!(place(&mesh), Some([1.0, 0.5, 0.0])); // the edge 2 -> 1 of the first triangle
        let mut mesh = tetrahedron();
        mesh.triangles[2].swap(0, 1);
        assert!(place(&mesh).is_some());
        let mut mesh = tetrahedron();
        mesh.triangles.push([1, 1, 3]);
        assert_eq!(place(&mesh), Some([2.0, 0.0, 0.0]));
        let mut mesh = tetrahedron();
        mesh.triangles.push([1, 2, 4]);
        assert_eq!(place(&mesh), None);
        let mut mesh = tetrahedron();
        mesh.vertices[3].z = f64::NAN;
        assert_eq!(place(&mesh), None);
    }
}
