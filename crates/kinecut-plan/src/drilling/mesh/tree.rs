//! A tree of boxes over the triangles of a mesh, for [`super::PartMesh`]: which triangles may lie within a distance of a
//! line, in any direction.
//!
//! The triangles are sorted along a Morton curve through their centres (Lauterbach and others, 2009), so that neighbours
//! in the list are neighbours in space; each box holds a fixed number of neighbours in the list, and needs no links.

use glam::DVec3;
use rayon::prelude::*;

use crate::geom::{Aabb, Mesh};

/// Triangles in a box of the lowest level.
const LEAF: usize = 8;
/// Boxes in a box of the next level.
const FAN: usize = 4;
/// Steps of the Morton grid along an axis: three times 21 bits fill a word.
const STEPS: f64 = 2_097_151.0;

/// Boxes over a list of triangles, the lowest level first.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    levels: Vec<Vec<Aabb>>,
    count: usize,
}

impl Tree {
    /// Sorts the triangles of a mesh and builds the boxes over them.
    pub(super) fn new(mesh: &mut Mesh) -> Tree {
        let bounds = mesh.bounds();
        let scale = bounds.size().to_array().map(|s| if s > 0.0 { STEPS / s } else { 0.0 });
        let vertices = &mesh.vertices;
        let corners = |t: &[u32; 3]| t.map(|i| vertices[i as usize]);
        let code = |t: &[u32; 3]| {
            let [a, b, c] = corners(t);
            let centre = ((a + b + c) / 3.0 - bounds.min).to_array();
            (0..3).fold(0, |code, k| code | spread((centre[k] * scale[k]) as u64) << k)
        };
        let mut order: Vec<(u64, [u32; 3])> = mesh.triangles.par_iter().map(|t| (code(t), *t)).collect();
        order.par_sort_unstable();
        mesh.triangles = order.into_iter().map(|(_, t)| t).collect();
        let leaf = |chunk: &[[u32; 3]]| {
            chunk.iter().fold(Aabb::EMPTY, |all, t| all.union(Aabb::of_points(corners(t))))
        };
        let mut levels: Vec<Vec<Aabb>> = vec![mesh.triangles.par_chunks(LEAF).map(leaf).collect()];
        while let Some(last) = levels.last()
            && last.len() > 1
        {
            let next = last.chunks(FAN).map(|c| c.iter().fold(Aabb::EMPTY, |all, b| all.union(*b)));
            let next = next.collect();
            levels.push(next);
        }
        Tree { levels, count: mesh.triangles.len() }
    }

    /// Calls `visit` with the range of each leaf whose box may come within `radius` of the line through `at` that is
    /// square to the unit vectors `across`.
    pub(super) fn near_line(
        &self,
        at: DVec3,
        across: [DVec3; 2],
        radius: f64,
        visit: &mut impl FnMut(std::ops::Range<usize>),
    ) {
        let outwards = across.map(DVec3::abs);
        let far = |b: &Aabb| {
            let (centre, half) = ((b.min + b.max) * 0.5 - at, (b.max - b.min) * 0.5);
            let gap = |k: usize| {
                let g = across[k].dot(centre).abs() - outwards[k].dot(half);
                if g > 0.0 { g } else { 0.0 }
            };
            gap(0).hypot(gap(1)) > radius
        };
        self.descend(self.levels.len() - 1, 0, &far, visit);
    }

    fn descend(
        &self,
        level: usize,
        n: usize,
        far: &impl Fn(&Aabb) -> bool,
        visit: &mut impl FnMut(std::ops::Range<usize>),
    ) {
        if far(&self.levels[level][n]) {
            return;
        }
        if level == 0 {
            visit(n * LEAF..((n + 1) * LEAF).min(self.count));
            return;
        }
        for child in n * FAN..((n + 1) * FAN).min(self.levels[level - 1].len()) {
            self.descend(level - 1, child, far, visit);
        }
    }
}

/// The lowest 21 bits, two gaps after each.
fn spread(x: u64) -> u64 {
    let mut x = x & 0x1f_ffff;
    for (shift, mask) in [
        (32, 0x1f_0000_0000_ffff),
        (16, 0x1f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        x = (x | x << shift) & mask;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn bits_are_spread() {
        assert_eq!(spread(0b1011), 0b1_000_001_001);
        assert_eq!(spread(0x1f_ffff).count_ones(), 21);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        /// No triangle near the line is left out.
        #[test]
        fn all_triangles_near_a_line_are_found(
            points in prop::collection::vec(prop::array::uniform3(-50.0..50.0f64), 200),
            at in prop::array::uniform3(-40.0..40.0f64),
            to in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let vertices: Vec<DVec3> = points
                .iter()
                .flat_map(|p| [DVec3::ZERO, DVec3::X, DVec3::Y].map(|d| DVec3::from(*p) + d))
                .collect();
            let triangles = (0..200).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            let mut mesh = Mesh { vertices, triangles };
            let tree = Tree::new(&mut mesh);
            let Some(along) = DVec3::from(to).try_normalize() else { return Ok(()) };
            let (e, f) = along.any_orthonormal_pair();
            let mut found = [false; 200];
            tree.near_line(at.into(), [e, f], 5.0, &mut |range| found[range].fill(true));
            for (n, t) in mesh.triangles.iter().enumerate() {
                let p = mesh.vertices[t[0] as usize] - DVec3::from(at);
                let distance = p.cross(along).length();
                prop_assert!(found[n] || distance >= 5.0);
            }
        }
    }

    #[test]
    fn few_triangles_are_looked_at() {
        let mut mesh = Mesh::default();
        for i in 0..2000u32 {
            let p = DVec3::new(f64::from(i % 50), f64::from(i / 50), 0.0);
            mesh.vertices.extend([p, p + DVec3::X, p + DVec3::Y]);
            mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let tree = Tree::new(&mut mesh);
        let mut seen = 0;
        tree.near_line(DVec3::new(20.3, 20.3, 7.0), [DVec3::X, DVec3::Y], 2.0, &mut |range| {
            seen += range.len()
        });
        assert!((16..120).contains(&seen), "{seen}");
    }
}
