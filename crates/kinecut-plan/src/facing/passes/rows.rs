//! Parallel rows.

use glam::DVec2;

use super::PassPath;
use super::row_cost::RowCost;
use crate::facing::FaceCase;
use crate::geom::OutlineEdge;

/// Parallel straight rows over a face, in the order they are milled.
#[derive(Clone, Debug, PartialEq)]
pub struct MilledRows {
    /// The part is turned by this, counter-clockwise about its origin; rows then lie along x [rad].
    pub angle: f64,
    /// The rows, by rising ordinate in the turned frame.
    pub rows: Vec<MilledRow>,
}

/// One row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MilledRow {
    /// Ordinate of the cutter's centre in the turned frame [mm].
    pub offset: f64,
    /// It is fed towards +x of the turned frame.
    pub forward: bool,
}

/// Ways in which rows may be fed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowWays {
    /// Each row whichever way is better.
    Free,
    /// All the same way.
    OneWay,
    /// In turn there and back.
    Zigzag,
}

impl MilledRows {
    /// Rows evenly spread over the height of the part: what is done without a thought of burrs. No rows for 0.
    pub fn even(case: &FaceCase, angle: f64, count: usize, ways: RowWays) -> MilledRows {
        let [low, high] = case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        let row = |k: usize| MilledRow {
            offset: low + (high - low) * (k as f64 + 0.5) / count as f64,
            forward: ways != RowWays::Zigzag || k.is_multiple_of(2),
        };
        MilledRows { angle, rows: (0..count).map(row).collect() }
    }

    /// The least number of rows that cover the part with `margin` [mm] to spare; none where the margin leaves nothing
    /// of the cutter.
    pub fn least(case: &FaceCase, angle: f64, margin: f64) -> Option<usize> {
        let [low, high] = case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        let width = 2.0 * (case.radius - margin);
        // A part as wide as the rows to within rounding takes no row more.
        (width > 0.0).then(|| (((high - low) / width * (1.0 - 1e-12)).ceil() as usize).max(1))
    }

    /// The path: each row begins and ends `run` [mm] beyond the part that it reaches, so that with `run` not less than
    /// the radius the cutter is lowered and lifted off the part. Rows that reach nothing are left out.
    pub fn path(&self, case: &FaceCase, run: f64) -> PassPath {
        let cost = RowCost::new(case, self.angle);
        let back = DVec2::from_angle(-self.angle);
        let row = |row: &MilledRow| {
            let [least, most] = cost.extent(row.offset)?;
            let ends = [least - run, most + run].map(|x| back.rotate(DVec2::new(x, row.offset)));
            let line = OutlineEdge::line(ends[0], ends[1]);
            Some(vec![if row.forward { line } else { line.reversed() }])
        };
        PassPath::new(self.rows.iter().filter_map(row).collect())
    }

    /// The bad length of these rows over a case by the closed form of each strip [mm]: what
    /// [`path_burr`](super::path_burr) finds for their path.
    pub fn bad_length(&self, case: &FaceCase) -> f64 {
        let cost = RowCost::new(case, self.angle);
        let mut top = f64::NEG_INFINITY;
        let mut sum = 0.0;
        for row in &self.rows {
            sum += cost.of(top, row.offset, row.forward);
            top = top.max(row.offset + case.radius);
        }
        sum
    }
}
