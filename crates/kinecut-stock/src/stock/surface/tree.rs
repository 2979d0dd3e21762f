//! The octree of a block of cells.

use glam::DVec3;

use crate::stock::Axis;

/// A node of an octree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Node {
    /// No surface in it.
    Empty,
    /// A leaf with this vertex.
    Leaf(u32),
    /// A single cell; the vertex of its first loop.
    Cell(u32),
    /// Eight children from this node on, x fastest.
    Inner(u32),
}

/// The surface in a block is the graph of a nearly plane function over a square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flat {
    /// The axis along which its height is measured.
    pub(super) axis: Axis,
    /// The material lies below.
    pub(super) leaving: bool,
    /// Its vertex [cells]: on the surface, in the middle of the square.
    pub(super) vertex: DVec3,
    /// Slopes along `axis.others()`.
    pub(super) slopes: [f64; 2],
    /// Largest distance along the axis of an end point from the plane [cells].
    pub(super) residual: f64,
}

impl Flat {
    /// Height of the plane [cells].
    pub(super) fn height(&self, u: f64, v: f64) -> f64 {
        let (a, b) = self.axis.others();
        self.vertex[self.axis.index()]
            + self.slopes[0] * (u - self.vertex[a.index()])
            + self.slopes[1] * (v - self.vertex[b.index()])
    }
}

/// The octree of a block.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub(super) root: Node,
    pub(super) nodes: Vec<Node>,
    /// Vertices [cells].
    pub(super) vertices: Vec<DVec3>,
    /// Set when the block is one flat leaf.
    pub(super) flat: Option<Flat>,
    /// Number of the first vertex in the mesh.
    pub(super) base: u32,
    /// The larger leaf it belongs to.
    pub(super) merged: Option<u32>,
}

impl Tree {
    /// Memory of the tree and its place [bytes].
    pub(super) fn bytes(&self) -> u64 {
        let own = size_of::<Tree>() + size_of::<[u32; 3]>();
        (own + size_of_val(&self.nodes[..]) + size_of_val(&self.vertices[..])) as u64
    }
}
