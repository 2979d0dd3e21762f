//! An index of edges: those that lie near a point or near another edge, without a look at all of them.

use glam::DVec2;

use super::OutlineEdge;

/// Edges by square bins of the plane.
#[derive(Clone, Debug)]
pub(in crate::geom) struct EdgeBins {
    low: DVec2,
    /// Width of a bin [mm].
    width: f64,
    columns: usize,
    rows: usize,
    /// For each bin the place in `list` where its edges begin, and last the end of the list.
    begins: Vec<u32>,
    list: Vec<u32>,
    size: f64,
}

/// Bins that an edge is kept in, on average, before wider bins are taken.
const KEPT: usize = 16;
/// Share of the size of all edges by which a bin may be nearer than its corners say.
const ROUNDING: f64 = 1e-9;

impl EdgeBins {
    /// Of edges that are finite.
    pub(in crate::geom) fn new(edges: &[OutlineEdge]) -> EdgeBins {
        let boxes: Vec<[DVec2; 2]> = edges.iter().map(around).collect();
        let all = boxes
            .iter()
            .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |all, b| [all[0].min(b[0]), all[1].max(b[1])]);
        let extent = if edges.is_empty() { DVec2::ZERO } else { all[1] - all[0] };
        let low = if edges.is_empty() { DVec2::ZERO } else { all[0] };
        let size = extent.length();
        let mut across = (edges.len() as f64).sqrt().ceil().max(1.0);
        loop {
            let width = (extent.max_element() / across).max(1e-9 * (1.0 + size));
            let count = |length: f64| (length / width) as usize + 1;
            let (columns, rows) = (count(extent.x), count(extent.y));
            let mut bins = EdgeBins {
                low,
                width,
                columns,
                rows,
                begins: vec![0; columns * rows + 1],
                list: Vec::new(),
                size,
            };
            let kept: usize = boxes
                .iter()
                .map(|b| bins.span(b[0].x, b[1].x, 0).len() * bins.span(b[0].y, b[1].y, 1).len())
                .sum();
            if across > 1.0 && kept > KEPT * edges.len() {
                across = (0.5 * across).ceil().min(across - 1.0);
                continue;
            }
            bins.fill(&boxes);
            return bins;
        }
    }

    /// Length of the diagonal of the box around all edges [mm].
    pub(super) fn size(&self) -> f64 {
        self.size
    }

    fn fill(&mut self, boxes: &[[DVec2; 2]]) {
        let mut held: Vec<(u32, u32)> = Vec::new();
        for (edge, b) in boxes.iter().enumerate() {
            for row in self.span(b[0].y, b[1].y, 1) {
                for column in self.span(b[0].x, b[1].x, 0) {
                    held.push(((row * self.columns + column) as u32, edge as u32));
                }
            }
        }
        held.sort_unstable();
        for (bin, _) in &held {
            self.begins[*bin as usize + 1] += 1;
        }
        for bin in 1..self.begins.len() {
            self.begins[bin] += self.begins[bin - 1];
        }
        self.list = held.into_iter().map(|(_, edge)| edge).collect();
    }

    /// The columns (axis 0) or rows between two coordinates; those beyond the bins are the outermost.
    fn span(&self, from: f64, to: f64, axis: usize) -> std::ops::Range<usize> {
        let count = if axis == 0 { self.columns } else { self.rows };
        // The cast keeps what lies below the first bin in it.
        let at = |x: f64| (((x - self.low[axis]) / self.width) as usize).min(count - 1);
        at(from)..at(to) + 1
    }

    fn edges(&self, column: usize, row: usize) -> &[u32] {
        let bin = row * self.columns + column;
        &self.list[self.begins[bin] as usize..self.begins[bin + 1] as usize]
    }

    /// Calls `look` for edges ever farther from a point, for some more than once; it answers how far away an edge may still
    /// be to count [mm].
    pub(super) fn outwards(&self, p: DVec2, within: f64, look: &mut impl FnMut(usize) -> f64) {
        let mut limit = within;
        let column = self.span(p.x, p.x, 0).start as isize;
        let row = self.span(p.y, p.y, 1).start as isize;
        let most = self.columns.max(self.rows) as isize;
        let rounding = ROUNDING * (1.0 + self.size);
        // How far a coordinate lies from the bins of a column or row; those beyond the outermost are in it.
        let beside = |x: f64, low: f64| (low - x).max(x - low - self.width).max(0.0);
        for ring in 0..=most {
            // Bins of a ring are at least so far away; from a point beside all bins they are farther.
            if (ring - 1) as f64 * self.width > limit {
                break;
            }
            for y in row - ring..=row + ring {
                if y < 0 || y >= self.rows as isize {
                    continue;
                }
                let across = beside(p.y, self.low.y + y as f64 * self.width);
                if across > limit + rounding {
                    continue;
                }
                let edge_row = (y - row).abs() == ring;
                let step = if edge_row || ring == 0 { 1 } else { 2 * ring as usize };
                for x in (column - ring..=column + ring).step_by(step) {
                    if x < 0 || x >= self.columns as isize {
                        continue;
                    }
                    let along = beside(p.x, self.low.x + x as f64 * self.width);
                    if along * along + across * across > (limit + rounding) * (limit + rounding) {
                        continue;
                    }
                    for &edge in self.edges(x as usize, y as usize) {
                        limit = look(edge as usize);
                    }
                }
            }
        }
    }

    /// Calls `found` once for each edge whose bins another edge reaches into.
    pub(in crate::geom) fn around(&self, edge: &OutlineEdge, margin: f64, found: &mut impl FnMut(usize)) {
        let [min, max] = around(edge);
        let mut all: Vec<u32> = Vec::new();
        for row in self.span(min.y - margin, max.y + margin, 1) {
            for column in self.span(min.x - margin, max.x + margin, 0) {
                all.extend(self.edges(column, row));
            }
        }
        all.sort_unstable();
        all.dedup();
        all.into_iter().for_each(|edge| found(edge as usize));
    }
}

/// The box around an edge.
fn around(edge: &OutlineEdge) -> [DVec2; 2] {
    let ([x0, x1], [y0, y1]) = (edge.extent(DVec2::X), edge.extent(DVec2::Y));
    [DVec2::new(x0, y0), DVec2::new(x1, y1)]
}
