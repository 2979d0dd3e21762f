//! The crossings of a mesh with a line along an axis.
//!
//! Seen along the line a triangle holds the point or not by the half-open rule of each edge, reckoned from the same end for both
//! of its triangles: on a closed mesh no crossing is lost or counted twice where the line meets an edge or a vertex.

use glam::{DVec2, DVec3};

use super::Mesh;

/// A crossing of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshCrossing {
    /// Coordinate along the axis [mm].
    pub at: f64,
    /// The triangle.
    pub triangle: u32,
}

impl Mesh {
    /// The crossings of the line along an axis (0, 1, 2 for X, Y, Z) through a point, in their order along it.
    ///
    /// On a closed mesh their number is even; between the first and the second is material, and so on.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::Mesh;
    /// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// let mesh = Mesh { vertices: corners.map(Into::into).to_vec(), triangles };
    /// let crossings = mesh.crossings(2, [0.5, 0.5, 9.0].into());
    /// assert_eq!((crossings[0].at, crossings[1].at, crossings[1].triangle), (0.0, 1.0, 2));
    /// ```
    pub fn crossings(&self, axis: usize, point: DVec3) -> Vec<MeshCrossing> {
        let flat = |v: DVec3| match axis {
            0 => DVec2::new(v.y, v.z),
            1 => DVec2::new(v.z, v.x),
            _ => DVec2::new(v.x, v.y),
        };
        let axis = axis.min(2);
        let p = flat(point);
        let mut crossings = Vec::new();
        for (t, n) in self.triangles.iter().zip(0u32..) {
            let corners = t.map(|i| self.vertices[i as usize]);
            let seen = corners.map(flat);
            // Most triangles are beside the line.
            let beside = |c: [f64; 3], p: f64| c.iter().all(|v| *v < p) || c.iter().all(|v| *v > p);
            if beside(seen.map(|v| v.x), p.x) || beside(seen.map(|v| v.y), p.y) {
                continue;
            }
            let passed = (0..3).filter(|&i| passes(seen[i], seen[(i + 1) % 3], p)).count();
            if passed % 2 == 1 {
                crossings.push(MeshCrossing { at: height(corners, seen, axis, p), triangle: n });
            }
        }
        crossings.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.triangle.cmp(&b.triangle)));
        crossings
    }
}

/// Whether a ray from `p` towards greater x passes an edge; the same for both directions of the edge.
fn passes(a: DVec2, b: DVec2, p: DVec2) -> bool {
    if (a.y > p.y) == (b.y > p.y) {
        return false;
    }
    let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
    (high - low).perp_dot(p - low) > 0.0
}

/// Coordinate along the axis of the plane of a triangle over `p`, within that of its corners.
fn height(corners: [DVec3; 3], seen: [DVec2; 3], axis: usize, p: DVec2) -> f64 {
    let z = corners.map(|c| c[axis]);
    let [a, b, c] = [0, 1, 2].map(|i| (seen[(i + 1) % 3] - p).perp_dot(seen[(i + 2) % 3] - p));
    let (low, high) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
    let at = (a * z[0] + b * z[1] + c * z[2]) / (a + b + c);
    // A triangle on edge has no area as it is seen; any of its points will do.
    if at.is_finite() { at.clamp(low, high) } else { low }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// An octahedron about the origin: edges and vertices on the axes.
    fn octahedron(radius: f64) -> Mesh {
        let vertices = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
        let vertices = vertices.map(|v| DVec3::from_array(v.map(f64::from)) * radius).to_vec();
        let triangles = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect();
        Mesh { vertices, triangles }
    }

    #[test]
    fn lines_cross_where_the_closed_form_says() {
        let mesh = octahedron(5.0);
        assert!(mesh.check_closed().is_ok());
        let mut random = Random(3);
        for round in 0..3000 {
            let axis = round % 3;
            // Every other point on a lattice: through vertices and along edges.
            let mut p = DVec3::from_array([0, 1, 2].map(|_| 12.0 * random.share() - 6.0));
            p = if round % 2 == 0 { p.round() } else { p };
            let mut across = p;
            across[axis] = 0.0;
            let half = 5.0 - across.abs().element_sum();
            let crossings = mesh.crossings(axis, p);
            match crossings.as_slice() {
                [low, high] => {
                    assert!(half >= 0.0, "{p} along {axis}");
                    assert!(
                        (low.at + half).abs() < 1e-12 && (high.at - half).abs() < 1e-12,
                        "{p}: {low:?} {high:?}"
                    );
                }
                [] => assert!(half <= 0.0, "{p} along {axis}: {half}"),
                other => panic!("{p} along {axis}: {other:?}"),
            }
        }
    }
}
