//! Meetings of two edges of an outline.
//!
//! Two edges have a point in common when an end of one lies on the other, or when their insides cross or are tangent:
//! line and line by the signs of four triangles, line and circle by one square root, circle and circle by their common
//! chord. Edges that overlap (collinear, or on one circle) always have an end of one on the other, so that overlaps
//! need no case of their own.
//!
//! Neighbours in a loop share a vertex; only points away from it count. Circles that are tangent there but for
//! rounding meet a second time very near: a lens between vertex and second meeting that is thinner than the tolerance is
//! rounding, a thicker one is a crossing. A corner of no angle (a cusp between arcs of different curvature) is allowed,
//! an edge that doubles back on its neighbour is not: its far end lies on the other.

use glam::DVec2;

use super::{OutlineEdge, Turn};

/// Vertices that two edges share by their place in a loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shared {
    /// The end of the first is the start of the second.
    pub(super) end_to_start: bool,
    /// The start of the first is the end of the second.
    pub(super) start_to_end: bool,
}

/// A point that two edges have in common besides the vertices they share, if any; ends within `tolerance` [mm] of the
/// other edge count.
pub(super) fn contact(e: &OutlineEdge, f: &OutlineEdge, shared: Shared, tolerance: f64) -> Option<DVec2> {
    let ends = [
        (e.start, f, shared.start_to_end),
        (e.end, f, shared.end_to_start),
        (f.start, e, shared.end_to_start),
        (f.end, e, shared.start_to_end),
    ];
    for (end, other, is_shared) in ends {
        if !is_shared && distance(other, end) <= tolerance {
            return Some(end);
        }
    }
    // The lens between circles that meet twice at a distance d is at most this times d^2 / 8 wide.
    let lens = curvature(e) + curvature(f);
    let (points, count) = crossings(e, f, tolerance);
    points[..count].iter().copied().find(|p| {
        let beside = |vertex: DVec2| {
            let away = p.distance(vertex);
            away > tolerance && away * away * lens > 8.0 * tolerance
        };
        (!shared.end_to_start || beside(e.end)) && (!shared.start_to_end || beside(e.start))
    })
}

/// All points that two edges have in common: where they cross or are tangent inside, and ends of one within `tolerance`
/// [mm] of the other; where they overlap, the ends of the overlap. Some may come twice.
pub fn meetings(e: &OutlineEdge, f: &OutlineEdge, tolerance: f64) -> Vec<DVec2> {
    let on = |end: DVec2, other: &OutlineEdge| (distance(other, end) <= tolerance).then_some(end);
    let ends = [on(e.start, f), on(e.end, f), on(f.start, e), on(f.end, e)];
    let (points, count) = crossings(e, f, tolerance);
    ends.into_iter().flatten().chain(points[..count].iter().copied()).collect()
}

/// Distance of a point from an edge [mm].
pub(super) fn distance(edge: &OutlineEdge, p: DVec2) -> f64 {
    if let Some(t) = edge.turn {
        let out = p - t.centre;
        if edge.passes(out.y.atan2(out.x)) {
            return (out.length() - t.radius).abs();
        }
        let [a, b] = [p.distance(edge.start), p.distance(edge.end)];
        return if a < b { a } else { b };
    }
    let along = edge.end - edge.start;
    let s = (p - edge.start).dot(along) / along.length_squared();
    p.distance(edge.start + s.clamp(0.0, 1.0) * along)
}

/// Curvature of an edge, never negative [1/mm].
fn curvature(edge: &OutlineEdge) -> f64 {
    edge.turn.map_or(0.0, |t| 1.0 / t.radius)
}

/// Points inside both edges where they cross or are tangent, and how many.
fn crossings(e: &OutlineEdge, f: &OutlineEdge, tolerance: f64) -> ([DVec2; 2], usize) {
    match (e.turn, f.turn) {
        (None, None) => lines(e, f),
        (None, Some(t)) => line_and_arc(e, f, t, tolerance),
        (Some(t), None) => line_and_arc(f, e, t, tolerance),
        (Some(t), Some(u)) => arcs(e, t, f, u, tolerance),
    }
}

fn lines(e: &OutlineEdge, f: &OutlineEdge) -> ([DVec2; 2], usize) {
    let (u, v) = (e.end - e.start, f.end - f.start);
    let across = u.perp_dot(v);
    let between = f.start - e.start;
    let (s, t) = (between.perp_dot(v) / across, between.perp_dot(u) / across);
    // Parallel lines divide by zero: nothing then lies in between.
    let inside = s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0;
    ([e.start + s * u; 2], usize::from(inside))
}

fn line_and_arc(line: &OutlineEdge, arc: &OutlineEdge, t: Turn, tolerance: f64) -> ([DVec2; 2], usize) {
    let along = line.end - line.start;
    let length = along.length();
    let unit = along / length;
    let to_centre = t.centre - line.start;
    let (foot, aside) = (unit.dot(to_centre), unit.perp_dot(to_centre));
    if !(aside.abs() <= t.radius + tolerance) {
        return ([DVec2::ZERO; 2], 0);
    }
    let half = ((t.radius - aside.abs()) * (t.radius + aside.abs())).max(0.0).sqrt();
    let on_line = |s: f64| (s > 0.0 && s < length).then(|| line.start + s * unit);
    keep([foot - half, foot + half].map(on_line), |p| on_arc(arc, t, p))
}

fn arcs(e: &OutlineEdge, t: Turn, f: &OutlineEdge, u: Turn, tolerance: f64) -> ([DVec2; 2], usize) {
    if t.radius > u.radius {
        // From the smaller circle the common chord is known to the rounding of the larger radius, not to its root.
        return arcs(f, u, e, t, tolerance);
    }
    let between = u.centre - t.centre;
    let apart = between.length();
    let near = apart >= (t.radius - u.radius).abs() - tolerance && apart <= t.radius + u.radius + tolerance;
    if !near || apart == 0.0 {
        return ([DVec2::ZERO; 2], 0);
    }
    let unit = between / apart;
    // Distance of the common chord from the first centre.
    let foot = 0.5 * (apart + (t.radius - u.radius) / apart * (t.radius + u.radius));
    let half = ((t.radius - foot) * (t.radius + foot)).max(0.0).sqrt();
    let at = |h: f64| Some(t.centre + foot * unit + h * unit.perp());
    keep([at(-half), at(half)], |p| on_arc(e, t, p) && on_arc(f, u, p))
}

fn on_arc(arc: &OutlineEdge, t: Turn, p: DVec2) -> bool {
    let out = p - t.centre;
    arc.passes(out.y.atan2(out.x))
}

fn keep(found: [Option<DVec2>; 2], sound: impl Fn(DVec2) -> bool) -> ([DVec2; 2], usize) {
    let mut points = [DVec2::ZERO; 2];
    let mut count = 0;
    for p in found.into_iter().flatten().filter(|&p| sound(p)) {
        points[count] = p;
        count += 1;
    }
    (points, count)
}
