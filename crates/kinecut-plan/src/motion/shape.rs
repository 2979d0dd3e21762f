//! A course on a grid: what the solver knows of it.

use std::ops::Range;

use super::interior::{Cell, KINDS, Problem};
use super::spline::{at_stop, basis, lengths};
use super::{AxisLimit, Course};
use crate::base::{Code, Finding, Result};

/// Beside a knot, over the length of the cell: derivatives may step at a knot.
pub(super) const BESIDE: f64 = 1e-9;

/// Axes and speed beside a knot.
#[derive(Clone, Copy)]
pub(super) struct Place<const A: usize> {
    jets: [[f64; 3]; A],
    /// Largest square of the speed [mm^2/s^2].
    cap: f64,
}

/// A course on a grid, or a stretch of it, from rest to rest: the shape at both ends of each cell.
#[derive(Clone, Copy)]
pub(super) struct Shape<'a, const A: usize> {
    /// Knots [mm].
    pub(super) knots: &'a [f64],
    /// Where the path leaves its rest, and where it comes to rest; an end without rest is a knot [mm].
    pub(super) stops: [f64; 2],
    places: &'a [[Place<A>; 2]],
    limits: &'a [AxisLimit; A],
}

/// The error about a place [mm] at which a path cannot be run.
pub(super) fn not_finite(s: f64) -> Finding {
    Finding::error(Code::PLAN_VALUE, "the path cannot be run here: a derivative or its feed is not finite")
        .value(s, "mm")
}

/// Both ends of each cell of a course.
///
/// # Errors
/// `KC0404` where a derivative or the feed is not finite, or the path may not move.
pub(super) fn places<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    knots: &[f64],
) -> Result<Vec<[Place<A>; 2]>> {
    let place = |s: f64| {
        let (jets, feed) = course.derivatives_and_feed(s);
        let mut cap = feed * feed;
        for (q, limit) in jets.iter().zip(limits) {
            let most = limit.velocity / q[0].abs();
            cap = cap.min(most * most);
        }
        let finite =
            jets.iter().flatten().all(|d| d.is_finite()) && feed > 0.0 && cap > 0.0 && cap.is_finite();
        finite.then_some(Place { jets, cap }).ok_or_else(|| not_finite(s))
    };
    let mut places = Vec::with_capacity(knots.len() - 1);
    for pair in knots.windows(2) {
        let h = pair[1] - pair[0];
        places.push([place(pair[0] + BESIDE * h)?, place(pair[1] - BESIDE * h)?]);
    }
    Ok(places)
}

