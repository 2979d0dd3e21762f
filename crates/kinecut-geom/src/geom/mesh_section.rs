//! The section of a closed mesh by a plane: of the material just below it.
//!
//! Vertices in the plane count as above it. Each triangle with corners on both sides then gives one stretch between two
//! of its sides, and as a closed mesh has each side in two triangles, the stretches join to loops without any tolerance.
//! With vertices in the plane stretches have no length, or double back over one another; these are taken out.

use glam::DVec3;

use super::Mesh;
use crate::base::Result;

/// A vertex no farther below the plane than this lies in it [mm]: the step in which ends of lines are kept.
const IN_PLANE: f64 = 1e-5;

/// A closed outline in which a plane cuts a solid.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionOutline {
    /// Corners [mm]; the last one is joined to the first. Seen against the normal of the plane, material lies to the left.
    pub points: Vec<DVec3>,
    /// Area within it [mm^2]: positive for an outer outline, negative for a hole.
    pub area: f64,
    /// Length around it [mm].
    pub length: f64,
}

impl Mesh {
    /// The outlines in which the plane `normal . p = at` (`normal` of unit length, `at` in mm) cuts the material of a closed mesh
    /// just below it. At the top face of a part this is the face, at its bottom face there is no section.
    ///
    /// # Errors
    /// `KC0602` when the mesh is not closed.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::Mesh;
    /// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// let mesh = Mesh { vertices: corners.map(Into::into).to_vec(), triangles };
    /// let outlines = mesh.section([0.0, 0.0, 1.0].into(), 1.0).unwrap();
    /// assert_eq!((outlines.len(), outlines[0].points.len(), outlines[0].area), (1, 3, 0.5));
    /// assert!(mesh.section([0.0, 0.0, 1.0].into(), 0.0).unwrap().is_empty());
    /// ```
    pub fn section(&self, normal: DVec3, at: f64) -> Result<Vec<SectionOutline>> {
        self.check_closed()?;
        let loops = section_loops(self, normal, at).into_iter();
        Ok(loops.map(|points| outline(points, normal)).collect())
    }
}

/// The loops of [`Mesh::section`]; of a mesh that is not closed those that close.
pub(super) fn section_loops(mesh: &Mesh, normal: DVec3, at: f64) -> Vec<Vec<DVec3>> {
    let heights: Vec<f64> = mesh.vertices.iter().map(|v| normal.dot(*v) - at).collect();
    let above = |i: u32| heights[i as usize] >= -IN_PLANE;
    // From the side where the section enters a triangle to the one where it leaves it.
    let mut steps: Vec<(Side, Side)> = Vec::new();
    for t in &mesh.triangles {
        let side = |falls: bool| {
            let sides = [0, 1, 2].map(|i| (t[i], t[(i + 1) % 3]));
            sides.into_iter().find(|&(a, b)| above(a) == falls && above(b) != falls)
        };
        // Seen from outside the corners run counter-clockwise: with the upper side up, material is on the left of the
        // stretch from the falling side to the rising one seen from above.
        if let (Some((high, low)), Some(rising)) = (side(true), side(false)) {
            steps.push(((low, high), rising));
        }
    }
    steps.sort_unstable();
    let point = |(low, high): Side| {
        let [a, b] = [low, high].map(|i| heights[i as usize]);
        mesh.vertices[low as usize].lerp(mesh.vertices[high as usize], (a / (a - b)).clamp(0.0, 1.0))
    };
    let mut gone = vec![false; steps.len()];
    let mut loops = Vec::new();
    for first in 0..steps.len() {
        let mut points = Vec::new();
        let mut n = first;
        while !std::mem::replace(&mut gone[n], true) {
            points.push(point(steps[n].0));
            match steps.binary_search_by_key(&steps[n].1, |step| step.0) {
                Ok(following) => n = following,
                Err(_) => break,
            }
        }
        let points = without_spikes(points);
        if points.len() > 2 {
            loops.push(points);
        }
    }
    loops
}

/// A side of triangles, from its lower end up.
type Side = (u32, u32);

/// Without points that come twice and stretches that go out and come back the same way.
fn without_spikes(points: Vec<DVec3>) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::with_capacity(points.len());
    for p in points {
        if kept.last() == Some(&p) {
            continue;
        }
        if kept.len() > 1 && kept[kept.len() - 2] == p {
            kept.pop();
        } else {
            kept.push(p);
        }
    }
    // The same across the end of the list.
    let mut from = 0;
    while kept.len() - from > 1 {
        let n = kept.len();
        if kept[n - 1] == kept[from] || kept.len() - from > 2 && kept[n - 2] == kept[from] {
            kept.pop();
        } else if kept.len() - from > 2 && kept[n - 1] == kept[from + 1] {
            from += 1;
        } else {
            break;
        }
    }
    kept.split_off(from)
}

