//! The bad length of a straight edge over a box of placements: what is surely bad, and the derivatives where it has no
//! kink.
//!
//! Surely bad: as in [`lines`](super::lines). The share between two ramps rises, then is linear, then falls in the
//! offset, so over an interval of offsets it is least at one of its ends.
//!
//! Derivatives: a bad stretch ends where y = c + E(omega), E = R cos omega, omega = heading + exit angle. At the length
//! t along the edge, with D = sin(heading), t = (c + E - ya) / D, dt/dc = 1/D, dt/dangle = (-R sin omega - x(t)) / D, x
//! the abscissa of that point.

use std::f64::consts::{PI, TAU};

use super::domain::Extent;
use super::interval::{Smooth, minus, over, plus, times};
use super::lines::{BadInterval, Line, Risen, sure_levels};
use super::place::PlacementBox;
use crate::num::angle::wrap;

/// Length that is bad at every placement of the box [mm].
pub(super) fn sure(line: &Line, part: &BadInterval, place: &PlacementBox, radius: f64, near: f64) -> f64 {
    let risen = Risen::new(line, &place.turned, near);
    let base = wrap(line.heading + place.turned.angle[0]);
    let width = place.turned.angle[1] - place.turned.angle[0];
    let [from, to] = place.offset;
    let mut share = 0.0;
    sure_levels(base, width, part, radius, |low, high| {
        let (low, high) = (low + near, high - near);
        share += match risen.ramps(low, high) {
            Some(ramps) => {
                let (a, b) = (ramps.share(from), ramps.share(to));
                if a < b { a } else { b }
            }
            None => {
                let [start, end] = risen.window(low, high);
                if start < from && to < end { 1.0 } else { 0.0 }
            }
        };
    });
    share * line.length
}

/// Limit that a border of the bad zone sets to the edge's stretch.
enum Limit {
    /// All of the edge is on the good side of it for the stretch.
    Beyond,
    /// Nothing of the edge is.
    Shut,
    /// It crosses the edge at this length, at all placements of the box.
    At(f64, Extent, Extent),
}

/// The bad length with its derivatives if it has no kink on the box.
pub(super) fn smooth(line: &Line, part: &BadInterval, place: &PlacementBox, radius: f64) -> Option<Smooth> {
    let angle = place.turned.angle;
    let base = wrap(line.heading + angle[0]);
    let width = angle[1] - angle[0];
    let a = place.turned.heights(line.start, line.start_size);
    let b = place.turned.heights(line.end, line.end_size);
    // Heights of the edge over the centre line.
    let floor = if a[0] < b[0] { a[0] } else { b[0] } - place.offset[1];
    let top = if a[1] > b[1] { a[1] } else { b[1] } - place.offset[0];
    let mut out = Smooth::default();
    for turn in [-TAU, 0.0] {
        let (lo, hi) = (base + part.from + turn, base + part.to + turn);
        if lo >= 0.0 || hi + width <= -PI {
            continue;
        }
        let low = levels(lo, width, radius);
        let high = levels(hi, width, radius);
        if floor >= high[1] || top <= low[0] {
            continue;
        }
        let no_low = floor >= low[1] || low[1] <= place.reach[0];
        let no_high = top <= high[0] || high[0] >= place.reach[1];
        if no_low && no_high {
            out.value += line.length;
            continue;
        }
        let direction = place.turned.heights(line.direction(), 1.0);
        let up = direction[0] > LEAST_SLANT;
        if !up && direction[1] >= -LEAST_SLANT {
            return None;
        }
        let [low, high] =
            [(no_low, lo, low, false), (no_high, hi, high, true)].map(|(none, omega, level, upper)| {
                if none {
                    Some(Limit::Beyond)
                } else {
                    limit(line, place, radius, a, direction, omega, level, upper == up)
                }
            });
        let (low, high) = (low?, high?);
        if matches!(low, Limit::Shut) || matches!(high, Limit::Shut) {
            continue;
        }
        let (first, last) = if up { (low, high) } else { (high, low) };
        if let Limit::At(at, by_angle, by_offset) = last {
            out.add_end(true, at, by_angle, by_offset);
        } else {
            out.value += line.length;
        }
        if let Limit::At(at, by_angle, by_offset) = first {
            out.add_end(false, at, by_angle, by_offset);
        }
    }
    Some(out)
}

/// Sine of the angle to the feed below which an edge counts as parallel on a box: its derivatives are large there.
const LEAST_SLANT: f64 = 1e-6;

/// Levels of the velocities from `omega` to `omega + width`, cut with the front half.
fn levels(omega: f64, width: f64, radius: f64) -> Extent {
    [omega, omega + width].map(|w| radius * w.clamp(-PI, 0.0).cos())
}

/// The limit of the velocity from `omega` on; `ends`: the stretch ends there going along the edge.
#[expect(
    clippy::too_many_arguments,
    reason = "what both limits of an edge have in common is worked out once"
)]
fn limit(
    line: &Line,
    place: &PlacementBox,
    radius: f64,
    start: Extent,
    slant: Extent,
    omega: f64,
    level: Extent,
    ends: bool,
) -> Option<Limit> {
    let width = place.turned.angle[1] - place.turned.angle[0];
    if omega <= -PI || omega + width >= 0.0 {
        return None;
    }
    let length = over(minus(plus(place.offset, level), start), slant);
    if length[1] <= 0.0 {
        return Some(if ends { Limit::Shut } else { Limit::Beyond });
    }
    if length[0] >= line.length {
        return Some(if ends { Limit::Beyond } else { Limit::Shut });
    }
    if length[0] < 0.0 || length[1] > line.length {
        return None;
    }
    let along = place.turned.abscissas(line.direction(), 1.0);
    let abscissa = plus(place.turned.abscissas(line.start, line.start_size), times(length, along));
    let (s0, s1) = (omega.sin(), (omega + width).sin());
    let mut sine = if s0 < s1 { [s0, s1] } else { [s1, s0] };
    if omega < -0.5 * PI && omega + width > -0.5 * PI {
        sine[0] = -1.0;
    }
    let by_angle = over(minus([-radius * sine[1], -radius * sine[0]], abscissa), slant);
    let by_offset = over([1.0, 1.0], slant);
    let (sin, cos) = place.sin_cos;
    let height = sin * line.start.x + cos * line.start.y;
    let direction = line.direction();
    let at = (place.middle[1] + radius * (omega + 0.5 * width).cos() - height)
        / (sin * direction.x + cos * direction.y);
    Some(Limit::At(at, by_angle, by_offset))
}
