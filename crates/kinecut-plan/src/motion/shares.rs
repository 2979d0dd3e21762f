//! Shares of the limits that a run uses, from the derivatives of course and speed.

use std::ops::Range;

use rayon::prelude::*;

use super::shape::BESIDE;
use super::{AxisLimit, Course, Speed};

/// Places of a cell at which limits are looked at.
const PLACES: usize = 8;
/// The same in the last look: those, and the ones between them.
const LAST_PLACES: usize = 2 * PLACES - 1;
/// Places in a cell at rest.
const PLACES_AT_REST: usize = 20;
/// Cells that one thread looks at in one go.
const TOGETHER: usize = 512;

/// Largest share of a limit over all axes; the feed counts as a speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shares {
    /// Of feed and speed.
    pub velocity: f64,
    /// Of acceleration.
    pub acceleration: f64,
    /// Of jerk.
    pub jerk: f64,
}

impl Shares {
    /// Those of one place [mm] with `b`, `b'` and `b''`.
    pub(super) fn at<const A: usize, C: Course<A>>(
        course: &C,
        limits: &[AxisLimit; A],
        s: f64,
        [b, b1, b2]: [f64; 3],
    ) -> Shares {
        let root = b.sqrt();
        let (jets, feed) = course.derivatives_and_feed(s);
        let mut worst = Shares { velocity: root / feed, ..Shares::default() };
        for (q, limit) in jets.iter().zip(limits) {
            let own = Shares {
                velocity: (q[0] * root / limit.velocity).abs(),
                acceleration: ((q[1] * b + 0.5 * q[0] * b1) / limit.acceleration).abs(),
                jerk: (root * (q[2] * b + 1.5 * q[1] * b1 + 0.5 * q[0] * b2) / limit.jerk).abs(),
            };
            worst = worst.max(own);
        }
        worst
    }

    /// The larger of each; not a number where one of them is none.
    pub fn max(self, other: Shares) -> Shares {
        Shares {
            velocity: larger(self.velocity, other.velocity),
            acceleration: larger(self.acceleration, other.acceleration),
            jerk: larger(self.jerk, other.jerk),
        }
    }

    /// Factor of time that brings all of them to at most 1: speeds fall with it, accelerations with its square, jerks with
    /// its cube.
    pub fn dilation(self) -> f64 {
        let second = larger(self.velocity, self.acceleration.sqrt());
        larger(larger(1.0, second), self.jerk.cbrt())
    }
}

/// The larger of two; not a number if one of them is none.
fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Largest shares in a cell.
#[derive(Clone, Copy)]
pub(super) struct CellShares {
    /// At its ends.
    pub(super) ends: Shares,
    /// At all places that are looked at, the ends too.
    pub(super) all: Shares,
}

/// Shares in each of these cells.
pub(super) fn of_cells<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    speed: &Speed,
    cells: Range<usize>,
) -> Vec<CellShares> {
    at_places(course, limits, speed, cells.into_par_iter(), PLACES)
}

/// The same at the places of the last look.
pub(super) fn of_cells_at_last<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    speed: &Speed,
    cells: impl IndexedParallelIterator<Item = usize>,
) -> Vec<CellShares> {
    at_places(course, limits, speed, cells, LAST_PLACES)
}

fn at_places<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    speed: &Speed,
    cells: impl IndexedParallelIterator<Item = usize>,
    places: usize,
) -> Vec<CellShares> {
    let of_cell = |k: usize| {
        let mut found = CellShares { ends: Shares::default(), all: Shares::default() };
        let mut place = 0;
        speed.in_cell(k, places, BESIDE, |s, b| {
            let here = Shares::at(course, limits, s, b);
            found.all = found.all.max(here);
            if place == 0 || place == places - 1 {
                found.ends = found.ends.max(here);
            }
            place += 1;
        });
        found
    };
    cells.with_min_len(TOGETHER).map(of_cell).collect()
}

/// Largest shares of these cells.
pub(super) fn of_all(cells: &[CellShares]) -> Shares {
    cells.iter().fold(Shares::default(), |worst, cell| worst.max(cell.all))
}

/// Largest shares in the cells at rest.
pub(super) fn at_rests<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    speed: &Speed,
) -> Shares {
    let mut worst = Shares::default();
    speed.at_rest(PLACES_AT_REST, |s, b| worst = worst.max(Shares::at(course, limits, s, b)));
    worst
}

/// Largest shares of a whole run.
pub(super) fn of_run<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    speed: &Speed,
) -> Shares {
    let cells = of_cells_at_last(course, limits, speed, (0..speed.cells()).into_par_iter());
    at_rests(course, limits, speed).max(of_all(&cells))
}
