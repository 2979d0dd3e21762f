//! Strips of triangles between two polylines, and the mesh they go into.

use glam::DVec3;

use crate::geom::Mesh;

/// A vertex of a polyline with its place along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub along: f64,
    pub vertex: u32,
}

/// A mesh while it is built.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub mesh: Mesh,
}

impl Builder {
    pub(super) fn vertex(&mut self, p: DVec3) -> u32 {
        self.mesh.vertices.push(p);
        // More vertices than indices are refused before.
        (self.mesh.vertices.len() - 1) as u32
    }

    /// A triangle; one with two equal corners is nothing, and leaves the others closed.
    pub(super) fn triangle(&mut self, [a, b, c]: [u32; 3], flip: bool) {
        if a != b && b != c && c != a {
            self.mesh.triangles.push(if flip { [a, c, b] } else { [a, b, c] });
        }
    }

    /// The strip between two polylines, by their places: counter-clockwise where the lower runs to the right and the upper lies
    /// above it. Its boundary is the lower line, the upper one backwards, and the lines between their ends.
    pub(super) fn strip(&mut self, lower: &[Station], upper: &[Station], flip: bool) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < lower.len() || j + 1 < upper.len() {
            let below = match (lower.get(i + 1), upper.get(j + 1)) {
                (Some(a), Some(b)) => a.along <= b.along,
                (Some(_), None) => true,
                _ => false,
            };
            let (Some(a), Some(b)) = (lower.get(i), upper.get(j)) else { return };
            if below {
                i += 1;
                self.triangle([a.vertex, lower[i].vertex, b.vertex], flip);
            } else {
                j += 1;
                self.triangle([a.vertex, upper[j].vertex, b.vertex], flip);
            }
        }
    }
}
