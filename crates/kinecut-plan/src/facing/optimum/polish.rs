//! Refining a local minimum: the certificate needs the value near, the user wants it exact.

use super::objective::Valued;
use super::search::Bounded;

/// Refines the angle of a minimum: a grid over a window that shrinks around its best point from the first size to the
/// second; kinks and jumps do no harm. `value`: the least value at an angle with its place, if it may be less than the
/// second argument.
pub(super) fn refine_angle(
    start: Valued,
    window: [f64; 2],
    mut value: impl FnMut(f64, f64) -> Option<Valued>,
) -> Valued {
    let mut best = start;
    let mut half = window[0];
    while half > window[1] {
        let centre = best.1[0];
        for k in -SIDE..=SIDE {
            if k != 0
                && let Some(found) = value(centre + half * f64::from(k) / f64::from(SIDE), best.0)
                && found.0 < best.0
            {
                best = found;
            }
        }
        half *= SHRINK;
    }
    best
}

/// Angles of a window tried to either side of its middle.
const SIDE: i32 = 2;
/// The next window reaches a little farther than the neighbours of the best angle.
const SHRINK: f64 = 0.55;

/// Refines the offset of a minimum at a fixed angle: a grid over a window that shrinks around its best point from the
/// first size to the second. Where the last steps are about the rounding of heights, a border of an edge that counts
/// as a whole is passed.
pub(super) fn refine_offset(
    start: Valued,
    [window, least]: [f64; 2],
    mut value: impl FnMut(f64) -> Option<Valued>,
) -> Valued {
    let mut best = start;
    let mut half = window;
    while half > least {
        let centre = best.1[1];
        for k in -SIDE..=SIDE {
            if k != 0
                && let Some(found) = value(centre + half * f64::from(k) / f64::from(SIDE))
                && found.0 < best.0
            {
                best = found;
            }
        }
        half *= SHRINK;
    }
    best
}

/// Refines a minimum in angle and offset by steps in directions that turn from one round to the next, so that none of
/// the narrow valleys along which one edge keeps its border is missed for long; steps shrink from the first to the
/// second [mm]. `scale`: length of a step of one radian [mm].
pub(super) fn refine(
    start: Valued,
    [step, least]: [f64; 2],
    scale: f64,
    mut value: impl FnMut([f64; 2]) -> Option<Valued>,
) -> Valued {
    let mut best = start;
    let mut step = step;
    let mut turn = 0.0f64;
    for _ in 0..ROUNDS {
        let centre = best.1;
        let before = best.0;
        for k in 0..DIRECTIONS {
            let (sin, cos) = (turn + std::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS)).sin_cos();
            if let Some(found) = value([centre[0] + step * cos / scale, centre[1] + step * sin])
                && found.0 < best.0
            {
                best = found;
            }
        }
        // The golden angle: directions never repeat.
        turn += 2.399_963_229_728_653;
        step *= if best.0 < before { GROW } else { CONTRACT };
        if step < least {
            break;
        }
    }
    best
}

const ROUNDS: usize = 150;
const DIRECTIONS: i32 = 6;
const GROW: f64 = 1.4;
const CONTRACT: f64 = 0.7;

/// The local minima of values along a line of samples, best first; `closed`: the last is the first's neighbour.
pub(super) fn local_minima(samples: &[Bounded], closed: bool) -> Vec<Bounded> {
    let n = samples.len();
    let lower = |i: usize, step: usize| {
        // A plateau counts once: its first sample.
        let j = (i + step) % n;
        let beyond = !closed && (step == 1 && i + 1 == n || step == n - 1 && i == 0);
        if step == 1 {
            beyond || samples[i].lower <= samples[j].lower
        } else {
            beyond || samples[i].lower < samples[j].lower
        }
    };
    let mut out: Vec<Bounded> = (0..n)
        .filter(|&i| samples[i].lower.is_finite() && lower(i, 1) && lower(i, n - 1))
        .map(|i| samples[i])
        .collect();
    if out.is_empty() {
        out.extend(
            samples
                .iter()
                .filter(|s| s.lower.is_finite())
                .copied()
                .min_by(|a, b| a.lower.total_cmp(&b.lower)),
        );
    }
    out.sort_by(|a, b| a.lower.total_cmp(&b.lower));
    out
}