/// An outline with its measures, about its first point, so that a part far from the origin loses no digits.
fn outline(points: Vec<DVec3>, normal: DVec3) -> SectionOutline {
    let o = points[0];
    let (mut twice, mut length) = (DVec3::ZERO, 0.0);
    for (i, p) in points.iter().enumerate() {
        let q = points[(i + 1) % points.len()];
        twice += (*p - o).cross(q - o);
        length += p.distance(q);
    }
    SectionOutline { area: 0.5 * twice.dot(normal), length, points }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// A box, optionally turned inside out.
    fn block(min: [f64; 3], max: [f64; 3], inside_out: bool) -> Mesh {
        let vertices = (0..8)
            .map(|i| DVec3::from_array([0, 1, 2].map(|k| if i >> k & 1 == 1 { max[k] } else { min[k] })));
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let mut triangles: Vec<[u32; 3]> =
            quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        if inside_out {
            triangles.iter_mut().for_each(|t| t.swap(0, 1));
        }
        Mesh { vertices: vertices.collect(), triangles }
    }

    /// A block with a closed hollow.
    fn hollow() -> Mesh {
        let mut mesh = block([0.0; 3], [10.0, 8.0, 6.0], false);
        let inner = block([2.0, 3.0, 1.0], [5.0, 5.0, 4.0], true);
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(inner.vertices);
        mesh.triangles.extend(inner.triangles.iter().map(|t| t.map(|i| i + first)));
        mesh
    }

    fn areas(mesh: &Mesh, normal: DVec3, at: f64) -> Vec<f64> {
        let rounded = |area: f64| (area * 1e9).round() / 1e9;
        mesh.section(normal, at).unwrap().iter().map(|o| rounded(o.area)).collect()
    }

    #[test]
    fn a_hollow_is_an_outline_of_its_own() {
        let mesh = hollow();
        assert_eq!(areas(&mesh, DVec3::Z, 2.0), [80.0, -6.0]);
        assert_eq!(areas(&mesh, DVec3::Y, 4.0), [60.0, -9.0]);
        assert_eq!(areas(&mesh, -DVec3::X, -4.0), [48.0, -6.0]);
        assert_eq!(mesh.section(DVec3::Z, 2.0).unwrap()[1].length, 10.0);
        assert!(areas(&mesh, DVec3::Z, -1.0).is_empty() && areas(&mesh, DVec3::Z, 6.5).is_empty());
    }

    #[test]
    fn faces_in_the_plane_count_by_what_lies_under_them() {
        let mesh = hollow();
        assert!(areas(&mesh, DVec3::Z, 0.0).is_empty());
        assert_eq!(areas(&mesh, DVec3::Z, 6.0), [80.0]);
        assert_eq!(areas(&mesh, DVec3::Z, 1.0), [80.0]);
        assert_eq!(areas(&mesh, DVec3::Z, 4.0), [80.0, -6.0]);
        // As it is for a face that is off by less than the ends of lines are kept to.
        assert_eq!(areas(&mesh, DVec3::Z, 6.0 + 5e-6), [80.0]);
    }

    #[test]
    fn sections_add_up_to_the_volume() {
        // Along any direction the areas of sections integrate to the volume: by the trapezoids of a piecewise parabola the sum of
        // many is within 0.1 %.
        let mut mesh = hollow();
        let mut random = Random(11);
        for _ in 0..20 {
            let normal = DVec3::from_array([0, 1, 2].map(|_| 2.0 * random.share() - 1.0));
            let Some(normal) = normal.try_normalize() else { continue };
            let shift = normal * (600.0 * random.share() - 300.0);
            mesh.vertices.iter_mut().for_each(|v| *v += shift);
            let heights = mesh.vertices.iter().map(|v| normal.dot(*v));
            let (low, high) = heights.fold((f64::MAX, f64::MIN), |(l, h), z| (l.min(z), h.max(z)));
            let step = (high - low) / 2000.0;
            let area = |i: u32| areas(&mesh, normal, low + (f64::from(i) + 0.5) * step).iter().sum::<f64>();
            let volume = (0..2000).map(area).sum::<f64>() * step;
            let exact = 10.0 * 8.0 * 6.0 - 3.0 * 2.0 * 3.0;
            assert!((volume - exact).abs() < 1e-3 * exact, "{normal}: {volume}");
        }
    }

    #[test]
    fn an_open_mesh_has_no_section() {
        let mut mesh = hollow();
        mesh.triangles.pop();
        assert_eq!(mesh.section(DVec3::Z, 2.0).unwrap_err().code(), crate::base::Code::MESH_OPEN);
    }
}
