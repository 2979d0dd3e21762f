//! Cells that exceed a limit by little are passed slower, and the way beside them as smoothly as the axes can follow.

use rayon::prelude::*;

use super::shares::{CellShares, of_cells_at_last};
use super::start::way_to_speed;
use super::{AxisLimit, Course, End, Speed};

/// Most passes: each leaves about a tenth of the excess, where its changes of speed ask for some of the limits.
const PASSES: u32 = 4;
/// Factor of time that a cell may be left with, less 1: the rest is the whole run's.
const LEFT: f64 = 1e-7;
/// Largest factor of time that is eased, less 1.
const MOST: f64 = 0.02;
/// Ways from rest to the present speed over which a slower cell goes over into the speed beside it.
const BESIDE: f64 = 4.0;

/// The speed eased where it exceeds a limit by little, with the shares of its cells.
pub(super) fn eased<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    mut speed: Speed,
    ends: [End; 2],
) -> (Speed, Vec<CellShares>) {
    let mut found = of_cells_at_last(course, limits, &speed, (0..speed.cells()).into_par_iter());
    for _ in 0..PASSES {
        let largest = largest(&found);
        if !(largest > 1.0 + LEFT && largest < 1.0 + MOST) {
            break;
        }
        let factors = factors(limits, &speed, &found, ends);
        let eased = speed.slower_by(&factors);
        // A cell has three coefficients, its own and those of its neighbours.
        let is_other = |k: &usize| {
            let near = k.saturating_sub(1)..(k + 2).min(factors.len());
            factors[near].iter().any(|factor| *factor != 1.0)
        };
        let others: Vec<usize> = (0..found.len()).filter(is_other).collect();
        let mut after = found.clone();
        let looked_at = of_cells_at_last(course, limits, &eased, others.par_iter().copied());
        for (k, cell) in others.into_iter().zip(looked_at) {
            after[k] = cell;
        }
        if !(self::largest(&after) < largest) {
            break;
        }
        (speed, found) = (eased, after);
    }
    (speed, found)
}

/// Largest factor of time that a cell asks for.
fn largest(found: &[CellShares]) -> f64 {
    found.iter().map(|cell| cell.all.dilation()).fold(1.0, f64::max)
}

/// Factor of time of each cell: that of its excess, and beside it as much as is left of a smooth hill about it.
fn factors<const A: usize>(
    limits: &[AxisLimit; A],
    speed: &Speed,
    found: &[CellShares],
    ends: [End; 2],
) -> Vec<f64> {
    let places = places(limits, speed);
    let asks = found.iter().map(|cell| cell.all.dilation()).enumerate();
    let mut exceeding: Vec<(usize, f64)> = asks.filter(|(_, factor)| *factor > 1.0).collect();
    exceeding.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut factors = vec![1.0; found.len()];
    for (k, factor) in exceeding {
        // What a hill beside it has done need not be done again.
        let missing = factor - factors[k];
        if missing <= 0.0 {
            continue;
        }
        let place = places[k];
        // An end that is no rest keeps its speed.
        let even = ends.into_iter().zip([place - places[0], places[places.len() - 1] - place]);
        let even = even.filter(|(side, _)| *side == End::Even);
        let reach = even.fold(BESIDE, |reach, (_, distance)| reach.min(distance));
        let from = places.partition_point(|p| *p < place - reach);
        let to = places.partition_point(|p| *p < place + reach);
        for (factor, p) in factors[from..to].iter_mut().zip(&places[from..to]) {
            let u = (p - place) / reach;
            *factor += missing * (1.0 - u * u).powi(3);
        }
    }
    factors
}

/// Middles of cells, counted in ways from rest to the speed that they have.
fn places<const A: usize>(limits: &[AxisLimit; A], speed: &Speed) -> Vec<f64> {
    let slowest = |limit: fn(&AxisLimit) -> f64| limits.iter().map(limit).fold(f64::INFINITY, f64::min);
    let (a, j) = (slowest(|l| l.acceleration), slowest(|l| l.jerk));
    let mut places = Vec::with_capacity(speed.cells());
    let mut end = 0.0;
    for pair in speed.knots().windows(2) {
        let v = speed.square(0.5 * (pair[0] + pair[1]))[0].sqrt();
        let ways = (pair[1] - pair[0]) / way_to_speed(v, a, j);
        places.push(end + 0.5 * ways);
        end += ways;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::super::test_courses::{LIMIT, Wave};
    use super::super::{End, TimeLaw};
    use super::*;

    #[test]
    fn a_little_excess_is_passed_slower_and_the_ends_keep_their_speed() {
        let limits = [LIMIT; 2];
        let law = TimeLaw::new(&Wave, &limits).unwrap();
        let n = law.cells();
        let hill = |k: usize, at: usize| 0.002 * (-((k as f64 - at as f64) / 80.0).powi(2)).exp();
        let faster: Vec<f64> = (0..n).map(|k| 1.0 - hill(k, n / 5) - hill(k, n / 2)).collect();
        let speed = law.speed().slower_by(&faster);
        let before = largest(&of_cells_at_last(&Wave, &limits, &speed, (0..n).into_par_iter()));
        assert!(before > 1.001 && before < 1.0 + MOST, "{before}");
        for ends in [[End::Rest; 2], [End::Even; 2]] {
            let (eased, found) = eased(&Wave, &limits, speed.clone(), ends);
            assert!(largest(&found) < 1.0 + 1e-5, "{}", largest(&found));
            let again = of_cells_at_last(&Wave, &limits, &eased, (0..n).into_par_iter());
            assert_eq!(largest(&again), largest(&found));
            let longer = eased.duration() / speed.duration();
            assert!(longer > 1.0 && longer < 1.001, "{longer}");
            let ends = [speed.knots()[0], speed.knots()[n]];
            for s in ends {
                assert!((eased.square(s)[0] / speed.square(s)[0] - 1.0).abs() < 1e-9);
            }
        }
    }
}
