//! A long path is solved in windows that know nothing of one another, and joined where they agree.
//!
//! Each window runs from rest to rest over its own cells and some beside them. A stop has no influence beyond the way in
//! which the path gets to speed, so neighbours agree where both have forgotten their stops; there one goes over into the
//! other. Where two do not agree they are solved as one, up to a size.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::interior::solve;
use super::shape::Shape;
use super::shares::{CellShares, of_cells};
use super::solution::{Precision, Solution, Window};
use super::start::way_to_speed;
use super::{AxisLimit, Course, Speed};
use crate::base::{Code, Finding, Progress, Result};

/// Cells of a window.
const CELLS: usize = 2000;
/// Cells over which a window goes over into the next one.
const FADE: usize = 16;
/// Times that a window could get to rest from its speed in the cells beside its own.
const FORGOTTEN: f64 = 5.0;
/// Most cells that are solved as one because windows do not agree: beyond it they are joined where they agree best.
const MOST_CELLS: usize = 4 * CELLS;
/// Largest difference of the coefficients of two windows, over their size, at which they agree.
const AGREED: f64 = 1e-5;
/// Rounds in which cells that exceed a limit between their knots get a smaller share of it.
const ROUNDS: u32 = 4;
/// Rounds after which the cells beside such a cell get its share, too.
const ALONE: u32 = 2;
/// Excess that is left as it is: what is left is eased.
const EXCESS: f64 = 1e-3;
/// Gap between time and its bound, over the time, of a solution that is final.
const SETTLED: f64 = 1e-7;
/// The same of one that shows where the grid is too coarse.
const ROUGH: f64 = 1e-3;
/// Excess above which a cell gets a smaller share once one is too large.
const ROUNDING: f64 = 1e-7;

/// The fastest run over all cells, from an earlier solution on these cells where there is one.
///
/// In a final solution a cell that exceeds a limit between its knots gets a smaller share of it, and the windows with such
/// cells are solved again: shares are those of the cells, not of the windows, so that neighbours are asked the same.
///
/// # Errors
/// `KC0009` when it was cancelled.
pub(super) fn solution<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    shape: &Shape<A>,
    precision: Precision,
    before: Option<Solution>,
    progress: &dyn Progress,
) -> Result<Solution> {
    let n = shape.len();
    let start = shape.start();
    let reach = Reach::new(shape, limits, &start);
    let solver = Solver { shape, reach, precision, steps: AtomicU32::new(0), progress };
    let (mut windows, mut share) = match before {
        Some(before) => (before.windows, before.share),
        None => (solver.unsolved(), vec![[1.0; 2]; n]),
    };
    let folds = shape.folds();
    let mut round = 0;
    loop {
        let solved: Result<Vec<Window>> =
            windows.into_par_iter().with_max_len(1).map(|window| solver.settled(window, &share)).collect();
        let joined = solver.joined(solved?, &share)?;
        let all = together(&joined, n);
        let coefficients = [&[folds[0] * all[0]][..], &all, &[folds[1] * all[n - 1]]].concat();
        windows = joined.into_iter().map(|(window, _)| window).collect();
        if precision == Precision::Settled && round + 1 < ROUNDS {
            let speed = Speed::new(shape.stops, shape.knots, &coefficients);
            let lowered = lower(&mut share, &of_cells(course, limits, &speed, 0..n), round);
            if !lowered.is_empty() {
                for window in &mut windows {
                    let next = lowered.get(lowered.partition_point(|k| *k < window.cells.start));
                    if next.is_some_and(|k| window.cells.contains(k)) {
                        window.gap = f64::INFINITY;
                    }
                }
                round += 1;
                continue;
            }
        }
        return Ok(Solution { windows, share, coefficients, steps: solver.steps.into_inner() });
    }
}

