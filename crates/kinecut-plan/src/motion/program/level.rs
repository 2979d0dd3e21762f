//! Stretches of a run on which its feed keeps every limit: nothing has to be solved there.

use super::super::start::way_to_speed;
use super::super::{AxisLimit, Course, Shares};
use super::run::Moving;

/// Share of a limit that the feed may use on a level stretch.
const SHARE: f64 = 0.95;
/// Ways to speed that are left at both ends of a stretch for the runs beside it.
const BESIDE: f64 = 2.0;
/// Ways to speed below which a stretch is not worth an own treatment, those at its ends included.
const LEAST: f64 = 6.0;

/// Most parts of a move.
const MOST_PARTS: f64 = 1e5;

/// The stretches that are run at their feed from end to end [mm], in order. Moves are cut into parts in which the speed can
/// just change; each is looked at in the middle, at both ends and at its quarters, and at the joints and in the middle of the
/// smoothings that it has.
pub(super) fn level<const A: usize>(course: &Moving<A>, limits: &[AxisLimit; A]) -> Vec<[f64; 2]> {
    let run = course.run();
    let starts = run.starts();
    let mut found = Vec::new();
    // The level moves up to here: their first place and their feed.
    let mut open: Option<(f64, f64)> = None;
    let mut close = |open: &mut Option<(f64, f64)>, end: f64| {
        let Some((start, feed)) = open.take() else { return };
        let way = way_to(course, limits, feed, [start, end]);
        if end - start > LEAST * way {
            found.push([start + BESIDE * way, end - BESIDE * way]);
        }
    };
    let least = |of: fn(&AxisLimit) -> f64| limits.iter().map(of).fold(f64::INFINITY, f64::min);
    let (a, j) = (least(|limit| limit.acceleration), least(|limit| limit.jerk));
    for i in 0..starts.len() - 1 {
        let [from, to] = [starts[i], starts[i + 1]];
        let feed = course.feed(0.5 * (from + to));
        let at_feed = |s: f64| {
            let shares = Shares::at(course, limits, s, [feed * feed, 0.0, 0.0]);
            shares.velocity <= 1.0 + 1e-9 && shares.acceleration <= SHARE && shares.jerk <= SHARE
        };
        let inside = 1e-6 * (to - from);
        let (first, last) = (from + inside, to - inside);
        let marks = run.marks(i);
        let parts = ((last - first) / way_to_speed(feed, a, j)).ceil().clamp(1.0, MOST_PARTS) as u32;
        for part in 0..parts {
            let at = |share: f64| first + (last - first) * (f64::from(part) + share) / f64::from(parts);
            let [start, end] = [at(0.0), at(1.0)];
            let is_level = feed.is_finite()
                && [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().all(|share| at_feed(at(share)))
                && marks.into_iter().flatten().filter(|s| (start..=end).contains(s)).all(at_feed);
            let start = if part == 0 { from } else { start };
            if open.is_some_and(|(_, before)| !is_level || (before - feed).abs() > 1e-9 * feed) {
                close(&mut open, start);
            }
            if is_level {
                open.get_or_insert((start, feed));
            }
        }
    }
    close(&mut open, starts[starts.len() - 1]);
    found
}

/// Way in which the slowest axis that moves gets from rest to the feed [mm], at its steepest on a stretch.
fn way_to<const A: usize>(
    course: &Moving<A>,
    limits: &[AxisLimit; A],
    feed: f64,
    [from, to]: [f64; 2],
) -> f64 {
    const SAMPLES: usize = 8;
    let mut way = 0.0_f64;
    for i in 0..SAMPLES {
        let s = from + (to - from) * (i as f64 + 0.5) / SAMPLES as f64;
        let (mut a, mut j) = (f64::INFINITY, f64::INFINITY);
        for (q, limit) in course.derivatives(s).iter().zip(limits) {
            a = a.min(limit.acceleration / q[0].abs());
            j = j.min(limit.jerk / q[0].abs());
        }
        way = way.max(way_to_speed(feed, a, j));
    }
    way
}
