//! The pieces of surface in a single cell, from the signs of its corners.
//!
//! On each face with two crossed edges an arc joins them. On an *ambiguous* face (material on one diagonal) two arcs
//! cut off one corner each: the material ones, so that material does not join through the face. The arcs of all six
//! faces close to loops; each loop is a piece of the surface with a vertex of its own.
//!
//! **The bad case.** Two cells share an ambiguous face, and in both of them its two arcs belong to one loop: then
//! two vertices are joined by two edges and the mesh is not a manifold. The arcs of that face then cut off the void
//! corners instead, which splits the loop in both cells. Of the 256 sign patterns none has more than one face with
//! both arcs in one loop (tested), so each cell is concerned by at most one change of this kind.
//!
//! Numbering: corner x + 2 y + 4 z; edge 4 axis + u + 2 v with u, v its place along `axis.others()`; face
//! 2 axis + side.

use std::sync::LazyLock;

use super::signs::Signs;
use crate::stock::Axis;

/// No loop: the edge is not crossed.
const NONE: u8 = u8::MAX;

/// The loops of a sign pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Loops {
    /// Number of loops.
    pub(super) count: u8,
    /// For each edge its loop.
    pub(super) of_edge: [u8; 12],
}

struct Table {
    /// Loops by sign pattern and changed face; index 6: no face changed.
    loops: Vec<[Loops; 7]>,
    /// The face whose arcs belong to one loop.
    bad: [Option<u8>; 256],
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let loops = (0..=255).map(|p| std::array::from_fn(|f| trace(p, f))).collect();
    Table { loops, bad: std::array::from_fn(|p| bad_faces(p as u8).next()) }
});

/// The loops of a cell.
pub(super) fn loops(signs: &Signs, cell: [u32; 3]) -> &'static Loops {
    let pattern = signs.corners(cell);
    let table = &*TABLE;
    let changed = match table.bad[pattern as usize] {
        None => 6,
        Some(face) => {
            let mut other = cell;
            let axis = usize::from(face / 2);
            // An ambiguous face has material corners, so it is not in the padding: there is a cell beyond it.
            other[axis] = if face % 2 == 1 { cell[axis] + 1 } else { cell[axis] - 1 };
            match table.bad[signs.corners(other) as usize] {
                Some(back) if back == face ^ 1 => usize::from(face),
                _ => 6,
            }
        }
    };
    &table.loops[pattern as usize][changed]
}

/// Number of an edge from its axis and its place along `axis.others()`.
pub(super) fn edge(axis: Axis, u: u32, v: u32) -> usize {
    axis.index() * 4 + (u + 2 * v) as usize
}

/// Axis and lower corner of an edge.
pub(super) fn edge_start(edge: usize) -> (Axis, [u32; 3]) {
    let axis = Axis::ALL[edge / 4];
    let (u, v) = axis.others();
    let mut p = [0; 3];
    p[u.index()] = edge as u32 & 1;
    p[v.index()] = edge as u32 >> 1 & 1;
    (axis, p)
}

fn corner(axis: Axis, side: u32, u: u32, v: u32) -> u32 {
    let (a, b) = axis.others();
    side << axis.index() | u << a.index() | v << b.index()
}

