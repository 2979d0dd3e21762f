//! Blocks of 16^3 cells, each an octree whose leaves have one vertex.

use glam::DVec3;

use super::cell::{edge_start, loops};
use super::crossing::Lines;
use super::fit::{Hermite, fit, fit_cell};
use super::rows::{BLOCK, POINTS, Rows, bits};
use super::signs::Signs;
use super::tree::{Flat, Node, Tree};
use crate::stock::{Axis, DexelGrid};

/// A cube of cells in a block.
#[derive(Clone, Copy, Debug)]
struct Cube {
    low: [u32; 3],
    size: u32,
}

impl Cube {
    /// Rows (y, z) of lower points of the edges along an axis, borders included.
    fn rows(self, axis: Axis) -> impl Iterator<Item = (u32, u32)> {
        let last = |a: Axis| self.low[a.index()] + self.size - u32::from(a == axis);
        let (y, y1) = (self.low[1], last(Axis::Y));
        (self.low[2]..=last(Axis::Z)).flat_map(move |z| (y..=y1).map(move |y| (y, z)))
    }

    /// Bits x of lower points of the edges along an axis.
    fn mask(self, axis: Axis) -> u32 {
        let bits = self.size + u32::from(axis != Axis::X);
        ((1 << bits) - 1) << self.low[0]
    }
}

/// Directions in which the surface is crossed along the axes of a cube.
#[derive(Clone, Copy, Debug, Default)]
struct Ways {
    leaving: [bool; 3],
    entering: [bool; 3],
}

impl Ways {
    fn one_each(self) -> bool {
        !(0..3).any(|i| self.leaving[i] && self.entering[i])
    }
}

/// Makes the octree of one block after the other.
pub(super) struct Block<'a, G: ?Sized> {
    lines: &'a Lines<'a, G>,
    signs: &'a Signs,
    tolerance: f64,
    /// Lower corner [cells].
    low: [u32; 3],
    rows: Rows,
    gathered: bool,
    ends: Vec<Hermite>,
    /// For each edge of the block, by axis and lower point, the number of its end; only valid for crossed edges.
    end_of: Vec<u16>,
    points: Vec<Hermite>,
    clusters: Vec<u8>,
    heights: Vec<f64>,
}

