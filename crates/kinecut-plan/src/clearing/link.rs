//! Ways from the end of one pass to the beginning of the next, through what is cleared.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use crate::geom::OutlineEdge;
use crate::num::angle::wrap_positive;

/// A place with the direction of travel [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) at: DVec2,
    pub(super) heading: f64,
}

/// The ways between two poses of an arc, a line that is tangent to it, and another arc, all of one radius [mm]: four at most,
/// the shortest first.
///
/// Source: L. E. Dubins, "On curves of minimal length with a constraint on average curvature", 1957; the words with a line.
pub(super) fn ways(from: Pose, to: Pose, radius: f64) -> Vec<Vec<OutlineEdge>> {
    let mut found: Vec<(f64, Vec<OutlineEdge>)> = Vec::with_capacity(4);
    for first in [1.0, -1.0] {
        for last in [1.0, -1.0] {
            if let Some(way) = way(from, to, radius, [first, last]) {
                found.push((way.iter().map(OutlineEdge::length).sum(), way));
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, way)| way).collect()
}

/// One of them, by the sides to which its arcs turn: 1 is left.
fn way(from: Pose, to: Pose, radius: f64, [first, last]: [f64; 2]) -> Option<Vec<OutlineEdge>> {
    let centre =
        |pose: Pose, side: f64| pose.at + radius * DVec2::from_angle(pose.heading + side * FRAC_PI_2);
    let (c0, c1) = (centre(from, first), centre(to, last));
    let between = c1 - c0;
    let d = between.length();
    // The line is parallel to that between the centres, or crosses it.
    let across = 0.5 * (first - last) * 2.0 * radius;
    if d < across.abs() || d == 0.0 && first == last {
        return None;
    }
    let along = between.to_angle() + (across / d).clamp(-1.0, 1.0).asin();
    let mut edges = Vec::with_capacity(3);
    let mut turn = |centre: DVec2, side: f64, from: f64, to: f64, ends: [Option<DVec2>; 2]| {
        let sweep = side * wrap_positive(side * (to - from));
        // A turn of nothing may come out as a full one.
        if sweep.abs() < 1e-9 || sweep.abs() > TAU - 1e-9 {
            return;
        }
        let arc = OutlineEdge::arc(centre, radius, from - side * FRAC_PI_2, sweep);
        edges.push(OutlineEdge {
            start: ends[0].unwrap_or(arc.start),
            end: ends[1].unwrap_or(arc.end),
            ..arc
        });
    };
    turn(c0, first, from.heading, along, [Some(from.at), None]);
    turn(c1, last, along, to.heading, [None, Some(to.at)]);
    let leaves = c0 + radius * DVec2::from_angle(along - first * FRAC_PI_2);
    let joins = c1 + radius * DVec2::from_angle(along - last * FRAC_PI_2);
    let line = OutlineEdge::line(leaves, joins);
    if line.length() > 1e-9 {
        let place = usize::from(edges.first().is_some_and(|e| e.start == from.at));
        edges.insert(place, line);
    }
    Some(edges)
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn ways_are_tangent_and_join_their_ends() {
        let mut count = 0;
        for k in 0..200 {
            let v = f64::from(k);
            let from = Pose { at: dvec2(v.sin() * 10.0, v.cos() * 7.0), heading: 2.3 * v };
            let to = Pose { at: dvec2((1.7 * v).cos() * 9.0, (2.9 * v).sin() * 12.0), heading: -1.1 * v };
            for way in ways(from, to, 2.5) {
                count += 1;
                let last = way[way.len() - 1];
                assert!(way[0].start.distance(from.at) < 1e-9 && last.end.distance(to.at) < 1e-9);
                assert!(crate::num::angle::wrap(way[0].heading(0.0) - from.heading).abs() < 1e-6);
                assert!(crate::num::angle::wrap(last.heading(1.0) - to.heading).abs() < 1e-6);
                for pair in way.windows(2) {
                    assert!(pair[0].end.distance(pair[1].start) < 1e-9);
                    let turn = crate::num::angle::wrap(pair[0].heading(1.0) - pair[1].heading(0.0));
                    assert!(turn.abs() < 1e-6, "{k} {turn}");
                }
            }
        }
        assert!(count > 500, "{count}");
    }
}
