//! Smooth faces of a mesh, and samples of their points and normals.
//!
//! Facets belong to one face when they share an edge at which their normals turn by less than the crease angle. Samples
//! are the middles of the edges inside of a face with the mean of the normals of the two facets: at these points flat
//! facets of a surface that is curved evenly have no error of first order, where their centroids have. On cylinders
//! these samples are exact, however coarse the facets, and so they are on the edges of profiles of revolution.

use glam::DVec3;

use super::super::Sample;
use crate::geom::Mesh;
use crate::num::sets::Sets;

/// A smooth face of a mesh.
#[derive(Clone, Debug)]
pub(super) struct SmoothFace {
    /// Triangles, rising.
    pub(super) triangles: Vec<u32>,
    /// Area [mm^2].
    pub(super) area: f64,
    /// Middles of inner edges with mean normals and their share of the area.
    pub(super) samples: Vec<Sample>,
    /// The two triangles of each sample.
    pub(super) sides: Vec<[u32; 2]>,
    /// The two vertices of the edge of each sample that is the middle of one.
    edges: Vec<[u32; 2]>,
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
pub(super) fn faces(mesh: &Mesh, crease: f64) -> Vec<SmoothFace> {
    let facets = facets(mesh);
    let edges = inner_edges(mesh);
    let least_cosine = crease.cos();
    let smooth = |t: [u32; 2]| {
        let [a, b] = t.map(|i| facets[i as usize]);
        a.1 > 0.0 && b.1 > 0.0 && a.0.dot(b.0) >= least_cosine
    };
    let mut sets = Sets::new(mesh.triangles.len());
    edges.iter().filter(|e| smooth(e.triangles)).for_each(|e| sets.join(e.triangles[0], e.triangles[1]));
    // Numbers of faces in the order of their first triangle.
    let mut number = vec![u32::MAX; mesh.triangles.len()];
    let mut faces: Vec<SmoothFace> = Vec::new();
    for t in 0..mesh.triangles.len() as u32 {
        let root = sets.least(t) as usize;
        if number[root] == u32::MAX {
            number[root] = faces.len() as u32;
            let (samples, sides, edges) = (Vec::new(), Vec::new(), Vec::new());
            faces.push(SmoothFace { triangles: Vec::new(), area: 0.0, samples, sides, edges, bend: 0.0 });
        }
        let face = &mut faces[number[root] as usize];
        face.triangles.push(t);
        face.area += facets[t as usize].1;
    }
    for edge in &edges {
        let roots = edge.triangles.map(|t| sets.least(t));
        let [(n0, a0), (n1, a1)] = edge.triangles.map(|t| facets[t as usize]);
        let Some(normal) =
            (n0 + n1).try_normalize().filter(|_| roots[0] == roots[1] && smooth(edge.triangles))
        else {
            continue;
        };
        let face = &mut faces[number[roots[0] as usize] as usize];
        // Inside of a flat facet the middle of its corners: the diagonal of a trapezoid lies off its line of symmetry.
        let middle = |vertices: &[u32]| {
            vertices.iter().map(|&v| mesh.vertices[v as usize]).sum::<DVec3>() / vertices.len() as f64
        };
        let point = if n0.cross(n1).length() < FLAT {
            let opposite = edge.triangles.map(|t| {
                let [a, b, c] = mesh.triangles[t as usize];
                [a, b, c].into_iter().find(|v| !edge.vertices.contains(v)).unwrap_or(a)
            });
            middle(&[edge.vertices, opposite].concat())
        } else {
            middle(&edge.vertices)
        };
        let weight = (a0 + a1) / 3.0;
        face.bend += weight * n0.cross(n1).length().atan2(n0.dot(n1)).powi(2);
        face.samples.push(Sample { point, normal, weight });
        face.sides.push(edge.triangles);
        face.edges.push(edge.vertices);
    }
    let border = border(mesh, &edges, &mut sets);
    for face in &mut faces {
        let weight: f64 = face.samples.iter().map(|s| s.weight).sum();
        face.bend = if weight > 0.0 { (face.bend / weight).sqrt() } else { 0.0 };
        let inside = |t: &u32| mesh.triangles[*t as usize].iter().any(|v| !border[*v as usize]);
        if !face.triangles.iter().any(inside) {
            ruled_samples(mesh, &facets, face);
        }
        if face.samples.len() < FEW {
            flat_samples(mesh, &facets, face);
        }
    }
    faces.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.triangles.cmp(&b.triangles)));
    faces
}

/// Place of the two points of Gauss' quadrature on an edge, from its middle by its length.
const GAUSS: f64 = 0.288_675_134_594_812_9;

/// Angle between facets that are one flat facet: the rounding of corners in files of single precision [rad].
const FLAT: f64 = 1e-4;

/// A face of one row of facets, without an inner vertex, is a strip of straight lines: wall of a cylinder, chamfer. The
/// middles of its edges alone lie on one curve and would leave open what runs across it, so each edge counts with two
/// points; except for those inside of a flat facet of more than three corners, which are no straight lines of it.
fn ruled_samples(mesh: &Mesh, facets: &[(DVec3, f64)], face: &mut SmoothFace) {
    let (samples, sides) = (std::mem::take(&mut face.samples), std::mem::take(&mut face.sides));
    for ((sample, side), edge) in samples.into_iter().zip(sides).zip(&face.edges) {
        let [a, b] = edge.map(|v| mesh.vertices[v as usize]);
        let [n0, n1] = side.map(|t| facets[t as usize].0);
        if n0.cross(n1).length() < FLAT {
            face.samples.push(sample);
            face.sides.push(side);
            continue;
        }
        for point in [sample.point + (b - a) * GAUSS, sample.point - (b - a) * GAUSS] {
            face.samples.push(Sample { point, weight: 0.5 * sample.weight, ..sample });
            face.sides.push(side);
        }
    }
}

/// True for each vertex on the border of a face: at an edge with one side, or with sides in two faces.
fn border(mesh: &Mesh, edges: &[Edge], sets: &mut Sets) -> Vec<bool> {
    let mut inner: Vec<[u32; 2]> = Vec::with_capacity(edges.len());
    for edge in edges {
        let [a, b] = edge.triangles.map(|t| sets.least(t));
        if a == b {
            inner.push(edge.vertices);
        }
    }
    let mut border = vec![false; mesh.vertices.len()];
    for [a, b, c] in &mesh.triangles {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            // Edges come sorted by their vertices.
            if inner.binary_search(&[*a.min(b), *a.max(b)]).is_err() {
                border[*a as usize] = true;
                border[*b as usize] = true;
            }
        }
    }
    border
}

/// Inner edges below which a face takes the corners of its facets as samples too.
const FEW: usize = 12;

/// Corners of facets with the facet's normal: right for the flat faces of a box, which have hardly an inner edge.
fn flat_samples(mesh: &Mesh, facets: &[(DVec3, f64)], face: &mut SmoothFace) {
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
