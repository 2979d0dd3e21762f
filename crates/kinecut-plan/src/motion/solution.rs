//! A solution of a law on a grid: its windows, and the same on a grid of which some cells are halved.

use std::ops::Range;

use super::spline::lengths;

/// A solved stretch of cells.
pub(super) struct Window {
    /// The cells that it answers for.
    pub(super) own: Range<usize>,
    /// Those that it was solved over.
    pub(super) cells: Range<usize>,
    /// One a cell.
    pub(super) coefficients: Vec<f64>,
    /// Gap between time and its bound, over the time; infinite where its cells or their shares are others now.
    pub(super) gap: f64,
}

/// Precision of a solution.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Precision {
    /// It shows where the grid is too coarse.
    Rough,
    /// It is final.
    Settled,
}

/// The fastest run over all cells.
pub(super) struct Solution {
    pub(super) windows: Vec<Window>,
    /// Share of acceleration and jerk that each cell may use.
    pub(super) share: Vec<[f64; 2]>,
    /// Coefficients of all cells, those at the ends included.
    pub(super) coefficients: Vec<f64>,
    /// Steps of the solver.
    pub(super) steps: u32,
}

impl Solution {
    /// The same on a grid of which some cells are halved; `knots` are those before.
    pub(super) fn on_halved(self, knots: &[f64], halved: &[bool]) -> Solution {
        let mut places = Vec::with_capacity(halved.len() + 1);
        let mut place = 0;
        for is_halved in halved {
            places.push(place);
            place += 1 + usize::from(*is_halved);
        }
        places.push(place);
        let on = |range: Range<usize>| places[range.start]..places[range.end];
        let window = |window: Window| {
            let cells = window.cells.clone();
            // Beside its cells it is at rest.
            let beside = cells.start.saturating_sub(1)..(cells.end + 1).min(halved.len());
            let changed = halved[beside].contains(&true);
            let part = &knots[cells.start..=cells.end];
            let coefficients = inserted(part, &halved[cells.clone()], &window.coefficients);
            let gap = if changed { f64::INFINITY } else { window.gap };
            Window { own: on(window.own), cells: on(cells), coefficients, gap }
        };
        let share =
            self.share.iter().zip(halved).flat_map(|(s, h)| std::iter::repeat_n(*s, 1 + usize::from(*h)));
        Solution { share: share.collect(), windows: self.windows.into_iter().map(window).collect(), ..self }
    }
}

/// Coefficients of the same speed where these cells are halved, after Boehm; it is even beyond both ends.
fn inserted(knots: &[f64], halved: &[bool], coefficients: &[f64]) -> Vec<f64> {
    let n = halved.len();
    let mut all = Vec::with_capacity(n);
    for (k, own) in coefficients.iter().enumerate() {
        if !halved[k] {
            all.push(*own);
            continue;
        }
        let [before, h, after] = lengths(knots, k);
        let last = coefficients[k.saturating_sub(1)];
        let next = coefficients[(k + 1).min(n - 1)];
        all.push(last + (before + 0.5 * h) / (before + h) * (own - last));
        all.push(own + 0.5 * h / (h + after) * (next - own));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::shape::{Shape, places};
    use super::super::start::Start;
    use super::super::test_courses::{LIMIT, Wave};
    use super::super::windows::solution;
    use super::super::{End, Speed, grid};
    use super::*;
    use crate::base::Silent;

    #[test]
    fn on_halved_cells_a_solution_is_the_same_speed() {
        let limits = [LIMIT; 2];
        let mut knots = grid::knots(&Wave, &limits, Start::of(&Wave, &limits), [End::Rest; 2]).unwrap();
        knots.truncate(400);
        let places = places(&Wave, &limits, &knots).unwrap();
        let length = knots[399] + 0.1;
        let shape = Shape::new(&knots, length, &places, &limits);
        let n = shape.len();
        let solution = solution(&Wave, &limits, &shape, Precision::Settled, None, &Silent).unwrap();
        let speed = Speed::new(shape.stops, &knots, &solution.coefficients);
        let halved: Vec<bool> = (0..n).map(|k| (2..n - 2).contains(&k) && k % 3 == 0 || k == 100).collect();
        let finer = solution.on_halved(&knots, &halved);
        let mut all = Vec::new();
        for (pair, is_halved) in knots.windows(2).zip(&halved) {
            all.push(pair[0]);
            all.extend(is_halved.then_some(0.5 * (pair[0] + pair[1])));
        }
        all.push(knots[n]);
        assert_eq!(finer.share.len(), all.len() - 1);
        let [window] = &finer.windows[..] else { panic!("{} windows", finer.windows.len()) };
        assert_eq!((window.cells.clone(), window.gap), (0..all.len() - 1, f64::INFINITY));
        let folds = shape.folds();
        let own = &window.coefficients;
        let coefficients = [&[folds[0] * own[0]][..], own, &[folds[1] * own[own.len() - 1]]].concat();
        let same = Speed::new(shape.stops, &all, &coefficients);
        for i in 0..=1000 {
            let s = knots[3] + (knots[n - 3] - knots[3]) * f64::from(i) / 1000.0;
            for (a, b) in speed.square(s).iter().zip(same.square(s)).take(2) {
                assert!((a - b).abs() < 1e-9 * (a.abs() + 1.0), "{s}: {a} {b}");
            }
        }
    }
}
