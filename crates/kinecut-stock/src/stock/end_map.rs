//! A value at each end point of a stock's lines: what was found out at the places where the stock is exact.
//!
//! Pictures of the part take their colours from it too, so that no vertex shows what no end point has.

use glam::DVec3;
use rayon::prelude::*;

use super::{Axis, DexelGrid, EndPoint, unfixed};
use crate::base::{Code, Finding, Result};

/// A value for both ends of each interval of all lines of a stock.
#[derive(Clone, Debug)]
pub struct EndMap<T> {
    axes: [AxisEnds<T>; 3],
}

/// The lines along one axis.
#[derive(Clone, Debug)]
struct AxisEnds<T> {
    /// Number of lines along the first of the two other axes.
    across: usize,
    /// For each line the number of its first end; one more at the end.
    starts: Vec<u32>,
    values: Vec<T>,
}

impl<T: Copy + Send + Sync> EndMap<T> {
    /// The same value at all ends of a stock.
    ///
    /// # Errors
    /// `KC0105` for more than four thousand million ends.
    pub fn new<G: DexelGrid + ?Sized>(grid: &G, value: T) -> Result<EndMap<T>> {
        let of = |axis| AxisEnds::new(grid, axis, value);
        Ok(EndMap { axes: [of(Axis::X)?, of(Axis::Y)?, of(Axis::Z)?] })
    }

    /// The values of a line, lower and upper end of each of its intervals in turn.
    pub fn line(&self, axis: Axis, a: u32, b: u32) -> &[T] {
        let ends = &self.axes[axis.index()];
        &ends.values[ends.range(a, b)]
    }

    /// The values of a line, to be changed.
    pub fn line_mut(&mut self, axis: Axis, a: u32, b: u32) -> &mut [T] {
        let ends = &mut self.axes[axis.index()];
        let range = ends.range(a, b);
        &mut ends.values[range]
    }

    /// All values, by axis and line.
    pub fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.axes.iter().flat_map(|a| a.values.iter().copied())
    }

    /// Replaces each value by what `new` makes of the place of the end, the end and its value. `grid` is the stock that the
    /// map was made for.
    pub fn replace<G: DexelGrid + ?Sized>(&mut self, grid: &G, new: impl Fn(DVec3, EndPoint, T) -> T + Sync) {
        for (axis, ends) in Axis::ALL.into_iter().zip(&mut self.axes) {
            let (across, starts) = (ends.across, &ends.starts);
            // Rows of lines are cut apart, so that each is worked on by one thread.
            let mut rows: Vec<(u32, &mut [T])> = Vec::new();
            let mut rest = &mut ends.values[..];
            for (b, row) in starts.windows(across + 1).step_by(across.max(1)).enumerate() {
                let (now, later) = rest.split_at_mut((row[across] - row[0]) as usize);
                rows.push((b as u32, now));
                rest = later;
            }
            rows.into_par_iter().for_each(|(b, values)| {
                let mut values = values.iter_mut();
                for a in 0..across as u32 {
                    visit(grid, axis, a, b, |p, end| {
                        if let Some(value) = values.next() {
                            *value = new(p, end, *value);
                        }
                    });
                }
            });
        }
    }

    /// Replaces each value by what `new` makes of the value of another map of the same stock.
    pub fn replace_from<U: Copy>(&mut self, other: &EndMap<U>, new: impl Fn(U) -> T) {
        self.merge_from(other, |_, value| new(value));
    }

    /// Replaces each value by what `new` makes of it and of the value of another map of the same stock.
    pub fn merge_from<U: Copy>(&mut self, other: &EndMap<U>, new: impl Fn(T, U) -> T) {
        for (ends, other) in self.axes.iter_mut().zip(&other.axes) {
            for (value, other) in ends.values.iter_mut().zip(&other.values) {
                *value = new(*value, *other);
            }
        }
    }

    /// Gives every end with its place and value, by axis and line.
    pub fn visit<G: DexelGrid + ?Sized>(&self, grid: &G, mut each: impl FnMut(DVec3, EndPoint, T)) {
        for (axis, ends) in Axis::ALL.into_iter().zip(&self.axes) {
            let mut values = ends.values.iter();
            let rows = grid.lattice().counts[axis.others().1.index()];
            for (b, a) in (0..rows).flat_map(|b| (0..ends.across as u32).map(move |a| (b, a))) {
                visit(grid, axis, a, b, |p, end| {
                    if let Some(value) = values.next() {
                        each(p, end, *value);
                    }
                });
            }
        }
    }

    /// The values at the ends in the lattice cell of a point: those on the lines along its twelve edges. Points outside of the
    /// lattice belong to the outermost cells.
    pub fn in_cell<G: DexelGrid + ?Sized>(&self, grid: &G, p: DVec3, mut each: impl FnMut(T)) {
        let lattice = grid.lattice();
        let cell = Axis::ALL.map(|axis| {
            let i = axis.index();
            ((p[i] - lattice.origin[i]) / lattice.step).floor()
        });
        for axis in Axis::ALL {
            let (u, v) = axis.others();
            let i = axis.index();
            let last = f64::from(lattice.counts[i]) - 1.0;
            let at = |index: f64| lattice.origin[i] + index * lattice.step;
            let from = if cell[i] < 0.0 { f64::NEG_INFINITY } else { at(cell[i]) };
            let to = if cell[i] >= last { f64::INFINITY } else { at(cell[i] + 1.0) };
            let sides = |axis: Axis| {
                let (c, n) = (cell[axis.index()], f64::from(lattice.counts[axis.index()]));
                [c, c + 1.0].into_iter().filter(move |c| *c >= 0.0 && *c < n).map(|c| c as u32)
            };
            for b in sides(v) {
                for a in sides(u) {
                    let (values, line) = (self.line(axis, a, b), grid.line(axis, a, b));
                    // A line may have many ends: those below the cell are passed over at once.
                    let first = line.partition_point(|i| unfixed(i.hi.at) < from);
                    let ends = line[first..].iter().flat_map(|i| [i.lo, i.hi]);
                    for (end, value) in ends.zip(&values[2 * first..]) {
                        let at = unfixed(end.at);
                        if at > to {
                            break;
                        }
                        if from <= at {
                            each(*value);
                        }
                    }
                }
            }
        }
    }
}

