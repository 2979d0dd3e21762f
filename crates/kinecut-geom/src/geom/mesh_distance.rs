//! Signed distance from a closed mesh.
//!
//! The nearest triangle is found in a tree of boxes (halved at the median of the longest side); the sign follows from
//! the normal of the nearest feature: of the face, the sum of both faces at an edge, the sum of the faces weighted by
//! their angles at a vertex (Baerentzen and Aanaes, 2005: with these the sign is right at every point).

use glam::DVec3;

use super::{Aabb, Mesh};
use crate::base::Result;

/// Triangles in a leaf of the tree.
const LEAF: usize = 4;

/// The point of a surface that is nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// Distance [mm]: positive outside of the body, negative inside.
    pub distance: f64,
    /// The point of the surface [mm].
    pub point: DVec3,
    /// The triangle of the mesh that holds it.
    pub triangle: u32,
}

/// A closed mesh prepared for signed distances.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{Mesh, MeshDistance};
/// let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
/// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
/// let distance = MeshDistance::new(&Mesh { vertices: corners.map(Into::into).to_vec(), triangles }).unwrap();
/// assert_eq!(distance.signed([1.0, 1.0, -2.0].into()), 2.0);
/// assert_eq!(distance.signed([0.5, 0.5, 0.25].into()), -0.25);
/// ```
#[derive(Clone, Debug)]
pub struct MeshDistance {
    faces: Vec<TreeFace>,
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct TreeFace {
    corners: [DVec3; 3],
    /// Normals of the face, its corners, and its edges 0-1, 1-2, 2-0; only their direction matters.
    normal: DVec3,
    at_corners: [DVec3; 3],
    at_edges: [DVec3; 3],
    /// Its number in the mesh.
    number: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// A leaf: first face. Else: the second child; the first one follows its parent.
    at: u32,
    /// Faces of a leaf; zero for an inner node.
    count: u32,
}

impl MeshDistance {
    /// Prepares a mesh.
    ///
    /// # Errors
    /// `KC0602` when the mesh is not closed.
    pub fn new(mesh: &Mesh) -> Result<MeshDistance> {
        mesh.check_closed()?;
        let mut faces = faces(mesh);
        let mut nodes = Vec::with_capacity(faces.len());
        if !faces.is_empty() {
            let count = faces.len();
            split(&mut faces, 0, count, &mut nodes);
        }
        // They are kept as long as the mesh is looked at.
        faces.shrink_to_fit();
        nodes.shrink_to_fit();
        Ok(MeshDistance { faces, nodes })
    }

    /// Memory that a mesh of so many triangles needs once it is prepared [bytes].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::MeshDistance;
    /// assert!((250..350).contains(&MeshDistance::memory(1)));
    /// ```
    pub fn memory(triangles: usize) -> u64 {
        triangles as u64 * (size_of::<TreeFace>() + size_of::<Node>()) as u64
    }

    /// Memory that it holds [bytes].
    pub fn memory_held(&self) -> u64 {
        (self.faces.capacity() * size_of::<TreeFace>() + self.nodes.capacity() * size_of::<Node>()) as u64
    }

    /// Distance [mm] of a point from the surface: positive outside the body, negative inside. Infinite for a mesh
    /// without triangles.
    pub fn signed(&self, p: DVec3) -> f64 {
        self.nearest(p).map_or(f64::INFINITY, |nearest| nearest.distance)
    }

