//! The octrees of all blocks, and which leaf holds a cell.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use glam::DVec3;
use rayon::prelude::*;

use super::block::Block;
use super::crossing::Lines;
use super::rows::BLOCK;
use super::signs::Signs;
use super::tree::{Node, Tree};
use crate::base::Progress;
use crate::stock::DexelGrid;

/// Blocks whose points are all void, or all material.
const VOID: u32 = u32::MAX;
const SOLID: u32 = u32::MAX - 1;

/// Contents of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Content {
    /// No surface: all void or all material.
    Alike(bool),
    /// The tree of this number.
    Tree(u32),
}

/// The octrees of all blocks with surface.
pub(super) struct Forest {
    /// Blocks along X, Y, Z.
    pub(super) counts: [u32; 3],
    contents: Vec<u32>,
    /// Places of the trees, in blocks.
    pub(super) places: Vec<[u32; 3]>,
    /// The trees, by Z, Y, X.
    pub(super) trees: Vec<Tree>,
    /// Vertices of larger leaves [cells].
    pub(super) merged: Vec<DVec3>,
}

/// The octrees of a body.
pub(super) enum Grown {
    All(Forest),
    /// They, and the triangles that they would make, need so much memory, which is more than they may take [bytes].
    TooMuch(u64),
    Cancelled,
}

/// Memory that a vertex needs after the trees, with its two triangles [bytes]: 152 while the mesh is made (two lists of vertices, two
/// of triangles with a normal and a cut each); 280 where a report and an STL file are made of ten million of them.
const AFTER: u64 = 280;

impl Forest {
    /// Number of blocks by that of padded points.
    pub(super) fn blocks(counts: [u64; 3]) -> [u64; 3] {
        counts.map(|n| (n - 1).div_ceil(BLOCK.into()))
    }

    /// Memory of the contents of all blocks by the number of padded points [bytes].
    pub(super) fn bytes(counts: [u64; 3]) -> u64 {
        let each = size_of::<u32>() + size_of::<Option<bool>>();
        Forest::blocks(counts).into_iter().product::<u64>() * each as u64
    }

    /// The octrees of a body. Beyond `most` bytes of what they will become they are only counted.
    pub(super) fn grow<G: DexelGrid + ?Sized>(
        lines: &Lines<'_, G>,
        signs: &Signs,
        tolerance: f64,
        most: Option<u64>,
        progress: &dyn Progress,
    ) -> Grown {
        let counts = Forest::blocks(signs.counts().map(u64::from)).map(|n| n as u32);
        let row = counts[0] as usize;
        let mut alike: Vec<Option<bool>> = vec![None; row * counts[1] as usize * counts[2] as usize];
        alike.par_chunks_mut(row).enumerate().for_each(|(r, found)| {
            let r = r as u32;
            signs.alike(r % counts[1] * BLOCK, r / counts[1] * BLOCK, found);
        });
        let mut places = Vec::new();
        let mut contents = Vec::with_capacity(alike.len());
        for (n, alike) in alike.into_iter().enumerate() {
            contents.push(match alike {
                Some(false) => VOID,
                Some(true) => SOLID,
                None => {
                    let (x, r) = ((n % row) as u32, (n / row) as u32);
                    places.push([x, r % counts[1], r / counts[1]]);
                    places.len() as u32 - 1
                }
            });
        }
        let (bytes, most) = (AtomicU64::new(0), most.unwrap_or(u64::MAX));
        let trees = places.par_iter().map_init(
            || Block::new(lines, signs, tolerance),
            |block, &place| {
                if progress.cancelled() {
                    return None;
                }
                let tree = block.tree(place);
                let own = tree.bytes() + tree.vertices.len() as u64 * AFTER;
                let before = bytes.fetch_add(own, Relaxed);
                Some((before + own <= most).then_some(tree))
            },
        );
        let trees: Option<Vec<Option<Tree>>> = trees.collect();
        let bytes = bytes.into_inner();
        match trees {
            None => Grown::Cancelled,
            Some(_) if bytes > most => Grown::TooMuch(bytes),
            Some(trees) => {
                let trees = trees.into_iter().flatten().collect();
                Grown::All(Forest { counts, contents, places, trees, merged: Vec::new() })
            }
        }
    }

    /// Contents of a block; void beyond the last one.
    pub(super) fn content(&self, place: [u32; 3]) -> Content {
        if (0..3).any(|i| place[i] >= self.counts[i]) {
            return Content::Alike(false);
        }
        let n = (place[2] * self.counts[1] + place[1]) as usize * self.counts[0] as usize + place[0] as usize;
        match self.contents[n] {
            VOID => Content::Alike(false),
            SOLID => Content::Alike(true),
            tree => Content::Tree(tree),
        }
    }

    /// Numbers the vertices of the mesh in the order of the trees and returns them [cells].
    pub(super) fn number(&mut self) -> Vec<DVec3> {
        let mut vertices = Vec::new();
        let mut numbers = vec![None; self.merged.len()];
        for tree in &mut self.trees {
            tree.base = vertices.len() as u32;
            match tree.merged {
                None => vertices.extend_from_slice(&tree.vertices),
                Some(m) => match numbers[m as usize] {
                    Some(number) => tree.base = number,
                    None => {
                        numbers[m as usize] = Some(tree.base);
                        vertices.push(self.merged[m as usize]);
                    }
                },
            }
        }
        vertices
    }

    /// The leaf that holds a cell, as a node with vertices numbered over the mesh.
    pub(super) fn leaf(&self, cell: [u32; 3]) -> Node {
        let Content::Tree(tree) = self.content(cell.map(|c| c / BLOCK)) else { return Node::Empty };
        let tree = &self.trees[tree as usize];
        let mut node = tree.root;
        let mut half = BLOCK / 2;
        loop {
            match node {
                Node::Inner(first) => {
                    let side = |i: usize| u32::from(cell[i] & half != 0) << i;
                    node = tree.nodes[(first + side(0) + side(1) + side(2)) as usize];
                    half /= 2;
                }
                Node::Leaf(v) => return Node::Leaf(tree.base + v),
                Node::Cell(v) => return Node::Cell(tree.base + v),
                Node::Empty => return Node::Empty,
            }
        }
    }
}