/// Lowers the shares of cells that exceed a limit, if one does by too much; the cells whose share is another one, in order.
///
/// The solver keeps to shares at the ends of cells: what these use of their limit goes down as the excess between them asks
/// for, and from a round on in the cells beside them, too.
fn lower(share: &mut [[f64; 2]], found: &[CellShares], round: u32) -> Vec<usize> {
    /// Least part of its share that a cell keeps in one round.
    const KEPT: f64 = 0.3;
    let mut lowered = Vec::new();
    let exceeds = |cell: &CellShares| cell.all.acceleration.max(cell.all.jerk) > 1.0 + EXCESS;
    if !found.iter().any(exceeds) {
        return lowered;
    }
    let beside = usize::from(round >= ALONE);
    for (k, CellShares { ends, all }) in found.iter().enumerate() {
        for (kind, (ends, all)) in
            [(ends.acceleration, all.acceleration), (ends.jerk, all.jerk)].into_iter().enumerate()
        {
            if all > 1.0 + ROUNDING {
                let excess = all * (1.0 + 0.1 * (all - 1.0));
                let own = share[k][kind];
                share[k][kind] = (own.min(ends) / excess).max(KEPT * own);
                let cells = k.saturating_sub(beside)..(k + beside + 1).min(share.len());
                lowered.extend(cells.clone());
                for i in cells.filter(|i| *i != k) {
                    share[i][kind] /= excess;
                }
            }
        }
    }
    lowered.sort_unstable();
    lowered.dedup();
    lowered
}

/// The coefficients of all cells: each window's, that go over into the next one's about the joint.
fn together(joined: &[(Window, usize)], n: usize) -> Vec<f64> {
    let mut all = vec![0.0; n];
    for (i, (window, joint)) in joined.iter().enumerate() {
        let next = joined.get(i + 1).map(|(_, joint)| *joint);
        for (k, c) in window.cells.clone().zip(&window.coefficients) {
            let rising = if i > 0 { fade(k, *joint) } else { 1.0 };
            let falling = next.map_or(1.0, |joint| 1.0 - fade(k, joint));
            all[k] += c * rising.min(falling);
        }
    }
    all
}

/// Share of the next window at a cell: from 0 to 1 over the cells about the joint.
fn fade(cell: usize, joint: usize) -> f64 {
    let u = ((cell as f64 - joint as f64) / FADE as f64 + 0.5).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// The cell about which two windows agree best over a fade, and by how much they differ there, over their size.
fn agree(a: &Window, b: &Window) -> (usize, f64) {
    let shared = a.cells.start.max(b.cells.start)..a.cells.end.min(b.cells.end);
    let at = |w: &Window, k: usize| w.coefficients[k - w.cells.start];
    let off: Vec<f64> = shared.clone().map(|k| (at(a, k) / at(b, k) - 1.0).abs()).collect();
    let width = FADE + 2;
    let places = (0..off.len().saturating_sub(width))
        .map(|i| (shared.start + i + width / 2, off[i..i + width].iter().copied().fold(0.0, f64::max)));
    places.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((shared.start, f64::INFINITY))
}

/// Solves windows.
struct Solver<'a, const A: usize> {
    shape: &'a Shape<'a, A>,
    reach: Reach,
    precision: Precision,
    /// Steps so far.
    steps: AtomicU32,
    progress: &'a dyn Progress,
}

