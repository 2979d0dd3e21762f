//! A polygon between two lines that run from the same start to the same end, both to the right: divided into triangles.
//!
//! Source: the sweep over the corners of a monotone polygon (Garey, Johnson, Preparata, Tarjan 1978): corners are taken from
//! left to right; what is not yet divided is a chain on one side, cut off from the end where it is convex, and at once where a
//! corner of the other side comes. All triangles lie inside and have the sense of the polygon.

use glam::DVec2;

use super::strip::Builder;

/// A corner: its place on the plane, and the vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: DVec2,
    pub vertex: u32,
}

impl Builder {
    /// The triangles of the polygon between the lower and the upper line, counter-clockwise.
    pub(super) fn polygon(&mut self, lower: &[Corner], upper: &[Corner]) {
        let ([start, below @ .., end], [_, above @ .., _]) = (lower, upper) else { return };
        let mut open: Vec<(Corner, bool)> = Vec::with_capacity(lower.len() + upper.len());
        let (mut i, mut j) = (0, 0);
        // The corner at the start belongs to both lines.
        open.push((*start, true));
        loop {
            let next = match (below.get(i), above.get(j)) {
                (Some(a), Some(b)) if a.at.x <= b.at.x => Some((*a, true)),
                (Some(a), None) => Some((*a, true)),
                (_, Some(b)) => Some((*b, false)),
                (None, None) => None,
            };
            let Some((corner, is_below)) = next else { break };
            *(if is_below { &mut i } else { &mut j }) += 1;
            let side = if open.len() == 1 { is_below } else { open[open.len() - 1].1 };
            if side == is_below {
                while let [.., a, b] = open[..] {
                    let turn = (b.0.at - a.0.at).perp_dot(corner.at - a.0.at);
                    if !(if is_below { turn > 0.0 } else { turn < 0.0 }) {
                        break;
                    }
                    self.triangle([a.0.vertex, b.0.vertex, corner.vertex], !is_below);
                    open.pop();
                }
                open.push((corner, is_below));
            } else {
                self.fan(&open, &corner);
                let last = open[open.len() - 1];
                open.clear();
                open.extend([last, (corner, is_below)]);
            }
        }
        self.fan(&open, end);
    }

    /// Triangles from a chain to a corner of the other side.
    fn fan(&mut self, chain: &[(Corner, bool)], corner: &Corner) {
        for pair in chain.windows(2) {
            self.triangle([pair[0].0.vertex, pair[1].0.vertex, corner.vertex], !pair[1].1);
        }
    }
}
