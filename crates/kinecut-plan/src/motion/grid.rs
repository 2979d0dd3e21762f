//! Knots of a time law: close together at stops and where the shape of the path changes.

use super::start::Start;
use super::{AxisLimit, Course, End};
use crate::base::{Code, Finding, Result};

/// Length of a cell over its distance from the nearest stop or knot.
const GRADE: f64 = 0.045;
/// The same beyond the way in which the speed can change.
const FAR_GRADE: f64 = 0.1;
/// Turn of the path in a cell [rad].
const TURN: f64 = 0.018;
/// Length of the cells at a knot over the way to the nearest knot beside it.
const FEATURE: f64 = 0.25;
/// Growth of cells away from a knot.
const FEATURE_GRADE: f64 = 0.1;
/// Length of the cell at rest over that of the path, at most.
const REST_SHARE: f64 = 0.01;
/// Least length of the cell at rest over that of the path: far above the rounding of a place on it.
const REST_LEAST: f64 = 1e-10;
/// Fewest cells.
const FEWEST: usize = 8;
/// Most cells of one course: a gigabyte and a half.
const MOST: usize = 2_000_000;

/// Knots, from the end of the cell in which the path leaves its rest to the start of that in which it comes to rest; at even
/// ends from the start or to the end of the path.
///
/// # Errors
/// `KC0404` for a path that turns so fast that it asks for millions of cells.
pub(super) fn knots<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    start: Start,
    ends: [End; 2],
) -> Result<Vec<f64>> {
    let length = course.length();
    let rest = start.rest.clamp(REST_LEAST * length, REST_SHARE * length);
    // Features that are closer together than the speed can follow count as one.
    let mut features: Vec<f64> = Vec::with_capacity(course.knots().len());
    for place in course.knots() {
        if *place - features.last().unwrap_or(&rest) > rest && length - rest - place > rest {
            features.push(*place);
        }
    }
    let most = length / FEWEST as f64;
    // Ways between features, those at the ends included.
    let gap = |i: usize| {
        let place = |i: usize| match i {
            0 => 0.0,
            i if i > features.len() => length,
            i => features[i - 1],
        };
        place(i + 1) - place(i)
    };
    let rests = ends.map(|end| if end == End::Rest { rest } else { 0.0 });
    let last = length - rests[1];
    let mut knots = vec![rests[0]];
    let mut s = rests[0];
    let mut next = 0;
    while s < last {
        while next < features.len() && features[next] <= s * (1.0 + 1e-12) {
            next += 1;
        }
        let jets = course.derivatives(s + 1e-7 * rest);
        // The shape changes little in a cell, in lengths and in units of each kind of limit.
        let weights: [fn(&AxisLimit) -> f64; 4] = [|_| 1.0, |l| l.velocity, |l| l.acceleration, |l| l.jerk];
        let mut h = most.min(course.finest(s));
        for weight in weights {
            let size = |d: usize| {
                jets.iter().zip(limits).map(|(j, l)| (j[d] / weight(l)).powi(2)).sum::<f64>().sqrt()
            };
            h = h.min(TURN * size(0) / size(1)).min((TURN * size(0) / size(2)).sqrt());
        }
        let stops = [(s, ends[0]), (length - s, ends[1])];
        for (distance, _) in stops.into_iter().filter(|(_, end)| *end == End::Rest) {
            let near = distance.min(4.0 * start.way);
            h = h.min(GRADE * near + FAR_GRADE * (distance - near));
        }
        for i in [next.wrapping_sub(1), next] {
            if let Some(place) = features.get(i) {
                h = h.min(FEATURE * gap(i).min(gap(i + 1)) + FEATURE_GRADE * (s - place).abs());
            }
        }
        let h = h.max(0.5 * rest);
        let end = features.get(next).copied().unwrap_or(f64::INFINITY);
        s = if s + 1.5 * h > end { end } else { s + h };
        knots.push(s);
        if knots.len() > MOST {
            let what = "the path turns so fast that its time law asks for too many cells";
            return Err(Finding::error(Code::PLAN_VALUE, what)
                .value(knots.len() as f64, "cells")
                .bound(MOST as f64, "cells")
                .into());
        }
    }
    // The last one lies where the cell at rest begins.
    while knots.last().is_some_and(|k| *k > last - 0.25 * rest) {
        knots.pop();
    }
    knots.push(last);
    Ok(knots)
}