/// The arcs of a face as pairs of edges.
fn arcs(pattern: u8, face: u8, changed: bool) -> Vec<[usize; 2]> {
    let axis = Axis::ALL[usize::from(face / 2)];
    let (a, b) = axis.others();
    let side = u32::from(face % 2);
    // The edge of the face along `of` at place `at` of the other in-plane axis.
    let side_edge = |of: Axis, at: u32| {
        let (u, v) = of.others();
        let place = |w: Axis| if w == axis { side } else { at };
        edge(of, place(u), place(v))
    };
    let solid = |u: u32, v: u32| pattern >> corner(axis, side, u, v) & 1 == 1;
    let edges = [
        (side_edge(a, 0), solid(0, 0) != solid(1, 0)),
        (side_edge(a, 1), solid(0, 1) != solid(1, 1)),
        (side_edge(b, 0), solid(0, 0) != solid(0, 1)),
        (side_edge(b, 1), solid(1, 0) != solid(1, 1)),
    ];
    let crossed: Vec<usize> = edges.into_iter().filter(|e| e.1).map(|e| e.0).collect();
    match crossed[..] {
        [e, f] => vec![[e, f]],
        [_, _, _, _] => {
            let cut_off = |u: u32, v: u32| [side_edge(a, v), side_edge(b, u)];
            if solid(0, 0) != changed {
                vec![cut_off(0, 0), cut_off(1, 1)]
            } else {
                vec![cut_off(1, 0), cut_off(0, 1)]
            }
        }
        _ => Vec::new(),
    }
}

/// The loops of a pattern with the arcs of one face changed (6: none).
fn trace(pattern: u8, changed: usize) -> Loops {
    let mut of_edge = [NONE; 12];
    let arcs: Vec<[usize; 2]> = (0..6).flat_map(|f| arcs(pattern, f, usize::from(f) == changed)).collect();
    let mut count = 0;
    for start in 0..12 {
        if of_edge[start] != NONE || !arcs.iter().any(|a| a.contains(&start)) {
            continue;
        }
        // Labels spread along arcs until nothing changes; loops are short.
        of_edge[start] = count;
        for _ in 0..12 {
            for &[a, b] in &arcs {
                if of_edge[a] == count || of_edge[b] == count {
                    of_edge[a] = count;
                    of_edge[b] = count;
                }
            }
        }
        count += 1;
    }
    Loops { count, of_edge }
}

/// The faces whose two arcs belong to one loop.
fn bad_faces(pattern: u8) -> impl Iterator<Item = u8> {
    let loops = trace(pattern, 6);
    (0..6).filter(move |&f| match arcs(pattern, f, false)[..] {
        [[a, _], [b, _]] => loops.of_edge[a] == loops.of_edge[b],
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_pattern_has_two_bad_faces_and_a_change_splits_the_loop() {
        let mut bad = 0;
        for pattern in 0..=255 {
            let faces: Vec<u8> = bad_faces(pattern).collect();
            assert!(faces.len() <= 1, "{pattern:08b} {faces:?}");
            if let [face] = faces[..] {
                bad += 1;
                let (before, after) = (trace(pattern, 6), trace(pattern, face.into()));
                assert_eq!(after.count, before.count + 1);
                let [[a, _], [b, _]] = arcs(pattern, face, true)[..] else { panic!() };
                assert_ne!(after.of_edge[a], after.of_edge[b]);
            }
        }
        assert_eq!(bad, 36);
    }

    #[test]
    fn loops_of_known_patterns() {
        let count = |corners: &[u8]| trace(corners.iter().map(|c| 1 << c).sum(), 6).count;
        assert_eq!(count(&[]), 0);
        assert_eq!(count(&[0]), 1);
        assert_eq!(count(&[0, 1]), 1);
        assert_eq!(count(&[0, 3]), 2); // one diagonal of a face: material does not join
        assert_eq!(count(&[0, 7]), 2); // the diagonal of the cell
        assert_eq!(count(&[0, 3, 5, 6]), 4);
        assert_eq!(count(&[1, 2, 4, 7]), 4);
        assert_eq!(count(&[0, 1, 2, 3]), 1);
        // Every corner that is crossed lies on edges with a loop.
        for p in 0..=255u8 {
            let loops = trace(p, 6);
            for e in 0..12 {
                let (axis, s) = edge_start(e);
                let at = s[0] + 2 * s[1] + 4 * s[2];
                let crossed = (p >> at & 1) != (p >> (at + (1 << axis.index())) & 1);
                assert_eq!(loops.of_edge[e] != NONE, crossed);
            }
        }
    }
}