impl<T: Copy> AxisEnds<T> {
    fn new<G: DexelGrid + ?Sized>(grid: &G, axis: Axis, value: T) -> Result<AxisEnds<T>> {
        let (u, v) = axis.others();
        let counts = grid.lattice().counts;
        let (across, rows) = (counts[u.index()] as usize, counts[v.index()]);
        let mut starts = Vec::with_capacity(across * rows as usize + 1);
        let mut ends = 0usize;
        for b in 0..rows {
            for a in 0..across as u32 {
                starts.push(ends as u32);
                ends += 2 * grid.line(axis, a, b).len();
            }
            if u32::try_from(ends).is_err() {
                return Err(Finding::error(
                    Code::JOB_BUDGET,
                    "the stock has too many ends of lines to compare",
                )
                .value(ends as f64, "")
                .bound(f64::from(u32::MAX), "")
                .help("take a larger simulate.step")
                .into());
            }
        }
        starts.push(ends as u32);
        Ok(AxisEnds { across, starts, values: vec![value; ends] })
    }

    fn range(&self, a: u32, b: u32) -> std::ops::Range<usize> {
        let line = b as usize * self.across + a as usize;
        self.starts[line] as usize..self.starts[line + 1] as usize
    }
}

/// The ends of a line with their places, lower before upper.
fn visit<G: DexelGrid + ?Sized>(grid: &G, axis: Axis, a: u32, b: u32, mut each: impl FnMut(DVec3, EndPoint)) {
    let (u, v) = axis.others();
    let lattice = grid.lattice();
    let mut p = DVec3::ZERO;
    p[u.index()] = lattice.coordinate(u, a);
    p[v.index()] = lattice.coordinate(v, b);
    for end in grid.line(axis, a, b).iter().flat_map(|i| [i.lo, i.hi]) {
        p[axis.index()] = unfixed(end.at);
        each(p, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Aabb;
    use crate::stock::TriDexel;

    #[test]
    fn each_end_has_its_place_and_a_cell_knows_the_ends_on_its_edges() {
        let bounds = Aabb { min: DVec3::ZERO, max: DVec3::new(3.0, 2.0, 1.0) };
        let stock = TriDexel::from_box(bounds, 1.0).unwrap();
        let mut map = EndMap::new(&stock, 0.0f32).unwrap();
        // Two ends on each of 2 lines along X, 3 along Y and 6 along Z.
        assert_eq!(map.values().count(), 22);
        map.replace(&stock, |p, _, _| p.z as f32);
        assert_eq!(map.line(Axis::Z, 2, 1), [0.0, 1.0]);
        assert_eq!(map.line(Axis::X, 1, 0), [0.5, 0.5]);
        let mut seen = Vec::new();
        map.in_cell(&stock, DVec3::new(2.9, 1.9, 1.0), |z| seen.push(z));
        // At the corner: the ends of the lines along X and Y at its height, and the upper end of that along Z.
        assert_eq!(seen, [0.5, 0.5, 1.0]);
    }
}
