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

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines that begin upright and then bend in and out: the triangles have one sense, and the area of the polygon.
    #[test]
    fn triangles_fill_the_polygon_with_one_sense() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for _ in 0..200 {
            let mut places = vec![DVec2::new(0.0, 0.5)];
            let mut line = |sign: f64, count: usize, places: &mut Vec<DVec2>| -> Vec<Corner> {
                let first = places.len();
                // The line begins with an upright side.
                let side = (1..=3).map(|k| DVec2::new(0.0, 0.5 + sign * 0.02 * f64::from(k)));
                places.extend(side);
                let along = |k: usize| k as f64 / (count + 1) as f64;
                places.extend((1..=count).map(|k| DVec2::new(along(k), 0.5 + sign * (0.1 + random()))));
                (first..places.len()).map(|i| Corner { at: places[i], vertex: i as u32 }).collect()
            };
            let (below, above) = (line(-1.0, 9, &mut places), line(1.0, 5, &mut places));
            let ends = [DVec2::new(0.0, 0.5), DVec2::new(1.0, 0.5)];
            places.push(ends[1]);
            let last = places.len() as u32 - 1;
            let [start, end] = [Corner { at: ends[0], vertex: 0 }, Corner { at: ends[1], vertex: last }];
            let lower: Vec<Corner> = [vec![start], below, vec![end]].concat();
            let upper: Vec<Corner> = [vec![start], above, vec![end]].concat();
            let mut builder = Builder::default();
            builder.polygon(&lower, &upper);
            let mut sum = 0.0;
            for t in &builder.mesh.triangles {
                let [a, b, c] = t.map(|i| places[i as usize]);
                let area = 0.5 * (b - a).perp_dot(c - a);
                assert!(area > -1e-15, "{area}");
                sum += area;
            }
            let under = |line: &[Corner]| -> f64 {
                line.windows(2).map(|p| 0.5 * (p[0].at.y + p[1].at.y) * (p[1].at.x - p[0].at.x)).sum()
            };
            assert_eq!(builder.mesh.triangles.len(), lower.len() + upper.len() - 4);
            assert!((sum - (under(&upper) - under(&lower))).abs() < 1e-12);
        }
    }
}
