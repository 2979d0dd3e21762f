//! The facets: around each crossed lattice edge the vertices of the leaves of its four cells.

use glam::DVec3;
use rayon::prelude::*;

use super::cell::{edge, loops};
use super::crossing::Lines;
use super::forest::Forest;
use super::rows::{BLOCK, Rows, bits};
use super::signs::Signs;
use super::tree::Node;
use crate::base::Progress;
use crate::stock::{Axis, CutId, DexelGrid, PackedNormal};

/// Trees that one task works through.
const CHUNK: usize = 64;

/// A diagonal that makes the facets face this much better is taken even if it is longer (1 degree).
const CLEARLY_FLATTER: f64 = 1.5e-4;

/// Triangles with what the end point says on whose edge each was made.
#[derive(Debug, Default)]
pub(super) struct Facets {
    /// Vertices, counter-clockwise from outside.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Normal of the surface.
    pub(super) normals: Vec<PackedNormal>,
    /// The move that cut it.
    pub(super) cuts: Vec<CutId>,
}

/// All triangles.
pub(super) fn polygons<G: DexelGrid + ?Sized>(
    forest: &Forest,
    lines: &Lines<'_, G>,
    signs: &Signs,
    vertices: &[DVec3],
    progress: &dyn Progress,
) -> Option<Facets> {
    let parts: Vec<Facets> = (0..forest.trees.len().div_ceil(CHUNK))
        .into_par_iter()
        .map_init(Rows::new, |rows, chunk| {
            let mut maker = Maker { forest, lines, signs, vertices, facets: Facets::default() };
            for t in chunk * CHUNK..((chunk + 1) * CHUNK).min(forest.trees.len()) {
                maker.tree(t, rows);
            }
            (!progress.cancelled()).then_some(maker.facets)
        })
        .collect::<Option<_>>()?;
    let mut all = Facets::default();
    let count = parts.iter().map(|p| p.triangles.len()).sum();
    all.triangles.reserve_exact(count);
    all.normals.reserve_exact(count);
    all.cuts.reserve_exact(count);
    for part in parts {
        all.triangles.extend(part.triangles);
        all.normals.extend(part.normals);
        all.cuts.extend(part.cuts);
    }
    Some(all)
}

struct Maker<'a, G: ?Sized> {
    forest: &'a Forest,
    lines: &'a Lines<'a, G>,
    signs: &'a Signs,
    vertices: &'a [DVec3],
    facets: Facets,
}

impl<G: DexelGrid + ?Sized> Maker<'_, G> {
    /// The facets around the edges whose lower point lies in the block of a tree, upper borders excluded.
    fn tree(&mut self, t: usize, rows: &mut Rows) {
        let place = self.forest.places[t];
        rows.read(self.signs, place);
        // In a block with one leaf only edges in its lower faces have cells of other leaves around them.
        let one_leaf = matches!(self.forest.trees[t].root, Node::Leaf(_));
        for axis in Axis::ALL {
            for z in 0..BLOCK {
                for y in 0..BLOCK {
                    let (crossed, row) = rows.crossed(axis, y, z);
                    let border = (y == 0 && axis != Axis::Y) || (z == 0 && axis != Axis::Z);
                    let first = u32::from(axis != Axis::X);
                    let mask = if one_leaf && !border { first } else { 0xffff };
                    for x in bits(crossed & mask) {
                        let p = [x, y, z];
                        let p = std::array::from_fn(|i| place[i] * BLOCK + p[i]);
                        self.edge(axis, p, row >> x & 1 == 1);
                    }
                }
            }
        }
    }

    /// The facet around a crossed edge.
    fn edge(&mut self, axis: Axis, p: [u32; 3], leaving: bool) {
        let (u, v) = axis.others();
        // Counter-clockwise seen from the far end of the edge.
        let around = [(1, 1), (0, 1), (0, 0), (1, 0)];
        let mut ring = [0; 4];
        // Leaves are cubes: one that holds two opposite cells holds all four.
        let cell_at = |(du, dv): (u32, u32)| {
            let mut cell = p;
            cell[u.index()] -= du;
            cell[v.index()] -= dv;
            cell
        };
        let (here, opposite) = (self.forest.leaf(p), self.forest.leaf(cell_at((1, 1))));
        if let (Node::Leaf(a), Node::Leaf(b)) = (here, opposite)
            && a == b
        {
            return;
        }
        for (n, (du, dv)) in around.into_iter().enumerate() {
            let cell = cell_at((du, dv));
            let leaf = match (du, dv) {
                (0, 0) => here,
                (1, 1) => opposite,
                _ => self.forest.leaf(cell),
            };
            ring[n] = match leaf {
                Node::Leaf(vertex) => vertex,
                Node::Cell(vertex) => vertex + u32::from(loops(self.signs, cell).of_edge[edge(axis, du, dv)]),
                // A cell around a crossed edge has surface in it.
                Node::Empty | Node::Inner(_) => return,
            };
        }
        if !leaving {
            ring.reverse();
        }
        let mut corners = [0; 4];
        let mut n = 0;
        for i in 0..4 {
            if ring[i] != ring[(i + 3) % 4] {
                corners[n] = ring[i];
                n += 1;
            }
        }
        if n < 3 {
            return;
        }
        let end = self.lines.crossing(axis, p, leaving);
        let [a, b, c, d] = corners;
        if n == 3 {
            self.facets.triangles.push([a, b, c]);
        } else if self.second_diagonal(corners, end.normal.normal()) {
            self.facets.triangles.extend([[a, b, d], [b, c, d]]);
        } else {
            self.facets.triangles.extend([[a, b, c], [a, c, d]]);
        }
        self.facets.normals.resize(self.facets.triangles.len(), end.normal);
        self.facets.cuts.resize(self.facets.triangles.len(), end.cut);
    }

    /// True if a quad is better divided from its second to its fourth corner: the two facets face the normal of the
    /// surface better, or as well and the diagonal is shorter.
    fn second_diagonal(&self, corners: [u32; 4], normal: DVec3) -> bool {
        let [a, b, c, d] = corners.map(|i| self.vertices[i as usize]);
        let facing = |p: DVec3, q: DVec3, r: DVec3| {
            let n = (q - p).cross(r - p);
            n.try_normalize().map_or(0.0, |n| n.dot(normal))
        };
        let first = facing(a, b, c).min(facing(a, c, d));
        let second = facing(a, b, d).min(facing(b, c, d));
        if (first - second).abs() > CLEARLY_FLATTER {
            second > first
        } else {
            b.distance_squared(d) < a.distance_squared(c)
        }
    }
}
