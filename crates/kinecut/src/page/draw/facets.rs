//! Flat faces of a body: which are seen, their shades, and which of their edges are drawn.
//!
//! An edge is drawn where the surface bends sharply, where it ends, and where the next face is not seen (the outline). A mesh
//! of more faces than a picture can show is taken coarser: corners of one cell of a grid become one.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use crate::geom::{Mesh, Rigid, Solid};

/// Faces round a cylinder.
const ROUND: usize = 48;
/// Two faces that meet at less than this are one bent surface [cosine of 30 degrees].
const BEND: f64 = 0.866;
/// Most triangles of a mesh in a picture.
const MOST: usize = 4000;
/// Cells of the first grid along the longest side, for meshes with more triangles.
const CELLS: f64 = 96.0;

/// Faces with shared corners, counter-clockwise from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Facets {
    pub(crate) corners: Vec<DVec3>,
    pub(crate) faces: Vec<Vec<u32>>,
}

/// A face that is seen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SeenFace {
    pub(crate) outline: Vec<DVec3>,
    /// Whether the edge from each corner to the next is drawn.
    pub(crate) drawn: Vec<bool>,
    /// Unit normal.
    pub(crate) normal: DVec3,
}

impl Facets {
    /// The faces of a solid at a place.
    pub(crate) fn of(solid: &Solid, place: &Rigid) -> Facets {
        let mut facets = match solid {
            Solid::Box(b) => {
                let corner = |i: u32| {
                    let pick = |bit: u32, k: usize| if i & bit == 0 { b.min[k] } else { b.max[k] };
                    DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
                };
                let faces =
                    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
                Facets { corners: (0..8).map(corner).collect(), faces: faces.map(|f| f.to_vec()).to_vec() }
            }
            Solid::Cylinder { base, radius, height } => cylinder(*base, *radius, *height),
            Solid::Mesh(mesh) => coarse(mesh),
        };
        for corner in &mut facets.corners {
            *corner = place.point(*corner);
        }
        facets
    }

    /// The box about them: least and greatest coordinates.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        let all = || self.corners.iter().copied();
        [all().fold(DVec3::INFINITY, DVec3::min), all().fold(DVec3::NEG_INFINITY, DVec3::max)]
    }

    /// The faces that a viewer in a direction sees, each with its number.
    pub(crate) fn seen(&self, viewer: DVec3) -> Vec<(usize, SeenFace)> {
        let normals: Vec<Option<DVec3>> = self.faces.iter().map(|face| self.normal(face)).collect();
        let mut beside: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for (i, face) in self.faces.iter().enumerate().filter(|(i, _)| normals[*i].is_some()) {
            for (a, b) in edges(face) {
                beside.entry([a.min(b), a.max(b)]).or_default().push(i);
            }
        }
        let front = |i: usize| normals[i].is_some_and(|n| n.dot(viewer) > 0.0);
        let drawn = |here: usize, a: u32, b: u32| {
            let Some(faces) = beside.get(&[a.min(b), a.max(b)]) else { return true };
            let other = match faces[..] {
                [x, y] if x == here => y,
                [x, y] if y == here => x,
                _ => return true,
            };
            let flat = normals[here].zip(normals[other]).is_some_and(|(a, b)| a.dot(b) > BEND);
            !flat || !front(other)
        };
        let mut seen = Vec::new();
        for (i, face) in self.faces.iter().enumerate() {
            if let Some(normal) = normals[i].filter(|_| front(i)) {
                let face = SeenFace {
                    outline: face.iter().map(|&c| self.corners[c as usize]).collect(),
                    drawn: edges(face).map(|(a, b)| drawn(i, a, b)).collect(),
                    normal,
                };
                seen.push((i, face));
            }
        }
        seen
    }

    /// The normal of a face (Newell), none of one without area.
    fn normal(&self, face: &[u32]) -> Option<DVec3> {
        let at = |c: u32| self.corners[c as usize];
        let about = at(*face.first()?);
        let sum: DVec3 = edges(face).map(|(a, b)| (at(a) - about).cross(at(b) - about)).sum();
        sum.try_normalize()
    }
}

fn edges(face: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()]))
}

fn cylinder(base: DVec3, radius: f64, height: f64) -> Facets {
    let corner = |i: usize, z: f64| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / ROUND as f64).sin_cos();
        base + DVec3::new(radius * cos, radius * sin, z)
    };
    let mut corners: Vec<DVec3> = (0..ROUND).map(|i| corner(i, 0.0)).collect();
    corners.extend((0..ROUND).map(|i| corner(i, height)));
    let n = ROUND as u32;
    let mut faces: Vec<Vec<u32>> = (0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]).collect();
    faces.push((0..n).rev().collect());
    faces.push((n..2 * n).collect());
    Facets { corners, faces }
}

