//! The fastest run along a path where jerk has no limit: a lower bound of the time.
//!
//! TOPP-RA in closed form (Pham, Pham 2018). In a cell of length `h` the acceleration `u` of the parameter is constant, and
//! the rows of the axes are taken in its middle: `|q'' (b + h u) + q' u| <= A` bounds `u` between two lines in `b`. Backward:
//! the interval `[0, K]` of speeds from which the rest of the path can be run; `K` is the smallest crossing of a lower with an
//! upper line. Forward: as fast as may be inside of these intervals. The error is of second order in the length of cells.
//! For a run that a control makes the rows are taken at both ends of each cell too: in the middle alone the ends of the
//! cells of a smoothed corner are beyond a limit by a tenth.

use super::shape::not_finite;
use super::{AxisLimit, Course, End, Moment};
use crate::base::Result;

/// The run: the square of the speed is linear in the way inside each cell.
#[derive(Clone, Debug)]
pub struct WithoutJerk {
    /// Both stops, and the ends of cells between them [mm].
    knots: Vec<f64>,
    /// Squares of the speed there.
    squares: Vec<f64>,
    /// Moments there [s].
    moments: Vec<f64>,
}

impl WithoutJerk {
    /// Time from rest to rest [s].
    pub fn duration(&self) -> f64 {
        self.moments[self.moments.len() - 1]
    }

    /// Rates of the parameter at both ends [mm/s].
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.squares[0].sqrt(), self.squares[self.squares.len() - 1].sqrt()]
    }

    /// Motion of the parameter at a moment [s] after the start; its way is the place [mm]. Its jerk is that between jumps of
    /// acceleration: none.
    pub fn at(&self, time: f64) -> Moment {
        let n = self.knots.len() - 1;
        let k = self.moments.partition_point(|t| *t <= time).clamp(1, n) - 1;
        let t = (time - self.moments[k]).max(0.0);
        let cell = self.knots[k + 1] - self.knots[k];
        let acceleration = 0.5 * (self.squares[k + 1] - self.squares[k]) / cell;
        let before = self.squares[k].sqrt();
        let way = t * (before + 0.5 * acceleration * t);
        let velocity = (before + acceleration * t).max(0.0);
        Moment { way: self.knots[k] + way.min(cell), velocity, acceleration, jerk: 0.0 }
    }

    /// Moment [s] at which the path reaches a place [mm].
    pub fn moment(&self, s: f64) -> f64 {
        let n = self.knots.len() - 1;
        let k = self.knots.partition_point(|t| *t <= s).clamp(1, n) - 1;
        let way = (s - self.knots[k]).max(0.0);
        let slope = (self.squares[k + 1] - self.squares[k]) / (self.knots[k + 1] - self.knots[k]);
        let sum = self.squares[k].sqrt() + (self.squares[k] + slope * way).max(0.0).sqrt();
        if sum > 0.0 { self.moments[k] + 2.0 * way / sum } else { self.moments[k] }
    }
}

/// Places of a cell at which the limits of the axes are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kept {
    /// In its middle: the time is the nearest to the least one.
    Middle,
    /// At both ends, too: nothing in between is beyond a limit.
    Everywhere,
}

