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

/// The stretches that are run at their feed from end to end [mm], in order. Looked at in the middle, at both ends and at the
/// quarters of each move, at its joints and in the middle of their smoothings.
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
    for i in 0..starts.len() - 1 {
        let [from, to] = [starts[i], starts[i + 1]];
        let feed = course.feed(0.5 * (from + to));
        let at_feed = |s: f64| {
            let shares = Shares::at(course, limits, s, [feed * feed, 0.0, 0.0]);
            shares.velocity <= 1.0 + 1e-9 && shares.acceleration <= SHARE && shares.jerk <= SHARE
        };
        let inside = 1e-6 * (to - from);
        let is_level = feed.is_finite()
            && [
                from + inside,
                0.75 * from + 0.25 * to,
                0.5 * (from + to),
                0.25 * from + 0.75 * to,
                to - inside,
            ]
            .into_iter()
            .all(at_feed)
            && run.marks(i).into_iter().flatten().all(at_feed);
        if open.is_some_and(|(_, before)| !is_level || (before - feed).abs() > 1e-9 * feed) {
            close(&mut open, from);
        }
        if is_level {
            open.get_or_insert((from, feed));
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
