//! A long path is solved in windows that know nothing of one another, and joined where they agree.
//!
//! Each window runs from rest to rest over its own cells and some beside them. A stop has no influence beyond the way in
//! which the path gets to speed, so neighbours agree where both have forgotten their stops; there one goes over into the
//! other. Where two do not agree they are solved as one, up to a size.

use std::ops::Range;

use rayon::prelude::*;

use super::interior::solve;
use super::shape::Shape;
use super::shares::of_cells;
use super::start::way_to_speed;
use super::{AxisLimit, Course, Speed};
use crate::base::{Code, Finding, Progress, Result};

/// Cells of a window.
const CELLS: usize = 2000;
/// Cells over which a window goes over into the next one.
const FADE: usize = 16;
/// Times that a window could get to rest from its speed in the cells beside its own.
const FORGOTTEN: f64 = 3.0;
/// Most cells that are solved as one because windows do not agree: beyond it they are joined where they agree best.
const MOST_CELLS: usize = 4 * CELLS;
/// Largest difference of the coefficients of two windows, over their size, at which they agree.
const AGREED: f64 = 1e-5;
/// Rounds in which cells that exceed a limit between their knots get a smaller share of it.
const ROUNDS: u32 = 3;
/// Excess that is left as it is.
const EXCESS: f64 = 2e-4;

/// A solved stretch of cells.
struct Window {
    cells: Range<usize>,
    /// One a cell.
    coefficients: Vec<f64>,
    steps: u32,
}

/// Coefficients of the fastest run over all cells, those at the ends included; second: steps of the solver.
///
/// # Errors
/// `KC0009` when it was cancelled.
pub(super) fn coefficients<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    shape: &Shape<A>,
    progress: &dyn Progress,
) -> Result<(Vec<f64>, u32)> {
    let n = shape.len();
    let start = shape.start();
    let parts = n.div_ceil(CELLS + CELLS / 2).max(1);
    let seams: Vec<usize> = (1..parts).map(|i| i * n / parts).collect();
    let reach = Reach::new(shape, limits, &start);
    let solve = |own: Range<usize>| -> Result<Window> {
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "the run was cancelled").into());
        }
        Ok(window(course, limits, shape, reach.around(own)))
    };
    let bounds: Vec<usize> = [&[0][..], &seams, &[n]].concat();
    let ranges: Vec<Range<usize>> = bounds.windows(2).map(|b| b[0]..b[1]).collect();
    let windows: Result<Vec<Window>> = ranges.clone().into_par_iter().with_max_len(1).map(&solve).collect();
    let windows = windows?;
    let mut steps: u32 = windows.iter().map(|w| w.steps).sum();
    // Windows with the cells that they answer for, and the joint of each with the one before.
    let mut joined: Vec<(Range<usize>, Window, usize)> = Vec::new();
    for (mut own, mut window) in ranges.into_iter().zip(windows) {
        let joint = loop {
            let Some((before, last, _)) = joined.last() else { break 0 };
            let (joint, off) = agree(last, &window);
            match off <= AGREED || own.end - before.start > MOST_CELLS {
                true => break joint,
                false => {
                    own = before.start..own.end;
                    joined.pop();
                    window = solve(own.clone())?;
                    steps += window.steps;
                }
            }
        };
        joined.push((own, window, joint));
    }
    let mut all = vec![0.0; n];
    for (i, (_, window, joint)) in joined.iter().enumerate() {
        let next = joined.get(i + 1).map(|(.., joint)| *joint);
        for (k, c) in window.cells.clone().zip(&window.coefficients) {
            let rising = if i > 0 { fade(k, *joint) } else { 1.0 };
            let falling = next.map_or(1.0, |joint| 1.0 - fade(k, joint));
            all[k] += c * rising.min(falling);
        }
    }
    let folds = shape.folds();
    let (first, last) = (folds[0] * all[0], folds[1] * all[n - 1]);
    Ok(([&[first][..], &all, &[last]].concat(), steps))
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

/// Solves these cells from rest to rest.
fn window<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    shape: &Shape<A>,
    cells: Range<usize>,
) -> Window {
    /// Distance from the nearest limit at which a solution starts, in the first round and in the others, which start from the
    /// last solution; and the gap between time and bound to start from.
    const START: [[f64; 2]; 2] = [[0.9, 10.0], [0.99, 1e-2]];
    let part = shape.part(cells.clone());
    let n = part.len();
    let mut share = vec![[1.0; 2]; n];
    let mut scale = part.start();
    let mut steps = 0;
    for round in 0..ROUNDS {
        let problem = part.problem(&share, &scale);
        let [room, gap] = START[usize::from(round > 0)];
        let solved = solve(&problem, &vec![problem.feasible(room); n], gap);
        steps += solved.steps;
        for (scale, x) in scale.iter_mut().zip(&solved.x) {
            *scale *= x;
        }
        let folds = part.folds();
        let all = [&[folds[0] * scale[0]][..], &scale, &[folds[1] * scale[n - 1]]].concat();
        let speed = Speed::new(part.stops, part.knots, &all);
        let found = of_cells(course, limits, &speed, 0..n);
        let mut exceeded = false;
        for (share, found) in share.iter_mut().zip(&found) {
            for (share, found) in share.iter_mut().zip([found.acceleration, found.jerk]) {
                if found > 1.0 {
                    exceeded |= found > 1.0 + EXCESS;
                    *share /= found * (1.0 + 0.1 * (found - 1.0));
                }
            }
        }
        if !exceeded {
            break;
        }
    }
    Window { cells, coefficients: scale, steps }
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