/// The run without jerk limits over knots that include both ends.
///
/// # Errors
/// `KC0404` where a derivative or the feed is not finite.
pub(super) fn without_jerk<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    knots: Vec<f64>,
    ends: [End; 2],
    kept: Kept,
) -> Result<WithoutJerk> {
    /// Share of a cell by which its ends are looked at inside of it.
    const INSIDE: f64 = 1e-6;
    let n = knots.len() - 1;
    let cells: Result<Vec<Lines<A>>> = knots
        .windows(2)
        .map(|pair| {
            let h = pair[1] - pair[0];
            let middle = 0.5 * (pair[0] + pair[1]);
            let (jets, feed) = (course.derivatives(middle), course.feed(middle));
            if !(jets.iter().flatten().all(|d| d.is_finite()) && feed > 0.0) {
                return Err(not_finite(middle).into());
            }
            let mut lines =
                Lines { rows: [[[0.0, f64::INFINITY]; A]; 3], feed: feed * feed, cap: feed * feed };
            for (a, (q, limit)) in jets.iter().zip(limits).enumerate() {
                lines.row([0, a], q, h, limit);
                lines.cap = lines.cap.min((limit.velocity / q[0].abs()).powi(2));
            }
            if kept == Kept::Everywhere {
                // Inside of the cell: at a knot the derivatives may step.
                for (place, share) in [INSIDE, 1.0 - INSIDE].into_iter().enumerate() {
                    let jets = course.derivatives(pair[0] + share * h);
                    for (a, (q, limit)) in jets.iter().zip(limits).enumerate() {
                        // At a cusp there is none.
                        if q[0].is_finite() && q[1].is_finite() {
                            lines.row([1 + place, a], q, 2.0 * share * h, limit);
                        }
                    }
                }
            }
            Ok(lines)
        })
        .collect();
    let cells = cells?;
    // Largest square of the speed at each knot.
    let mut most: Vec<f64> = (0..=n)
        .map(|k| {
            let beside = [k.checked_sub(1), Some(k)].into_iter().flatten().filter_map(|k| cells.get(k));
            // A feed holds up to its end; the speed of an axis changes evenly from cell to cell.
            let feed = beside.clone().map(|cell| cell.feed).fold(f64::INFINITY, f64::min);
            beside.map(|cell| cell.cap).fold(0.0, f64::max).min(feed)
        })
        .collect();
    if ends[1] == End::Rest {
        most[n] = 0.0;
    }
    for k in (0..n).rev() {
        let half = 0.5 / (knots[k + 1] - knots[k]);
        most[k] = most[k].min(cells[k].largest(half, most[k + 1]));
    }
    let mut b = if ends[0] == End::Rest { 0.0 } else { most[0] };
    let (mut squares, mut moments) = (vec![b], vec![0.0]);
    let mut time = 0.0;
    for k in 0..n {
        let h = knots[k + 1] - knots[k];
        let u = cells[k].upper(b);
        let next = (b + 2.0 * h * u).clamp(0.0, most[k + 1]);
        let sum = b.sqrt() + next.sqrt();
        if sum > 0.0 {
            time += 2.0 * h / sum;
        }
        b = next;
        squares.push(b);
        moments.push(time);
    }
    Ok(WithoutJerk { knots, squares, moments })
}

/// Bounds of the acceleration in a cell: `slope b - width <= u <= slope b + width` for each axis, in the middle and at both
/// ends.
struct Lines<const A: usize> {
    /// Slope and width.
    rows: [[[f64; 2]; A]; 3],
    /// Square of the feed.
    feed: f64,
    /// Largest square of the speed.
    cap: f64,
}

impl<const A: usize> Lines<A> {
    /// Sets the row of an axis at a place: `reach`, twice the way from the start of the cell [mm].
    fn row(&mut self, [place, axis]: [usize; 2], q: &[f64; 3], reach: f64, limit: &AxisLimit) {
        /// Derivatives below which an axis does not bind.
        const NONE: f64 = 1e-12;
        let factor = q[1] * reach + q[0];
        if factor.abs() > NONE {
            self.rows[place][axis] = [-q[1] / factor, limit.acceleration / factor.abs()];
        }
    }

    /// The rows that bind.
    fn binding(&self) -> impl Iterator<Item = [f64; 2]> + Clone + '_ {
        self.rows.iter().flatten().copied().filter(|row| row[1].is_finite())
    }

    fn upper(&self, b: f64) -> f64 {
        self.binding().map(|[m, w]| m * b + w).fold(f64::INFINITY, f64::min)
    }

    /// The largest `b` for which some `u` keeps all rows and leads into `[0, next]`; `half` is `1 / 2h`.
    fn largest(&self, half: f64, next: f64) -> f64 {
        /// Difference of slopes below which two lines are parallel.
        const PARALLEL: f64 = 1e-15;
        let mut most = f64::INFINITY;
        let mut meet = |lower: [f64; 2], upper: [f64; 2]| {
            if lower[0] > upper[0] + PARALLEL {
                most = most.min((upper[1] - lower[1]) / (lower[0] - upper[0]));
            }
        };
        let onward = [[-half, 0.0], [-half, next * half]];
        for [m, w] in self.binding() {
            meet([m, -w], onward[1]);
            meet(onward[0], [m, w]);
            for [m2, w2] in self.binding() {
                meet([m, -w], [m2, w2]);
            }
        }
        most
    }
}
