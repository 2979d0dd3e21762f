//! The octrees of all blocks, and which leaf holds a cell.

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

impl Forest {
    /// The octrees of a body; `None` when it was cancelled.
    pub(super) fn grow<G: DexelGrid + ?Sized>(
        lines: &Lines<'_, G>,
        signs: &Signs,
        tolerance: f64,
        progress: &dyn Progress,
    ) -> Option<Forest> {
        let counts = signs.counts().map(|n| (n - 1).div_ceil(BLOCK));
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
        let trees = places
            .par_iter()
            .map_init(
                || Block::new(lines, signs, tolerance),
                |block, &place| (!progress.cancelled()).then(|| block.tree(place)),
            )
            .collect::<Option<_>>()?;
        Some(Forest { counts, contents, places, trees, merged: Vec::new() })
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
