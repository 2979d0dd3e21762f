//! Faces of a mesh: triangles that go on smoothly into one another.

use glam::DVec3;

use super::Mesh;

impl Mesh {
    /// The face of each triangle, as a number from 0 on: triangles on the two sides of an edge belong to one face if their normals differ there
    /// by no more than `angle` [rad]. A triangle without area is a face by itself.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::Mesh;
    /// // A roof of two squares that meet at 90 degrees.
    /// let vertices = [[0., 0., 0.], [2., 0., 0.], [0., 1., 1.], [2., 1., 1.], [0., 2., 0.], [2., 2., 0.]];
    /// let triangles = vec![[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]];
    /// let roof = Mesh { vertices: vertices.map(Into::into).to_vec(), triangles };
    /// assert_eq!(roof.smooth_faces(0.3), [0, 0, 1, 1]);
    /// assert_eq!(roof.smooth_faces(1.6), [0, 0, 0, 0]);
    /// ```
    pub fn smooth_faces(&self, angle: f64) -> Vec<u32> {
        let normal = |t: &[u32; 3]| -> DVec3 {
            let [a, b, c] = t.map(|i| self.vertices.get(i as usize).copied().unwrap_or(DVec3::NAN));
            (b - a).cross(c - a).normalize_or_zero()
        };
        let normals: Vec<DVec3> = self.triangles.iter().map(normal).collect();
        let mut edges: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * self.triangles.len());
        for (i, t) in (0..).zip(&self.triangles) {
            edges.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| ([a.min(b), a.max(b)], i)));
        }
        edges.sort_unstable();
        let mut joined: Vec<u32> = (0..self.triangles.len() as u32).collect();
        let least = angle.cos();
        for around in edges.chunk_by(|a, b| a.0 == b.0) {
            for pair in around.windows(2) {
                let [i, j] = [pair[0].1, pair[1].1];
                let (a, b) = (normals[i as usize], normals[j as usize]);
                if a != DVec3::ZERO && b != DVec3::ZERO && a.dot(b) >= least {
                    let (a, b) = (root(&mut joined, i), root(&mut joined, j));
                    joined[a.max(b) as usize] = a.min(b);
                }
            }
        }
        let mut number = vec![u32::MAX; joined.len()];
        let mut next = 0;
        (0..joined.len() as u32)
            .map(|i| {
                let root = root(&mut joined, i) as usize;
                if number[root] == u32::MAX {
                    number[root] = next;
                    next += 1;
                }
                number[root]
            })
            .collect()
    }
}

/// The first triangle of those that are joined with one.
fn root(joined: &mut [u32], mut of: u32) -> u32 {
    while joined[of as usize] != of {
        let above = joined[joined[of as usize] as usize];
        joined[of as usize] = above;
        of = above;
    }
    of
}