impl<'a, const A: usize> Shape<'a, A> {
    /// All of a course of this length [mm].
    pub(super) fn new(
        knots: &'a [f64],
        length: f64,
        places: &'a [[Place<A>; 2]],
        limits: &'a [AxisLimit; A],
    ) -> Shape<'a, A> {
        Shape { knots, stops: [0.0, length], places, limits }
    }

    /// Cells.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// These cells alone, with rests in the cells beside them; at the ends the rests of the whole.
    pub(super) fn part(&self, cells: Range<usize>) -> Shape<'a, A> {
        let first = if cells.start > 0 { self.knots[cells.start - 1] } else { self.stops[0] };
        let last = if cells.end < self.len() { self.knots[cells.end + 1] } else { self.stops[1] };
        Shape {
            knots: &self.knots[cells.start..=cells.end],
            stops: [first, last],
            places: &self.places[cells],
            limits: self.limits,
        }
    }

    /// Lengths of the cells at rest [mm].
    fn rests(&self) -> [f64; 2] {
        [self.knots[0] - self.stops[0], self.stops[1] - self.knots[self.len()]]
    }

    /// Share of its neighbour that the coefficient at each end is: without a cell at rest the speed is even there.
    pub(super) fn folds(&self) -> [f64; 2] {
        let [first, last] = self.rests();
        let fold = |rest: f64, k: usize| {
            if rest > 0.0 { at_stop(rest, lengths(self.knots, k)[1]) } else { 1.0 }
        };
        [fold(first, 0), fold(last, self.len() - 1)]
    }

    /// Largest coefficient at each stop: from rest under a jerk J, `b = (6^(4/3) / 4) (J s^2)^(2/3)`.
    fn at_rest(&self) -> [f64; 2] {
        /// Share of the limits: the path is a little curved beside the stop.
        const SHARE: f64 = 0.98;
        let n = self.len();
        let rests = self.rests();
        [(rests[0], self.places[0][0]), (rests[1], self.places[n - 1][1])].map(|(h, place)| {
            if h <= 0.0 {
                return f64::INFINITY;
            }
            let along = |limit: fn(&AxisLimit) -> f64| {
                let of_axes = place.jets.iter().zip(self.limits).map(|(q, l)| limit(l) / q[0].abs());
                SHARE * of_axes.fold(f64::INFINITY, f64::min)
            };
            let by_jerk = 0.25 * 6f64.powf(4.0 / 3.0) * (along(|l| l.jerk) * h * h).powf(2.0 / 3.0);
            // At its end the acceleration is b'/2 = 2/3 b / h.
            by_jerk.min(1.5 * along(|l| l.acceleration) * h)
        })
    }

    /// Coefficients to start from: what shape and feed allow in the neighbourhood, and no faster growth than jerk and
    /// acceleration allow. From rest under a jerk J, `b^(3/4)` grows by `6 / 4^(3/4) sqrt(J)` a millimetre.
    ///
    /// Smooth, because a step of `b'` asks for much jerk, and the whole start is as slow as its worst place asks for.
    pub(super) fn start(&self) -> Vec<f64> {
        const SHARE: f64 = 0.7;
        const NEIGHBOURS: usize = 12;
        const SMOOTHINGS: usize = 64;
        let n = self.len();
        let mut shape = vec![f64::INFINITY; n + 1];
        let mut growth = Vec::with_capacity(n);
        for (k, pair) in self.places.iter().enumerate() {
            let (mut jerk, mut acceleration) = (f64::INFINITY, f64::INFINITY);
            for place in pair {
                let mut b = place.cap;
                for (q, l) in place.jets.iter().zip(self.limits) {
                    b = b.min(0.9 * l.acceleration / q[1].abs());
                    b = b.min((0.9 * l.jerk / q[2].abs()).powf(2.0 / 3.0));
                    jerk = jerk.min(l.jerk / q[0].abs());
                    acceleration = acceleration.min(l.acceleration / q[0].abs());
                }
                for m in &mut shape[k..=k + 1] {
                    *m = m.min(b);
                }
            }
            growth.push([SHARE * 6.0 / 4f64.powf(0.75) * jerk.sqrt(), SHARE * 2.0 * acceleration]);
        }
        let mut most: Vec<f64> = (0..=n)
            .map(|k| {
                let near = &shape[k.saturating_sub(NEIGHBOURS)..(k + NEIGHBOURS + 1).min(n + 1)];
                near.iter().copied().fold(f64::INFINITY, f64::min)
            })
            .collect();
        let [first, last] = self.rests();
        let grown = |b: f64, [jerk, acceleration]: [f64; 2], h: f64| {
            (b.powf(0.75) + jerk * h).powf(4.0 / 3.0).min(b + acceleration * h)
        };
        for (k, cell, rest) in [(0, 0, first), (n, n - 1, last)] {
            if rest > 0.0 {
                most[k] = most[k].min(grown(0.0, growth[cell], rest));
            }
        }
        let h = |k: usize| self.knots[k + 1] - self.knots[k];
        for k in 0..n {
            most[k + 1] = most[k + 1].min(grown(most[k], growth[k], h(k)));
        }
        for k in (0..n).rev() {
            most[k] = most[k].min(grown(most[k + 1], growth[k], h(k)));
        }
        let mut start: Vec<f64> = most.windows(2).map(|b| (b[0] * b[1]).sqrt()).collect();
        for _ in 0..SMOOTHINGS {
            let mut before = start[0];
            for k in 1..n.saturating_sub(1) {
                let here = start[k];
                start[k] = 0.25 * before + 0.5 * here + 0.25 * start[k + 1];
                before = here;
            }
        }
        start
    }

    /// The problem in units of `scale`, with the share of acceleration and jerk that each cell may use.
    pub(super) fn problem(&self, share: &[[f64; 2]], scale: &[f64]) -> Problem<A> {
        let n = self.len();
        let folds = self.folds();
        let at_rest = self.at_rest();
        let cap = |k: usize| self.places[k][0].cap.min(self.places[k][1].cap);
        let cells = (0..n)
            .map(|k| {
                let h = lengths(self.knots, k);
                let scaled = |mut row: [f64; 3]| {
                    if k == 0 {
                        row = [0.0, row[1] + folds[0] * row[0], row[2]];
                    }
                    if k == n - 1 {
                        row = [row[0], row[1] + folds[1] * row[2], 0.0];
                    }
                    let at = |k: usize| scale.get(k).copied().unwrap_or(0.0);
                    [row[0] * at(k.wrapping_sub(1)), row[1] * at(k), row[2] * at(k + 1)]
                };
                let bases = [basis(h, 0.0), basis(h, h[1])];
                let mut rows = [[[0.0; 3]; A]; KINDS];
                // A row at a knot answers for both cells beside it.
                let steady = share[k][0].min(share[(k + 1).min(n - 1)][0]);
                for (a, limit) in self.limits.iter().enumerate() {
                    let [left, right] = [0, 1].map(|e| self.places[k][e].jets[a]);
                    let row = |b: &[[f64; 3]; 3], w: [f64; 3], most: f64| {
                        scaled([0, 1, 2].map(|i| (w[0] * b[0][i] + w[1] * b[1][i] + w[2] * b[2][i]) / most))
                    };
                    rows[0][a] = row(&bases[1], [right[1], 0.5 * right[0], 0.0], limit.acceleration * steady);
                    let jerk = |basis, q: [f64; 3]| {
                        row(basis, [q[2], 1.5 * q[1], 0.5 * q[0]], limit.jerk * share[k][1])
                    };
                    rows[1][a] = jerk(&bases[0], left);
                    rows[2][a] = jerk(&bases[1], right);
                }
                let gauss = [-1.0, 1.0].map(|sign| {
                    let u = 0.5 * h[1] * (1.0 + sign / 3f64.sqrt());
                    scaled(basis(h, u)[0])
                });
                // A coefficient counts in three cells.
                let near = k.saturating_sub(1)..(k + 2).min(n);
                let mut own = near.map(cap).fold(f64::INFINITY, f64::min);
                if k == 0 {
                    own = own.min(at_rest[0] / folds[0]);
                }
                if k == n - 1 {
                    own = own.min(at_rest[1] / folds[1]);
                }
                Cell {
                    ends: bases.map(|b| scaled(b[0])),
                    rows,
                    gauss,
                    weight: 0.5 * h[1],
                    cap: own / scale[k],
                }
            })
            .collect();
        let rests = self.rests();
        let rest = [(0, 0), (1, n - 1)].map(|(e, k)| [3.0 * rests[e], folds[e] * scale[k]]);
        Problem { cells, rest }
    }
}