    /// The nearest point of the surface; `None` for a mesh without triangles.
    pub fn nearest(&self, p: DVec3) -> Option<NearestPoint> {
        let mut best = (f64::INFINITY, DVec3::ZERO, DVec3::ZERO, None);
        // Depth is the logarithm of the count, as each split is at the median.
        let mut stack = [(0u32, 0.0); 64];
        let mut depth = 0;
        if let Some(root) = self.nodes.first() {
            stack[0] = (0, squared_gap(&root.bounds, p));
            depth = 1;
        }
        while depth > 0 {
            depth -= 1;
            let (n, gap) = stack[depth];
            if gap >= best.0 {
                continue;
            }
            let node = &self.nodes[n as usize];
            if node.count > 0 {
                for face in &self.faces[node.at as usize..][..node.count as usize] {
                    let (q, normal) = face.nearest(p);
                    let squared = p.distance_squared(q);
                    if squared < best.0 {
                        best = (squared, q, normal, Some(face.number));
                    }
                }
                continue;
            }
            let mut near = (n + 1, squared_gap(&self.nodes[n as usize + 1].bounds, p));
            let mut far = (node.at, squared_gap(&self.nodes[node.at as usize].bounds, p));
            if far.1 < near.1 {
                (near, far) = (far, near);
            }
            stack[depth] = far;
            stack[depth + 1] = near;
            depth += 2;
        }
        let (squared, point, normal, triangle) = best;
        let distance = if normal.dot(p - point) < 0.0 { -squared.sqrt() } else { squared.sqrt() };
        Some(NearestPoint { distance, point, triangle: triangle? })
    }
}

impl TreeFace {
    /// The nearest point of the triangle and the normal of the feature it is on (Ericson, 2005, section 5.1.5).
    fn nearest(&self, p: DVec3) -> (DVec3, DVec3) {
        let [a, b, c] = self.corners;
        let (ab, ac, ap) = (b - a, c - a, p - a);
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return (a, self.at_corners[0]);
        }
        let bp = p - b;
        let (d3, d4) = (ab.dot(bp), ac.dot(bp));
        if d3 >= 0.0 && d4 <= d3 {
            return (b, self.at_corners[1]);
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return (a + ab * (d1 / (d1 - d3)), self.at_edges[0]);
        }
        let cp = p - c;
        let (d5, d6) = (ab.dot(cp), ac.dot(cp));
        if d6 >= 0.0 && d5 <= d6 {
            return (c, self.at_corners[2]);
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return (a + ac * (d2 / (d2 - d6)), self.at_edges[2]);
        }
        let va = d3 * d6 - d5 * d4;
        if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
            return (b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), self.at_edges[1]);
        }
        let sum = va + vb + vc;
        (a + ab * (vb / sum) + ac * (vc / sum), self.normal)
    }

    fn bounds(&self) -> Aabb {
        Aabb::of_points(self.corners)
    }
}

/// The triangles of a mesh that have an area, with the normals of their features. The neighbours of a triangle
/// without area hold all of its points.
fn faces(mesh: &Mesh) -> Vec<TreeFace> {
    let corners = |t: &[u32; 3]| t.map(|i| mesh.vertices[i as usize]);
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = corners(t);
        (b - a).cross(c - a).try_normalize()
    };
    let mut at_vertex = vec![DVec3::ZERO; mesh.vertices.len()];
    let mut edges: Vec<(u32, u32, u32)> = Vec::with_capacity(mesh.triangles.len() * 3);
    for (n, t) in mesh.triangles.iter().enumerate() {
        let (p, unit) = (corners(t), normal(t).unwrap_or(DVec3::ZERO));
        for i in 0..3 {
            let (along, back) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            at_vertex[t[i] as usize] += unit * along.cross(back).length().atan2(along.dot(back));
            edges.push((t[i], t[(i + 1) % 3], n as u32));
        }
    }
    edges.sort_unstable();
    // The triangle on the other side runs along the edge backwards.
    let across = |a: u32, b: u32| {
        let at = edges.partition_point(|e| (e.0, e.1) < (b, a));
        edges.get(at).filter(|e| (e.0, e.1) == (b, a)).and_then(|e| normal(&mesh.triangles[e.2 as usize]))
    };
    let faces = mesh.triangles.iter().zip(0..).filter_map(|(t, number)| {
        let unit = normal(t)?;
        Some(TreeFace {
            corners: corners(t),
            normal: unit,
            at_corners: t.map(|i| at_vertex[i as usize]),
            at_edges: [0, 1, 2].map(|i| unit + across(t[i], t[(i + 1) % 3]).unwrap_or(DVec3::ZERO)),
            number,
        })
    });
    faces.collect()
}

