//! From the model of a sketch to paper: isometric, X to the lower right, Y to the upper right, Z up.

use super::{SketchTool, SplitSketch};

/// Directions of the model as seen on paper, y downwards.
const SEEN: [[f64; 2]; 3] = [[0.866_025_403_784_438_6, 0.5], [0.866_025_403_784_438_6, -0.5], [0.0, -1.0]];

/// Room round a surface, as a share of its radius.
const ROOM: f64 = 0.2;

/// How a sketch is placed.
pub(crate) struct View {
    scale: f64,
    zero: [f64; 2],
    /// Middle of the surface [mm].
    pub(crate) middle: [f64; 3],
    /// Radius of the surface about its middle [mm].
    pub(crate) radius: f64,
    /// What is drawn, at scale one: left, right, top, bottom.
    extent: [f64; 4],
}

impl View {
    /// A view of a surface in a box [px]; none without a finite point.
    pub(crate) fn new(sketch: &SplitSketch, at: [f64; 2], size: [f64; 2]) -> Option<View> {
        let tool: Vec<[f64; 3]> = match &sketch.tool {
            SketchTool::None => Vec::new(),
            SketchTool::Point(p) => vec![*p],
            SketchTool::Edge(points) => points.clone(),
            SketchTool::Patch(rows) => rows.concat(),
        };
        let finite = |p: &&[f64; 3]| p.iter().all(|v| v.is_finite());
        let points: Vec<&[f64; 3]> = sketch.surface.iter().flatten().chain(&tool).filter(finite).collect();
        let (mut low, mut high) = (**points.first()?, **points.first()?);
        for p in &points {
            for k in 0..3 {
                (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
            }
        }
        let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let far = |p: &[f64; 3]| (0..3).map(|k| (p[k] - middle[k]).powi(2)).sum::<f64>().sqrt();
        let radius = points.iter().map(|p| far(p)).fold(0.0, f64::max).max(1e-9);
        let mut extent = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for p in &points {
            let q = seen(**p);
            extent = [extent[0].min(q[0]), extent[1].max(q[0]), extent[2].min(q[1]), extent[3].max(q[1])];
        }
        let room = ROOM * radius;
        let extent = [extent[0] - room, extent[1] + room, extent[2] - room, extent[3] + room];
        let mut view = View { scale: 1.0, zero: [0.0; 2], middle, radius, extent };
        view.fit(at, size);
        Some(view)
    }

    /// The view with room for points of paper too.
    pub(crate) fn with_room_for(
        mut self,
        points: impl Iterator<Item = [f64; 2]>,
        at: [f64; 2],
        size: [f64; 2],
    ) -> View {
        let room = 0.5 * ROOM * self.radius;
        for p in points {
            let q = [0, 1].map(|k| (p[k] - self.zero[k]) / self.scale);
            for k in 0..2 {
                self.extent[2 * k] = self.extent[2 * k].min(q[k] - room);
                self.extent[2 * k + 1] = self.extent[2 * k + 1].max(q[k] + room);
            }
        }
        self.fit(at, size);
        self
    }

    /// Places the extent in a box.
    fn fit(&mut self, at: [f64; 2], size: [f64; 2]) {
        let e = self.extent;
        self.scale = (size[0] / (e[1] - e[0])).min(size[1] / (e[3] - e[2]));
        self.zero = [0, 1].map(|k| at[k] + 0.5 * size[k] - 0.5 * self.scale * (e[2 * k] + e[2 * k + 1]));
    }

    /// A place on paper [px].
    pub(crate) fn px(&self, p: [f64; 3]) -> [f64; 2] {
        let q = seen(p);
        [0, 1].map(|k| self.zero[k] + self.scale * q[k])
    }

    /// Places on paper.
    pub(crate) fn line(&self, points: &[[f64; 3]]) -> Vec<[f64; 2]> {
        points.iter().filter(|p| p.iter().all(|v| v.is_finite())).map(|p| self.px(*p)).collect()
    }

    /// Quads of a grid from the farthest to the nearest, each with its shade from 0, the lightest, to 2.
    pub(crate) fn quads(&self, rows: &[Vec<[f64; 3]>]) -> Vec<(usize, [[f64; 2]; 4])> {
        let mut quads = Vec::new();
        for pair in rows.windows(2) {
            let columns = pair[0].len().min(pair[1].len());
            for j in 1..columns {
                let corners = [pair[0][j - 1], pair[0][j], pair[1][j], pair[1][j - 1]];
                if corners.iter().flatten().all(|v| v.is_finite()) {
                    let depth = corners.iter().map(|c| c[0] - c[1] + c[2]).sum::<f64>();
                    quads.push((depth, shade(&corners), corners.map(|c| self.px(c))));
                }
            }
        }
        quads.sort_by(|a, b| a.0.total_cmp(&b.0));
        quads.into_iter().map(|q| (q.1, q.2)).collect()
    }
}

fn seen(p: [f64; 3]) -> [f64; 2] {
    [0, 1].map(|c| (0..3).map(|k| p[k] * SEEN[k][c]).sum())
}

/// Light from above, a little from the front; both sides of a surface are lit alike.
fn shade(corners: &[[f64; 3]; 4]) -> usize {
    let side = |a: usize, b: usize| [0, 1, 2].map(|k| corners[b][k] - corners[a][k]);
    let (d, e) = (side(0, 2), side(1, 3));
    let n = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if !(length > 0.0) {
        return 1;
    }
    // The side that is turned to the viewer.
    let sign = if n[0] - n[1] + n[2] < 0.0 { -1.0 } else { 1.0 };
    let light = sign * (0.1 * n[0] - 0.5 * n[1] + 0.86 * n[2]) / length;
    match light {
        l if l > 0.66 => 0,
        l if l > 0.28 => 1,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_quad_is_drawn_last() {
        let rows: Vec<Vec<[f64; 3]>> =
            (0..3).map(|i| (0..3).map(|j| [f64::from(i), f64::from(j), 0.0]).collect()).collect();
        let sketch = SplitSketch { surface: rows.clone(), ..SplitSketch::default() };
        let view = View::new(&sketch, [0.0; 2], [100.0; 2]).unwrap();
        let quads = view.quads(&rows);
        assert_eq!(quads.len(), 4);
        // Front right corner: X large, Y small; it is the lowest on paper.
        let lowest = |q: &(usize, [[f64; 2]; 4])| q.1.iter().map(|p| p[1]).fold(0.0, f64::max);
        assert!(quads[..3].iter().all(|q| lowest(q) < lowest(&quads[3])));
        assert!(View::new(&SplitSketch::default(), [0.0; 2], [100.0; 2]).is_none());
    }
}
