//! Cells of the plane by whether a border is far from all of a cell: most places are answered without a look at edges.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec2;

/// Width of a cell, in the distance that is far.
const WIDTH: f64 = 0.5;

/// The side on which a cell lies, and whether all of it is far from the border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    FarInside,
    /// Its middle is inside, or on the border.
    Inside,
    Outside,
    FarOutside,
}

/// Cells around a region.
#[derive(Clone, Debug)]
pub(super) struct Far {
    /// Distance from the border that is far [mm].
    reach: f64,
    low: DVec2,
    /// Width of a cell [mm].
    width: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Side>,
}

impl Far {
    /// Of a region in a box; `reach`: distance that is far [mm]; `room`: distance of a point from the border, negative outside, where
    /// that is below a distance [mm], which it then is.
    pub(super) fn new([low, high]: [DVec2; 2], reach: f64, room: impl Fn(DVec2, f64) -> f64) -> Far {
        let width = WIDTH * reach;
        let low = low - reach - width;
        let count = |length: f64| (length / width).ceil() as usize + 1;
        let size = high + reach - low;
        let (columns, rows) = (count(size.x), count(size.y));
        let cells = vec![Side::FarOutside; columns * rows];
        let mut far = Far { reach, low, width, columns, rows, cells };
        // Squares of cells with the lower left one of them, a width in cells, and the farthest that the border may be.
        let mut squares = vec![([0, 0], columns.max(rows).next_power_of_two(), f64::INFINITY)];
        while let Some(([column, row], count, most)) = squares.pop() {
            let middle = low + width * (DVec2::new(column as f64, row as f64) + 0.5 * count as f64);
            let room = room(middle, most);
            let around = count as f64 * width * FRAC_1_SQRT_2;
            let is_far = room.abs() > around + reach;
            if is_far || count == 1 {
                let side = match (is_far, room >= 0.0) {
                    (true, true) => Side::FarInside,
                    (false, true) => Side::Inside,
                    (false, false) => Side::Outside,
                    (true, false) => Side::FarOutside,
                };
                far.fill([column, row], count, side);
                continue;
            }
            let half = count / 2;
            // The middles of the quarters lie half of the diagonal's half away.
            let most = (room.abs() + 0.5 * around) * (1.0 + 1e-9);
            for [x, y] in [[0, 0], [half, 0], [0, half], [half, half]] {
                if column + x < columns && row + y < rows {
                    squares.push(([column + x, row + y], half, most));
                }
            }
        }
        far
    }

    fn fill(&mut self, [column, row]: [usize; 2], count: usize, side: Side) {
        let end = (column + count).min(self.columns);
        for row in row..(row + count).min(self.rows) {
            self.cells[row * self.columns + column..row * self.columns + end].fill(side);
        }
    }

    /// Distance from the border that is far [mm].
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Distance of all points of a cell from its middle [mm].
    pub(super) fn around(&self) -> f64 {
        self.width * FRAC_1_SQRT_2
    }

    /// The side of the cell at a point.
    pub(super) fn side(&self, p: DVec2) -> Side {
        let at = (p - self.low) / self.width;
        // What lies beyond the cells, or is no number, is far outside.
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.columns as f64 && at.y < self.rows as f64;
        if inside { self.cells[at.y as usize * self.columns + at.x as usize] } else { Side::FarOutside }
    }
}
