//! Arcs through three points.

use std::f64::consts::TAU;

use glam::DVec2;

use super::{OutlineEdge, Turn};

/// Sagitta per chord below which an arc is straight: its radius would be known to fewer digits than its ends.
pub(super) const FLAT: f64 = 1e-8;

/// The arc from `start` over `middle` to `end`; a line where the three lie on one.
pub(super) fn arc_through(start: DVec2, middle: DVec2, end: DVec2) -> OutlineEdge {
    let (p, q) = (start - middle, end - middle);
    let across = p.perp_dot(q);
    // The angle at the middle of an arc is pi less half the sweep.
    let sweep = 2.0 * (-p).perp_dot(q).atan2((-p).dot(q));
    let centre = middle
        + DVec2::new(
            p.length_squared() * q.y - q.length_squared() * p.y,
            q.length_squared() * p.x - p.length_squared() * q.x,
        ) / (2.0 * across);
    let flat = across.abs() <= FLAT * start.distance_squared(end) && sweep.abs() < 1.0;
    if flat || !centre.is_finite() {
        return OutlineEdge::line(start, end);
    }
    let out = start - centre;
    let turn = Turn { centre, radius: out.length(), from: out.y.atan2(out.x), sweep: sweep.clamp(-TAU, TAU) };
    OutlineEdge { start, end, turn: Some(turn), label: 0 }
}

/// The edge with its ends moved: a line between them, an arc through its own middle.
pub(super) fn with_ends(edge: &OutlineEdge, start: DVec2, end: DVec2) -> OutlineEdge {
    if (edge.start, edge.end) == (start, end) {
        return *edge;
    }
    let moved = match edge.turn {
        None => OutlineEdge::line(start, end),
        Some(_) => arc_through(start, edge.at(0.5), end),
    };
    moved.labelled(edge.label)
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn an_arc_through_three_of_its_points_is_itself() {
        for sweep in [0.01, 1.0, 3.0, 4.0, 6.2, -0.2, -3.3, -6.0] {
            let arc = OutlineEdge::arc(dvec2(3.0, -2.0), 7.0, 0.4, sweep);
            let again = arc_through(arc.start, arc.at(0.5), arc.end).turn.unwrap();
            assert!((again.sweep - sweep).abs() < 1e-10, "{sweep}");
            assert!(again.centre.distance(dvec2(3.0, -2.0)) < 1e-9 && (again.radius - 7.0).abs() < 1e-9);
        }
        assert_eq!(arc_through(DVec2::ZERO, dvec2(1.0, 0.0), dvec2(2.0, 0.0)).turn, None);
    }
}