/// Makes the subtree of the faces `from..to`, reordering them.
fn split(faces: &mut [TreeFace], from: usize, to: usize, nodes: &mut Vec<Node>) {
    let bounds = faces[from..to].iter().fold(Aabb::EMPTY, |b, f| b.union(f.bounds()));
    let place = nodes.len();
    nodes.push(Node { bounds, at: from as u32, count: (to - from) as u32 });
    if to - from <= LEAF {
        return;
    }
    let size = bounds.size();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let middle = (from + to) / 2;
    let centre = |f: &TreeFace| f.corners[0][axis] + f.corners[1][axis] + f.corners[2][axis];
    faces[from..to].select_nth_unstable_by(middle - from, |a, b| centre(a).total_cmp(&centre(b)));
    split(faces, from, middle, nodes);
    nodes[place] = Node { bounds, at: nodes.len() as u32, count: 0 };
    split(faces, middle, to, nodes);
}

/// Square of the distance of a point from a box [mm^2].
fn squared_gap(b: &Aabb, p: DVec3) -> f64 {
    (b.min - p).max(p - b.max).max(DVec3::ZERO).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// An L-shaped prism: convex and concave edges, and corners where both meet.
    fn bracket() -> Mesh {
        let outline = [[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [2.0, 2.0], [2.0, 5.0], [0.0, 5.0]];
        let n = outline.len() as u32;
        let mut mesh = Mesh::default();
        for z in [0.0, 3.0] {
            mesh.vertices.extend(outline.map(|[x, y]| DVec3::new(x, y, z)));
        }
        for i in 0..n {
            let j = (i + 1) % n;
            mesh.triangles.extend([[i, j, j + n], [i, j + n, i + n]]);
        }
        for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]] {
            mesh.triangles.extend([[a, c, b], [a + n, b + n, c + n]]);
        }
        mesh.check_closed().unwrap();
        mesh
    }

    /// Distance from a box, negative inside.
    fn cuboid(p: DVec3, min: DVec3, max: DVec3) -> f64 {
        let q = (p - (min + max) * 0.5).abs() - (max - min) * 0.5;
        q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn distances_from_a_bracket(x in -3.0..9.0f64, y in -3.0..8.0f64, z in -3.0..6.0f64) {
            let p = DVec3::new(x, y, z);
            let bracket = bracket();
            let found = MeshDistance::new(&bracket).unwrap().signed(p);
            let foot = cuboid(p, DVec3::ZERO, DVec3::new(6.0, 2.0, 3.0));
            let post = cuboid(p, DVec3::ZERO, DVec3::new(2.0, 5.0, 3.0));
            // Outside the union is the lesser of both distances; inside, the complement is the union of the
            // complement of the hull's box and the box in the notch.
            let expected = if foot > 0.0 && post > 0.0 {
                foot.min(post)
            } else {
                let hull = -cuboid(p, DVec3::ZERO, DVec3::new(6.0, 5.0, 3.0));
                let notch = cuboid(p, DVec3::new(2.0, 2.0, -50.0), DVec3::new(60.0, 60.0, 50.0));
                -hull.min(notch)
            };
            prop_assert!((found - expected).abs() < 1e-9, "{p} {found} {expected}");
        }
    }

    #[test]
    fn an_open_mesh_is_refused_and_an_empty_one_is_far() {
        let mut mesh = bracket();
        mesh.triangles.pop();
        assert!(MeshDistance::new(&mesh).is_err());
        assert_eq!(MeshDistance::new(&Mesh::default()).unwrap().signed(DVec3::ONE), f64::INFINITY);
    }
}
