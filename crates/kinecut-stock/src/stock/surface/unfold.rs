//! Lays straight the facets that are folded over.
//!
//! If a large leaf has its vertex on a curved edge, the line from there to a neighbour can pass on the wrong side of a
//! vertex between them: a thin facet then faces backwards and lies on another one. This facet and its neighbour on the
//! same face of the body are divided along their other diagonal, if both then face forwards and that diagonal is not an
//! edge elsewhere (the mesh stays a closed manifold).

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use crate::stock::PackedNormal;

/// Folds lie in one face: normals of both facets differ by less (25 degrees).
const SAME_FACE: f64 = 0.9;

/// Facets that are to replace a folded one must face forwards by this cosine (60 degrees).
const FORWARDS: f64 = 0.5;

/// A facet straightened may leave its neighbour to be straightened; after so many rounds the rest stays.
const MOST_ROUNDS: usize = 4;

/// A diagonal that may be turned.
struct Turn {
    /// Cosine by which the worse of both new facets faces forwards.
    worse: f64,
    neighbour: usize,
    /// The old diagonal.
    edge: (u32, u32),
    facets: [[u32; 3]; 2],
}

/// Turns diagonals until no facet can be straightened any more. The order is that of the facets.
pub(super) fn unfold(triangles: &mut [[u32; 3]], normals: &[PackedNormal], vertices: &[DVec3]) {
    let facing = |t: [u32; 3], normal: DVec3| {
        let [a, b, c] = t.map(|i| vertices[i as usize]);
        (b - a).cross(c - a).try_normalize().map_or(0.0, |n| n.dot(normal))
    };
    let folded = |triangles: &[[u32; 3]], n: usize| facing(triangles[n], normals[n].normal()) < 0.0;
    let all = 0..triangles.len();
    let mut found: Vec<usize> = all.into_par_iter().filter(|&n| folded(triangles, n)).collect();
    if found.is_empty() {
        return;
    }
    // Each edge that is looked for has an end in a folded facet.
    let mut near = vec![false; vertices.len()];
    for v in found.iter().flat_map(|&n| triangles[n]) {
        near[v as usize] = true;
    }
    // Only looked up, never iterated.
    let mut facet_at: HashMap<(u32, u32), u32> = HashMap::new();
    for (n, &[a, b, c]) in triangles.iter().enumerate() {
        if [a, b, c].into_iter().any(|v| near[v as usize]) {
            facet_at.extend([((a, b), n as u32), ((b, c), n as u32), ((c, a), n as u32)]);
        }
    }
    for _ in 0..MOST_ROUNDS {
        let mut turned = false;
        found.retain(|&n| {
            let normal = normals[n].normal();
            let t = triangles[n];
            let mut best: Option<Turn> = None;
            for side in 0..3 {
                let (a, b, c) = (t[side], t[(side + 1) % 3], t[(side + 2) % 3]);
                let Some(&m) = facet_at.get(&(b, a)) else { continue };
                let Some(d) = triangles[m as usize].into_iter().find(|&v| v != a && v != b) else { continue };
                let elsewhere = facet_at.contains_key(&(c, d)) || facet_at.contains_key(&(d, c));
                if d == c || elsewhere || normals[m as usize].normal().dot(normal) < SAME_FACE {
                    continue;
                }
                let (one, two) = ([c, a, d], [d, b, c]);
                let worse = facing(one, normal).min(facing(two, normal));
                if worse > FORWARDS && best.as_ref().is_none_or(|b| worse > b.worse) {
                    best = Some(Turn { worse, neighbour: m as usize, edge: (a, b), facets: [one, two] });
                }
            }
            let Some(Turn { neighbour, edge: (a, b), facets: [one, two], .. }) = best else { return true };
            facet_at.remove(&(a, b));
            facet_at.remove(&(b, a));
            for (n, [a, b, c]) in [(n, one), (neighbour, two)] {
                triangles[n] = [a, b, c];
                facet_at.extend([((a, b), n as u32), ((b, c), n as u32), ((c, a), n as u32)]);
            }
            turned = true;
            false
        });
        if !turned || found.is_empty() {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Mesh;

    #[test]
    fn a_fold_in_a_flat_face_is_laid_straight() {
        // A pyramid over a square whose base has a vertex (4) off the fan's centre: the facet 0 4 1 is folded over.
        let at = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, -0.5], [2.0, 1.0]];
        let mut vertices: Vec<DVec3> = at.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
        vertices.push(DVec3::new(2.0, 2.0, -3.0));
        let mut mesh = Mesh {
            vertices,
            // Top, seen from above: 0 1 5, 1 2 5, 2 3 5, 3 0 5; then 0 4 1 hangs on its edge 0 1.
            triangles: vec![
                [0, 1, 5],
                [1, 2, 5],
                [2, 3, 5],
                [3, 0, 5],
                [0, 4, 1],
                [4, 0, 6],
                [1, 4, 6],
                [2, 1, 6],
                [3, 2, 6],
                [0, 3, 6],
            ],
        };
        // The vertex 4 moved inwards folds its facet.
        mesh.vertices[4].y = 0.2;
        mesh.check_closed().unwrap();
        let up = PackedNormal::new(DVec3::Z, 0);
        let down = PackedNormal::new(-DVec3::Z, 0);
        let normals: Vec<_> = (0..10).map(|n| if n < 5 { up } else { down }).collect();
        let volume = mesh.volume();
        unfold(&mut mesh.triangles, &normals, &mesh.vertices);
        mesh.check_closed().unwrap();
        assert!((mesh.volume() - volume).abs() < 1e-12);
        for t in &mesh.triangles[..5] {
            let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
            assert!((b - a).cross(c - a).z > 0.0, "{t:?}");
        }
    }
}