/// A mesh as it is, or coarser until a picture can show it.
fn coarse(mesh: &Mesh) -> Facets {
    let whole =
        Facets { corners: mesh.vertices.clone(), faces: mesh.triangles.iter().map(|t| t.to_vec()).collect() };
    let (bounds, mut cells) = (mesh.bounds(), CELLS);
    let mut facets = whole;
    while facets.faces.len() > MOST && cells >= 1.0 {
        facets = merged(mesh, bounds.min, bounds.size().max_element() / cells);
        cells *= 0.75;
    }
    facets
}

/// All corners in one cell become one, in their middle; triangles that vanish are left out.
fn merged(mesh: &Mesh, least: DVec3, cell: f64) -> Facets {
    let key = |v: DVec3| ((v - least) / cell).floor().to_array().map(|c| c as i64);
    let mut cells: BTreeMap<[i64; 3], (u32, DVec3, f64)> = BTreeMap::new();
    for &v in &mesh.vertices {
        let next = cells.len() as u32;
        let entry = cells.entry(key(v)).or_insert((next, DVec3::ZERO, 0.0));
        entry.1 += v;
        entry.2 += 1.0;
    }
    let mut corners = vec![DVec3::ZERO; cells.len()];
    for (index, sum, count) in cells.values() {
        corners[*index as usize] = *sum / *count;
    }
    let mut known = BTreeSet::new();
    let mut faces = Vec::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| cells.get(&key(mesh.vertices[i as usize])).map_or(0, |e| e.0));
        let mut same = [a, b, c];
        same.sort_unstable();
        if a != b && b != c && c != a && known.insert(same) {
            faces.push(vec![a, b, c]);
        }
    }
    Facets { corners, faces }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Aabb;

    fn seen(facets: &Facets) -> Vec<SeenFace> {
        facets.seen(DVec3::new(1.0, -1.0, 1.0)).into_iter().map(|f| f.1).collect()
    }

    fn of(solid: &Solid) -> Facets {
        Facets::of(solid, &Rigid::IDENTITY)
    }

    #[test]
    fn of_a_box_three_faces_are_seen_with_all_edges() {
        let seen = seen(&of(&Solid::Box(Aabb { min: DVec3::ZERO, max: DVec3::ONE })));
        let mut normals: Vec<[i32; 3]> = seen.iter().map(|f| f.normal.to_array().map(|c| c as i32)).collect();
        normals.sort_unstable();
        assert_eq!(normals, [[0, -1, 0], [0, 0, 1], [1, 0, 0]]);
        assert!(seen.iter().all(|f| f.drawn.iter().all(|d| *d)));
    }

    #[test]
    fn of_a_cylinder_the_lid_and_the_outline_are_drawn_but_no_ruling_between() {
        let seen = seen(&of(&Solid::Cylinder { base: DVec3::ZERO, radius: 10.0, height: 5.0 }));
        let lid = seen.iter().find(|f| f.outline.len() == ROUND).unwrap();
        assert!(lid.drawn.iter().all(|d| *d) && lid.normal.z > 0.999);
        let upright = |f: &SeenFace| {
            let ends = (0..4).map(|i| (f.outline[i], f.outline[(i + 1) % 4]));
            ends.zip(&f.drawn).filter(|((a, b), drawn)| **drawn && (a.z - b.z).abs() > 1.0).count()
        };
        let rulings: usize = seen.iter().filter(|f| f.outline.len() == 4).map(upright).sum();
        assert_eq!(rulings, 2, "the outline to the left and to the right");
    }

    #[test]
    fn a_fine_mesh_is_taken_coarser_and_keeps_its_size() {
        let n = 120u32;
        let at = |i: u32, j: u32| DVec3::new(f64::from(i), f64::from(j), (0.2 * f64::from(i)).sin());
        let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| at(i, j))).collect();
        let c = |i: u32, j: u32| i * (n + 1) + j;
        let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let triangles = quads
            .flat_map(|(i, j)| {
                [[c(i, j), c(i + 1, j), c(i + 1, j + 1)], [c(i, j), c(i + 1, j + 1), c(i, j + 1)]]
            })
            .collect();
        let mesh = Mesh { vertices, triangles };
        let facets = of(&Solid::Mesh(mesh));
        assert!(facets.faces.len() <= MOST && facets.faces.len() > MOST / 4, "{}", facets.faces.len());
        let wide = facets.corners.iter().map(|p| p.x).fold(0.0, f64::max);
        assert!(wide > 117.0 && wide <= 120.0);
    }
}
