//! Smooth faces of a mesh, and samples of their points and normals.
//!
//! Facets belong to one face when they share an edge at which their normals turn by less than the crease angle. Samples
//! are the middles of the edges inside of a face with the mean of the normals of the two facets: at these points flat
//! facets of a surface that is curved evenly have no error of first order, where their centroids have. On cylinders
//! these samples are exact, however coarse the facets, and so they are on the edges of profiles of revolution.

use glam::DVec3;

use super::super::Sample;
use crate::geom::Mesh;

/// A smooth face of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Triangles, rising.
    pub(super) triangles: Vec<u32>,
    /// Area [mm^2].
    pub(super) area: f64,
    /// Middles of inner edges with mean normals and the area for which they stand.
    pub(super) samples: Vec<Sample>,
    /// The two triangles of each sample.
    pub(super) sides: Vec<[u32; 2]>,
    /// Root mean square of the angle between the facets at inner edges [rad].
    pub(super) bend: f64,
}

/// Unit normal and area [mm^2] of each facet; the normal of one without area is zero.
pub(super) fn facets(mesh: &Mesh) -> Vec<(DVec3, f64)> {
    let facet = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
        let cross = (b - a).cross(c - a);
        (cross.try_normalize().unwrap_or(DVec3::ZERO), 0.5 * cross.length())
    };
    mesh.triangles.iter().map(facet).collect()
}

/// The smooth faces of a mesh, the greatest first.
pub(super) fn faces(mesh: &Mesh, crease: f64) -> Vec<Face> {
    let facets = facets(mesh);
    let edges = inner_edges(mesh);
    let least_cosine = crease.cos();
    let smooth = |t: [u32; 2]| {
        let [a, b] = t.map(|i| facets[i as usize]);
        a.1 > 0.0 && b.1 > 0.0 && a.0.dot(b.0) >= least_cosine
    };
    let mut sets = Sets((0..mesh.triangles.len() as u32).collect());
    edges.iter().filter(|e| smooth(e.triangles)).for_each(|e| sets.join(e.triangles));
    // Numbers of faces in the order of their first triangle.
    let mut number = vec![u32::MAX; mesh.triangles.len()];
    let mut faces: Vec<Face> = Vec::new();
    for t in 0..mesh.triangles.len() as u32 {
        let root = sets.root(t) as usize;
        if number[root] == u32::MAX {
            number[root] = faces.len() as u32;
            let (triangles, samples, sides) = (Vec::new(), Vec::new(), Vec::new());
            faces.push(Face { triangles, area: 0.0, samples, sides, bend: 0.0 });
        }
        let face = &mut faces[number[root] as usize];
        face.triangles.push(t);
        face.area += facets[t as usize].1;
    }
    for edge in &edges {
        let roots = edge.triangles.map(|t| sets.root(t));
        let [(n0, a0), (n1, a1)] = edge.triangles.map(|t| facets[t as usize]);
        let Some(normal) =
            (n0 + n1).try_normalize().filter(|_| roots[0] == roots[1] && smooth(edge.triangles))
        else {
            continue;
        };
        let face = &mut faces[number[roots[0] as usize] as usize];
        let point = edge.vertices.map(|v| mesh.vertices[v as usize]).iter().sum::<DVec3>() / 2.0;
        let weight = (a0 + a1) / 3.0;
        face.bend += weight * n0.cross(n1).length().atan2(n0.dot(n1)).powi(2);
        face.samples.push(Sample { point, normal, weight });
        face.sides.push(edge.triangles);
    }
    for face in &mut faces {
        let weight: f64 = face.samples.iter().map(|s| s.weight).sum();
        face.bend = if weight > 0.0 { (face.bend / weight).sqrt() } else { 0.0 };
        if face.samples.len() < FEW {
            flat_samples(mesh, &facets, face);
        }
    }
    faces.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.triangles.cmp(&b.triangles)));
    faces
}

/// Inner edges below which a face takes the corners of its facets as samples too.
const FEW: usize = 12;

/// Corners of facets with the facet's normal: right for the flat faces of a box, which have hardly an inner edge.
fn flat_samples(mesh: &Mesh, facets: &[(DVec3, f64)], face: &mut Face) {
    for &t in &face.triangles {
        let (normal, area) = facets[t as usize];
        for v in mesh.triangles[t as usize] {
            let point = mesh.vertices[v as usize];
            face.samples.push(Sample { point, normal, weight: area / 3.0 });
            face.sides.push([t, t]);
        }
    }
}

struct Edge {
    vertices: [u32; 2],
    triangles: [u32; 2],
}

/// Edges with exactly two triangles, in the order of their vertices.
fn inner_edges(mesh: &Mesh) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * mesh.triangles.len());
    for (t, [a, b, c]) in mesh.triangles.iter().enumerate() {
        let sorted = |a: &u32, b: &u32| [*a.min(b), *a.max(b)];
        sides.extend([sorted(a, b), sorted(b, c), sorted(c, a)].map(|edge| (edge, t as u32)));
    }
    sides.sort_unstable();
    let pair = |group: &[([u32; 2], u32)]| match group {
        [(vertices, a), (_, b)] if a != b => Some(Edge { vertices: *vertices, triangles: [*a, *b] }),
        _ => None,
    };
    sides.chunk_by(|a, b| a.0 == b.0).filter_map(pair).collect()
}

/// Disjoint sets of triangles.
struct Sets(Vec<u32>);

impl Sets {
    fn root(&mut self, mut of: u32) -> u32 {
        while self.0[of as usize] != of {
            let above = self.0[self.0[of as usize] as usize];
            self.0[of as usize] = above;
            of = above;
        }
        of
    }

    fn join(&mut self, [a, b]: [u32; 2]) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