impl<'a, G: DexelGrid + ?Sized> Block<'a, G> {
    /// Room for the work on blocks.
    pub(super) fn new(lines: &'a Lines<'a, G>, signs: &'a Signs, tolerance: f64) -> Block<'a, G> {
        Block {
            lines,
            signs,
            tolerance,
            low: [0; 3],
            rows: Rows::new(),
            gathered: false,
            ends: Vec::new(),
            end_of: vec![0; 3 * POINTS * POINTS * POINTS],
            points: Vec::new(),
            clusters: Vec::new(),
            heights: Vec::new(),
        }
    }

    /// The octree of the block at a place, in blocks.
    pub(super) fn tree(&mut self, place: [u32; 3]) -> Tree {
        self.low = place.map(|p| p * BLOCK);
        self.rows.read(self.signs, place);
        self.gathered = false;
        let mut tree = Tree {
            root: Node::Empty,
            nodes: Vec::new(),
            vertices: Vec::new(),
            flat: None,
            base: 0,
            merged: None,
        };
        tree.root = self.node(Cube { low: [0; 3], size: BLOCK }, &mut tree);
        tree.nodes.shrink_to_fit();
        tree.vertices.shrink_to_fit();
        tree
    }

    fn node(&mut self, cube: Cube, tree: &mut Tree) -> Node {
        if self.is_alike(cube) {
            return Node::Empty;
        }
        if cube.size == 1 {
            return self.cell(cube.low, tree);
        }
        let ways = self.ways(cube);
        let graph = self.graph(cube, ways);
        if let Some(flat) = graph.and_then(|(axis, leaving)| self.flat(cube, axis, leaving)) {
            if cube.size == BLOCK {
                tree.flat = Some(flat);
            }
            return leaf(tree, flat.vertex);
        }
        if graph.is_some() || ways.one_each() {
            self.gather();
            self.points.clear();
            for axis in Axis::ALL {
                for (y, z) in cube.rows(axis) {
                    let (crossed, _) = self.rows.crossed(axis, y, z);
                    for x in bits(crossed & cube.mask(axis)) {
                        let n = self.end_of[edge_index(axis, [x, y, z])];
                        self.points.push(self.ends[usize::from(n)]);
                    }
                }
            }
            let low = self.to_cells(cube.low);
            let high = low + f64::from(cube.size);
            let fit = fit(&self.points, low, high, self.tolerance, &mut self.clusters);
            if fit.error(cube.size.into()) <= self.tolerance {
                return leaf(tree, fit.vertex);
            }
        }
        let first = tree.nodes.len();
        tree.nodes.resize(first + 8, Node::Empty);
        let size = cube.size / 2;
        for n in 0..8 {
            let low = std::array::from_fn(|i| cube.low[i] + (n >> i & 1) * size);
            tree.nodes[first + n as usize] = self.node(Cube { low, size }, tree);
        }
        Node::Inner(first as u32)
    }

    /// The vertices of a single cell.
    fn cell(&mut self, at: [u32; 3], tree: &mut Tree) -> Node {
        self.gather();
        let loops = loops(self.signs, std::array::from_fn(|i| self.low[i] + at[i]));
        let first = tree.vertices.len() as u32;
        let low = self.to_cells(at);
        for l in 0..loops.count {
            self.points.clear();
            for edge in (0..12).filter(|&e| loops.of_edge[e] == l) {
                let (axis, start) = edge_start(edge);
                let n = self.end_of[edge_index(axis, std::array::from_fn(|i| at[i] + start[i]))];
                self.points.push(self.ends[usize::from(n)]);
            }
            tree.vertices.push(fit_cell(&self.points, low, low + 1.0, &mut self.clusters));
        }
        if loops.count == 1 { Node::Leaf(first) } else { Node::Cell(first) }
    }

    /// Whether all points of a cube are material, or all are void: then nothing crosses it.
    fn is_alike(&self, cube: Cube) -> bool {
        let ([x, y, z], size) = (cube.low, cube.size);
        let all = ((2 << size) - 1) << x;
        let first = self.rows.row(y, z) & all;
        let is_like = |row: &u32| row & all == first;
        let mut layers = (z..=z + size).map(|z| self.rows.layer(y, z, size as usize + 1));
        (first == 0 || first == all) && layers.all(|rows| rows.iter().all(is_like))
    }

    /// Directions of all crossings in a cube, its border included.
    fn ways(&self, cube: Cube) -> Ways {
        let ([_, y, z], size) = (cube.low, cube.size);
        let layer = |z: u32| self.rows.layer(y, z, size as usize + 1);
        let mut out = [0; 3];
        let mut back = [0; 3];
        let mut compare = |axis: usize, a: u32, b: u32| {
            out[axis] |= a & !b;
            back[axis] |= b & !a;
        };
        for n in z..=z + size {
            let rows = layer(n);
            for row in rows {
                compare(0, *row, row >> 1);
            }
            for (row, next) in rows.iter().zip(&rows[1..]) {
                compare(1, *row, *next);
            }
            if n < z + size {
                for (row, above) in rows.iter().zip(layer(n + 1)) {
                    compare(2, *row, *above);
                }
            }
        }
        let masks = Axis::ALL.map(|axis| cube.mask(axis));
        Ways {
            leaving: std::array::from_fn(|i| out[i] & masks[i] != 0),
            entering: std::array::from_fn(|i| back[i] & masks[i] != 0),
        }
    }

    /// The axis along which the surface is crossed exactly once and in one direction on each lattice line, and true if
    /// it leaves the material.
    fn graph(&self, cube: Cube, ways: Ways) -> Option<(Axis, bool)> {
        let [x0, y0, z0] = cube.low;
        let end = |axis: Axis, side: u32| {
            // Rows of the first or last layer along the axis: all void or all material?
            let (mut all, mut any) = (u32::MAX, 0);
            let layer = cube.low[axis.index()] + side * cube.size;
            for i in 0..=cube.size {
                match axis {
                    Axis::X => {
                        for j in 0..=cube.size {
                            let bit = self.rows.row(y0 + i, z0 + j) >> layer & 1;
                            all &= bit;
                            any |= bit;
                        }
                    }
                    _ => {
                        let row = if axis == Axis::Y {
                            self.rows.row(layer, z0 + i)
                        } else {
                            self.rows.row(y0 + i, layer)
                        };
                        let row = row >> x0 & ((2 << cube.size) - 1);
                        all &= u32::from(row == (2 << cube.size) - 1);
                        any |= row;
                    }
                }
            }
            match (all, any) {
                (1, _) => Some(true),
                (_, 0) => Some(false),
                _ => None,
            }
        };
        Axis::ALL.into_iter().find_map(|axis| {
            let i = axis.index();
            if ways.leaving[i] == ways.entering[i] {
                return None;
            }
            let leaving = ways.leaving[i];
            (end(axis, 0) == Some(leaving) && end(axis, 1) == Some(!leaving)).then_some((axis, leaving))
        })
    }

    /// The graph in a cube as a flat leaf, if all its ends lie within the tolerance of a plane.
    fn flat(&mut self, cube: Cube, axis: Axis, leaving: bool) -> Option<Flat> {
        let (u, v) = axis.others();
        let (n, half) = (cube.size + 1, cube.size / 2);
        let mut heights = std::mem::take(&mut self.heights);
        heights.clear();
        // Quick refusal: the mean height of the corners above the middle is no more than the largest residual.
        let mut last = cube.low[axis.index()];
        let mut column = |i: u32, j: u32| {
            let mut p = cube.low;
            p[u.index()] += i;
            p[v.index()] += j;
            self.column(cube, axis, p, leaving, &mut last)
        };
        let middle = column(half, half);
        let corners = [(0, 0), (0, n - 1), (n - 1, 0), (n - 1, n - 1)].map(|(i, j)| column(i, j));
        if (corners.iter().sum::<f64>() / 4.0 - middle).abs() > self.tolerance {
            self.heights = heights;
            return None;
        }
        heights.extend((0..n * n).map(|c| column(c % n, c / n) - middle));
        let centred = |i: usize| i as f64 - f64::from(half);
        let (mut a, mut b) = (0.0, 0.0);
        for (j, row) in heights.chunks_exact(n as usize).enumerate() {
            a += row.iter().enumerate().map(|(i, h)| centred(i) * h).sum::<f64>();
            b += centred(j) * row.iter().sum::<f64>();
        }
        // Sum of squares of -s/2 ... s/2 times the number of rows.
        let (s, rows) = (f64::from(cube.size), f64::from(n));
        let squares = rows * s * (s + 1.0) * (s + 2.0) / 12.0;
        let slopes = [a / squares, b / squares];
        let mut residual: f64 = 0.0;
        for (j, row) in heights.chunks_exact(n as usize).enumerate() {
            for (i, h) in row.iter().enumerate() {
                residual = residual.max((h - slopes[0] * centred(i) - slopes[1] * centred(j)).abs());
            }
        }
        self.heights = heights;
        let mut vertex = self.to_cells(cube.low) + f64::from(half);
        vertex[axis.index()] = middle;
        (residual <= self.tolerance).then_some(Flat { axis, leaving, vertex, slopes, residual })
    }

    /// Height [cells] of the one crossing on a lattice line of a graph; `last` is where it was on the line before.
    fn column(&self, cube: Cube, axis: Axis, mut p: [u32; 3], leaving: bool, last: &mut u32) -> f64 {
        let i = axis.index();
        let mut bit = |at: u32| {
            p[i] = at;
            (self.rows.row(p[1], p[2]) >> p[0] & 1 == 1) == leaving
        };
        // Before the crossing the points are `leaving`, behind it not.
        let (mut before, mut behind) = (cube.low[i], cube.low[i] + cube.size);
        if bit(*last) && !bit(*last + 1) {
            before = *last;
        } else {
            while behind - before > 1 {
                let middle = (before + behind) / 2;
                if bit(middle) { before = middle } else { behind = middle }
            }
            *last = before;
        }
        p[i] = before;
        if self.gathered {
            self.ends[usize::from(self.end_of[edge_index(axis, p)])].p[i]
        } else {
            self.lines.crossing(axis, std::array::from_fn(|i| self.low[i] + p[i]), leaving).at
        }
    }

    /// Reads all ends of the block.
    fn gather(&mut self) {
        if std::mem::replace(&mut self.gathered, true) {
            return;
        }
        self.ends.clear();
        let cube = Cube { low: [0; 3], size: BLOCK };
        for axis in Axis::ALL {
            for (y, z) in cube.rows(axis) {
                let (crossed, row) = self.rows.crossed(axis, y, z);
                for x in bits(crossed & cube.mask(axis)) {
                    let p = [self.low[0] + x, self.low[1] + y, self.low[2] + z];
                    let end = self.lines.crossing(axis, p, row >> x & 1 == 1);
                    let mut place = DVec3::from_array(p.map(f64::from));
                    place[axis.index()] = end.at;
                    self.end_of[edge_index(axis, [x, y, z])] = self.ends.len() as u16;
                    self.ends.push(Hermite { p: place, n: end.normal.normal() });
                }
            }
        }
    }

    /// A point of the block [cells of the lattice].
    fn to_cells(&self, at: [u32; 3]) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|i| f64::from(self.low[i] + at[i])))
    }
}

fn leaf(tree: &mut Tree, vertex: DVec3) -> Node {
    tree.vertices.push(vertex);
    Node::Leaf(tree.vertices.len() as u32 - 1)
}

fn edge_index(axis: Axis, p: [u32; 3]) -> usize {
    ((axis.index() * POINTS + p[2] as usize) * POINTS + p[1] as usize) * POINTS + p[0] as usize
}
