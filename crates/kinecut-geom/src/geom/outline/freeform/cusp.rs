//! Cusps of a spline: places at which it stops and goes on in another direction, as it may at a knot, and within a stretch
//! where its velocity vanishes. The stretch is parted there, so that each part has a direction everywhere; that at the cusp
//! is the one from which, or to which, the part runs.
//!
//! Places that nearly stop count too, where the curve turns in less than the tolerance can show.

use glam::DVec2;

use super::Stretch;
use crate::geom::biarc_fit::Walk;

/// Radius of curvature of a turn that counts as a cusp, as a share of the tolerance.
const SHARP: f64 = 1e-3;
/// Speed that is rounding, as a share of the largest.
const STILL: f64 = 1e-9;
/// Step of the parameter from a cusp to the place whose direction counts, as a share of the part; and least turn towards that
/// of the leg, as the ratio of speeds.
const ASIDE: f64 = 1e-4;
const BEYOND: f64 = 30.0;

/// A part of a stretch between two cusps, or ends of the stretch.
pub(super) struct Part<'a> {
    stretch: &'a Stretch<'a>,
    ends: [f64; 2],
    /// Direction at each end, where the curve has none of its own there.
    directions: [Option<DVec2>; 2],
}

/// The parts of a stretch, none where it is a point.
pub(super) fn parts<'a>(stretch: &'a Stretch<'a>, tolerance: f64) -> Vec<Part<'a>> {
    // A rational curve's velocity has a numerator of twice the degree.
    let count = 8 * (stretch.spline.degree + 1);
    let at = |i: usize| i as f64 / count as f64;
    let velocities: Vec<DVec2> = (0..=count).map(|i| stretch.point_and_velocity(at(i))[1]).collect();
    let fastest = velocities.iter().map(|v| v.length()).fold(0.0, f64::max);
    let size =
        (0..=count).map(|i| stretch.point_and_velocity(at(i))[0].abs().max_element()).fold(0.0, f64::max);
    if fastest <= 4.0 * f64::EPSILON * size {
        return Vec::new();
    }
    let mut places = vec![0.0];
    for i in 1..count {
        let [before, here, after] = [velocities[i - 1], velocities[i], velocities[i + 1]];
        let slowest = here.length() <= before.length() && here.length() <= after.length();
        // What changes so little from place to place does not stop between them.
        let change = before.distance(here).max(after.distance(here));
        if slowest && here.length() <= 2.0 * change {
            let place = slowest_place(stretch, [at(i - 1), at(i + 1)]);
            if stops(stretch, place, tolerance, fastest).is_some()
                && places.last().is_some_and(|&p| p < place)
            {
                places.push(place);
            }
        }
    }
    if places.last().is_some_and(|&p| p < 1.0) {
        places.push(1.0);
    }
    let part = |w: &[f64]| {
        let ends = [w[0], w[1]];
        let direction = |end: f64, inwards: f64| {
            let aside =
                stops(stretch, end, tolerance, fastest)?.clamp(ASIDE * (w[1] - w[0]), 0.5 * (w[1] - w[0]));
            let there = stretch.point_and_velocity(end + inwards * aside)[0];
            ((there - stretch.point_and_velocity(end)[0]) * inwards).try_normalize()
        };
        Part { stretch, ends, directions: [direction(w[0], 1.0), direction(w[1], -1.0)] }
    };
    places.windows(2).map(part).collect()
}

/// The place of least speed between two others that are faster.
fn slowest_place(stretch: &Stretch<'_>, [mut low, mut high]: [f64; 2]) -> f64 {
    /// Golden section: each step leaves 0.618, so these leave the rounding of the parameter.
    const STEPS: usize = 80;
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let speed = |t: f64| stretch.point_and_velocity(t)[1].length_squared();
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (speed(a), speed(b));
    for _ in 0..STEPS {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = speed(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = speed(b);
        }
    }
    0.5 * (low + high)
}

/// Whether the curve stops at a place, and if so the step of the parameter beyond which it has turned.
fn stops(stretch: &Stretch<'_>, place: f64, tolerance: f64, fastest: f64) -> Option<f64> {
    const STEP: f64 = 1e-5;
    let velocity = |t: f64| stretch.point_and_velocity(t)[1];
    let speed = velocity(place).length();
    let (before, after) = ((place - STEP).max(0.0), (place + STEP).min(1.0));
    let change = (velocity(after) - velocity(before)).length() / (after - before);
    let is_still = speed <= STILL * fastest || speed * speed <= SHARP * tolerance * change;
    is_still.then(|| if speed > 0.0 && change > 0.0 { BEYOND * speed / change } else { 0.0 })
}

impl Walk for Part<'_> {
    fn ends(&self) -> [f64; 2] {
        self.ends
    }

    fn at(&self, u: f64) -> (DVec2, DVec2) {
        let [point, velocity] = self.stretch.point_and_velocity(u);
        let given = |end: usize| self.directions[end].filter(|_| u == self.ends[end]);
        (point, given(0).or(given(1)).unwrap_or_else(|| velocity.normalize_or(DVec2::X)))
    }

    fn length(&self, a: f64, b: f64) -> f64 {
        let speed = |t| self.stretch.point_and_velocity(t)[1].length();
        crate::num::quadrature::gauss(a, b, 0.1, speed).abs()
    }
}