impl<const A: usize> Solver<'_, A> {
    /// Windows over all cells.
    fn unsolved(&self) -> Vec<Window> {
        let n = self.shape.len();
        let parts = n.div_ceil(CELLS + CELLS / 2).max(1);
        (0..parts).map(|i| self.window(i * n / parts..(i + 1) * n / parts)).collect()
    }

    /// A window that answers for these cells, at the start of the whole.
    fn window(&self, own: Range<usize>) -> Window {
        let cells = self.reach.around(own.clone());
        Window { own, cells, coefficients: Vec::new(), gap: f64::INFINITY }
    }

    /// The fastest run over the cells of a window from rest to rest, from where it is.
    fn settled(&self, mut window: Window, share: &[[f64; 2]]) -> Result<Window> {
        /// Distance from the nearest limit at which a solution starts, and the gap between time and bound to start from: of
        /// the start of the whole, and of a solution.
        const START: [[f64; 2]; 2] = [[0.9, 10.0], [0.99, 1e-2]];
        let settled = match self.precision {
            Precision::Rough => ROUGH,
            Precision::Settled => SETTLED,
        };
        if window.gap <= settled {
            return Ok(window);
        }
        if self.progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "the run was cancelled").into());
        }
        let part = self.shape.part(window.cells.clone());
        let is_new = window.coefficients.is_empty();
        if is_new {
            window.coefficients = part.start();
        }
        let [room, gap] = START[usize::from(!is_new)];
        let problem = part.problem(&share[window.cells.clone()], &window.coefficients);
        let solved = solve(&problem, &vec![problem.feasible(room); part.len()], [gap, settled]);
        self.steps.fetch_add(solved.steps, Ordering::Relaxed);
        for (c, x) in window.coefficients.iter_mut().zip(&solved.x) {
            *c *= x;
        }
        window.gap = settled;
        Ok(window)
    }

    /// Largest difference at which two windows agree.
    fn agreed(&self) -> f64 {
        match self.precision {
            Precision::Rough => f64::INFINITY,
            Precision::Settled => AGREED,
        }
    }

    /// The windows with the joint of each with the one before. Where two do not agree, one about their seam goes between them;
    /// where that does not agree with both, the two are solved as one.
    fn joined(&self, windows: Vec<Window>, share: &[[f64; 2]]) -> Result<Vec<(Window, usize)>> {
        let agreed = self.agreed();
        let between = |pair: &[Window]| -> Result<Option<Window>> {
            if agree(&pair[0], &pair[1]).1 <= agreed {
                return Ok(None);
            }
            let seam = pair[1].own.start;
            let own = seam.saturating_sub(CELLS / 2).max(pair[0].own.start)
                ..(seam + CELLS / 2).min(pair[1].own.end);
            self.settled(self.window(own), share).map(Some)
        };
        let seams: Result<Vec<Option<Window>>> =
            windows.par_windows(2).with_max_len(1).map(between).collect();
        let mut seams = seams?.into_iter();
        let mut joined: Vec<(Window, usize)> = Vec::with_capacity(windows.len());
        for mut window in windows {
            let seam = if joined.is_empty() { None } else { seams.next().flatten() };
            if let Some(seam) = seam
                && let Some((last, before)) = joined.last_mut()
            {
                let [(from, off), (to, off_too)] = [agree(last, &seam), agree(&seam, &window)];
                if off.max(off_too) <= agreed && *before + FADE < from && from + FADE < to {
                    last.own.end = from;
                    window.own.start = to;
                    joined.push((Window { own: from..to, ..seam }, from));
                }
            }
            let joint = loop {
                let Some((last, before)) = joined.last() else { break 0 };
                let (joint, off) = agree(last, &window);
                let agrees = off <= agreed && *before + FADE < joint;
                if agrees || window.own.end - last.own.start > MOST_CELLS {
                    break joint;
                }
                let both = last.own.start..window.own.end;
                joined.pop();
                window = self.settled(self.window(both), share)?;
            };
            joined.push((window, joint));
        }
        Ok(joined)
    }
}

/// Influence of a stop over the cells.
struct Reach {
    /// Up to each knot, the length of each cell over the way to a stop from its speed, added up.
    sums: Vec<f64>,
}

impl Reach {
    fn new<const A: usize>(shape: &Shape<A>, limits: &[AxisLimit; A], start: &[f64]) -> Reach {
        let slowest = |limit: fn(&AxisLimit) -> f64| limits.iter().map(limit).fold(f64::INFINITY, f64::min);
        let (a, j) = (slowest(|l| l.acceleration), slowest(|l| l.jerk));
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        for (pair, b) in shape.knots.windows(2).zip(start) {
            let v = b.sqrt();
            sum += (pair[1] - pair[0]) / way_to_speed(v, a, j).max(f64::MIN_POSITIVE);
            sums.push(sum);
        }
        Reach { sums }
    }

