//! The start of a path from rest.

use super::{AxisLimit, Course};

/// Ways in which a path gets going, the shortest of some places.
#[derive(Clone, Copy)]
pub(super) struct Start {
    /// From rest to the feed [mm].
    pub(super) way: f64,
    /// Part of it that the cell at rest may have, in which the jerk is constant [mm].
    pub(super) rest: f64,
}

/// Length of the cell at rest over the way to the feed, where jerk alone limits it.
const REST: f64 = 2e-4;
/// The same where jerk hardly does: a cell of constant jerk is slower there by the root of its length.
const REST_LEAST: f64 = 8e-8;
/// The same over the way in which jerk brings the path to its acceleration.
const OF_JERK: f64 = 0.2;

impl Start {
    pub(super) fn of<const A: usize, C: Course<A>>(course: &C, limits: &[AxisLimit; A]) -> Start {
        const SAMPLES: usize = 64;
        let length = course.length();
        let mut start = Start { way: f64::INFINITY, rest: f64::INFINITY };
        for i in 0..SAMPLES {
            let s = length * (i as f64 + 0.5) / SAMPLES as f64;
            let jets = course.derivatives(s);
            let path = |limit: fn(&AxisLimit) -> f64| {
                let along = jets.iter().zip(limits).map(|(q, l)| limit(l) / q[0].abs().max(1e-12));
                along.fold(f64::INFINITY, f64::min)
            };
            let (a, j) = (path(|l| l.acceleration), path(|l| l.jerk));
            let v = path(|l| l.velocity).min(course.feed(s));
            let way = way_to_speed(v, a, j);
            start.way = start.way.min(way);
            let of_jerk = OF_JERK * a * a * a / (6.0 * j * j);
            start.rest = start.rest.min((REST * way).min(of_jerk.max(REST_LEAST * way)));
        }
        start
    }
}

/// Way in which a straight path gets from rest to a speed, or from the speed to rest [mm].
pub(super) fn way_to_speed(v: f64, a: f64, j: f64) -> f64 {
    if v * j < a * a { v * (v / j).sqrt() } else { 0.5 * v * (v / a + a / j) }
}
