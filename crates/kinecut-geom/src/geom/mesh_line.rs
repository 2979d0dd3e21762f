//! The crossings of a mesh with a line.
//!
//! Seen along the line a triangle holds the point or not by the half-open rule of each edge, reckoned from the same end for both
//! of its triangles: on a closed mesh no crossing is lost or counted twice where the line meets an edge or a vertex.

use glam::{DVec2, DVec3};

use super::Mesh;

/// A crossing of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshCrossing {
    /// Coordinate along the axis, or distance from the first point of the line [mm].
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
        self.crossings_seen(flat, |v| v[axis], flat(point))
    }

    /// The crossings of the straight line from a point towards another one, and on, with their distances from the first, in their
    /// order; those before the first have distances below zero. None for two points that are one.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::Mesh;
    /// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// let mesh = Mesh { vertices: corners.map(Into::into).to_vec(), triangles };
    /// // From a face at a right angle through the tetrahedron, and out at its slope.
    /// let crossings = mesh.crossings_between([0.25, 0.5, 3.0].into(), [0.25, 0.5, 1.0].into());
    /// assert_eq!((crossings[0].at, crossings[1].at, crossings[0].triangle), (1.75, 3.0, 2));
    /// ```
    pub fn crossings_between(&self, from: DVec3, to: DVec3) -> Vec<MeshCrossing> {
        let Some(along) = (to - from).try_normalize() else { return Vec::new() };
        let (u, v) = along.any_orthonormal_pair();
        let flat = |p: DVec3| DVec2::new((p - from).dot(u), (p - from).dot(v));
        self.crossings_seen(flat, |p| (p - from).dot(along), DVec2::ZERO)
    }

    /// The crossings of a line that is seen as a point, when all is looked at along it; a vertex has to be seen at one place by all its
    /// triangles.
    fn crossings_seen(
        &self,
        flat: impl Fn(DVec3) -> DVec2,
        along: impl Fn(DVec3) -> f64,
        p: DVec2,
    ) -> Vec<MeshCrossing> {
        let mut crossings = Vec::new();
        for (t, n) in self.triangles.iter().zip(0u32..) {
            let corners = t.map(|i| self.vertices[i as usize]);
            let seen = corners.map(&flat);
            // Most triangles are beside the line.
            let beside = |c: [f64; 3], p: f64| c.iter().all(|v| *v < p) || c.iter().all(|v| *v > p);
            if beside(seen.map(|v| v.x), p.x) || beside(seen.map(|v| v.y), p.y) {
                continue;
            }
            let passed = (0..3).filter(|&i| passes(seen[i], seen[(i + 1) % 3], p)).count();
            if passed % 2 == 1 {
                crossings.push(MeshCrossing { at: height(corners.map(&along), seen, p), triangle: n });
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

/// Coordinate along the line of the plane of a triangle over `p`, within those of its corners, `z`.
fn height(z: [f64; 3], seen: [DVec2; 3], p: DVec2) -> f64 {
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

    #[test]
    fn lines_in_any_direction_cross_where_the_closed_form_says() {
        let mesh = octahedron(5.0);
        let mut random = Random(4);
        let mut point = || DVec3::from_array([0, 1, 2].map(|_| 14.0 * random.share() - 7.0));
        let mut crossed = 0;
        for round in 0..3000 {
            // Every other line through whole numbers: vertices, edges, along faces.
            let (from, to) = (point(), point());
            let (from, to) = if round % 2 == 0 { (from.round(), to.round()) } else { (from, to) };
            let crossings = mesh.crossings_between(from, to);
            let Some(along) = (to - from).try_normalize() else {
                assert!(crossings.is_empty());
                continue;
            };
            // The octahedron lies between four pairs of planes x ± y ± z = ± 5.
            let mut in_face = false;
            let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
            for n in
                [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, 1.0, 1.0]].map(DVec3::from_array)
            {
                let (rate, at) = (n.dot(along), n.dot(from));
                if rate.abs() < 1e-12 {
                    in_face |= (at.abs() - 5.0).abs() < 1e-9;
                    enter = if at.abs() > 5.0 { f64::INFINITY } else { enter };
                    continue;
                }
                let ends = [(-5.0 - at) / rate, (5.0 - at) / rate];
                (enter, leave) = (enter.max(ends[0].min(ends[1])), leave.min(ends[0].max(ends[1])));
            }
            match crossings.as_slice() {
                // Along a face it passes from one side to the other at most.
                some if in_face => assert_eq!(some.len() % 2, 0, "{from} {to}"),
                [low, high] => {
                    crossed += 1;
                    assert!((low.at - enter).abs() < 1e-9 && (high.at - leave).abs() < 1e-9, "{from} {to}");
                }
                [] => assert!(leave - enter < 1e-9, "{from} {to}: {enter} {leave}"),
                other => panic!("{from} {to}: {other:?}"),
            }
        }
        assert!(crossed > 1000, "{crossed}");
    }
}