    /// These cells, and those beside them in which a stop is forgotten.
    fn around(&self, own: Range<usize>) -> Range<usize> {
        let n = self.sums.len() - 1;
        let first = self.sums.partition_point(|s| *s < self.sums[own.start] - FORGOTTEN);
        let last = self.sums.partition_point(|s| *s < self.sums[own.end] + FORGOTTEN);
        let first = first.saturating_sub(2 * FADE).min(own.start);
        first..(last + 2 * FADE).min(n).max(own.end)
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::places;
    use super::super::start::Start;
    use super::super::test_courses::{LIMIT, Wave};
    use super::super::{End, grid};
    use super::*;
    use crate::base::Silent;

    #[test]
    fn the_method_settles_soon_and_does_not_care_for_the_sides_of_limits() {
        let limits = [LIMIT; 2];
        let knots = grid::knots(&Wave, &limits, Start::of(&Wave, &limits), [End::Rest; 2]).unwrap();
        let places = places(&Wave, &limits, &knots).unwrap();
        let shape = Shape::new(&knots, Wave.length(), &places, &limits);
        for n in [1, 2, 3, 4, 5, 6, 7, 8, 9, 300, 301, 302, 303] {
            let part = shape.part(1000..1000 + n);
            let problem = |sign: f64| {
                let mut problem = part.problem(&vec![[1.0; 2]; n], &part.start());
                let rows = problem.cells.iter_mut().flat_map(|cell| &mut cell.rows).flatten().flatten();
                rows.for_each(|number| *number *= sign);
                problem
            };
            let [one, other] = [1.0, -1.0].map(|sign| {
                let problem = problem(sign);
                solve(&problem, &vec![problem.feasible(0.9); n], [10.0, SETTLED])
            });
            assert!(one.steps <= 30 && other.steps <= 30, "{n}: {} and {} steps", one.steps, other.steps);
            for (a, b) in one.x.iter().zip(&other.x) {
                assert!((a / b - 1.0).abs() < 1e-9, "{n}: {a} {b}");
            }
        }
    }

    #[test]
    fn windows_together_are_the_run_that_is_solved_as_one() {
        let limits = [LIMIT; 2];
        let knots = grid::knots(&Wave, &limits, Start::of(&Wave, &limits), [End::Rest; 2]).unwrap();
        let places = places(&Wave, &limits, &knots).unwrap();
        let shape = Shape::new(&knots, Wave.length(), &places, &limits);
        let n = shape.len();
        assert!(n > 3 * CELLS, "{n}");
        let whole = |own: Vec<f64>| {
            let folds = shape.folds();
            let all = [&[folds[0] * own[0]][..], &own, &[folds[1] * own[n - 1]]].concat();
            Speed::new(shape.stops, shape.knots, &all).duration()
        };
        let reach = Reach::new(&shape, &limits, &shape.start());
        let precision = Precision::Settled;
        let solver = Solver { shape: &shape, reach, precision, steps: AtomicU32::new(0), progress: &Silent };
        let share = vec![[1.0; 2]; n];
        let one = whole(solver.settled(solver.window(0..n), &share).unwrap().coefficients);
        let seams = [0, n / 3, 2 * n / 3, n];
        let windows =
            seams.windows(2).map(|b| solver.settled(solver.window(b[0]..b[1]), &share).unwrap()).collect();
        let joined = solver.joined(windows, &share).unwrap();
        for pair in joined.windows(2) {
            assert!(agree(&pair[0].0, &pair[1].0).1 <= AGREED);
        }
        let several = whole(together(&joined, n));
        assert!((several / one - 1.0).abs() < 1e-7, "{several} {one}");
    }
}
