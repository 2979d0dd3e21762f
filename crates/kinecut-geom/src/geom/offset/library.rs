//! Offsets by `cavalier_contours`: loops of vertices with bulges, the face on their left.

use std::f64::consts::PI;
use std::panic::{AssertUnwindSafe, catch_unwind};

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use glam::DVec2;

use crate::geom::{Outline, OutlineEdge, Turn};

/// Distance of two points that are one [mm].
const SAME: f64 = 1e-9;

/// The loops, the face on their right; `None` where the library panics.
pub(super) fn loops(outline: &Outline, distance: f64) -> Option<Vec<Vec<OutlineEdge>>> {
    let (polylines, cuts) = polylines(outline);
    // Finer than usual: short edges that turn little meet in points that the usual ones take for one.
    let options = ShapeOffsetOptions { pos_equal_eps: 1e-8, offset_dist_eps: 1e-7, slice_join_eps: 1e-6 };
    let offset = || {
        let shape = Shape::from_plines(polylines).parallel_offset(distance, &options);
        let plines = shape.ccw_plines.iter().chain(&shape.cw_plines);
        plines.map(|p| edges(&p.polyline, &cuts)).collect::<Vec<_>>()
    };
    catch_unwind(AssertUnwindSafe(offset)).ok()
}

/// The outline as the library has it, and the places at which arcs beyond a half circle were cut for it.
fn polylines(outline: &Outline) -> (Vec<Polyline>, Vec<Cut>) {
    let mut cuts = Vec::new();
    let mut one = |edges: &[OutlineEdge]| {
        let mut polyline = Polyline::new_closed();
        for edge in edges.iter().rev().map(OutlineEdge::reversed) {
            let Some(t) = edge.turn else {
                polyline.add(edge.start.x, edge.start.y, 0.0);
                continue;
            };
            let halves = if t.sweep.abs() > PI * (1.0 + 1e-12) { 2 } else { 1 };
            let bulge = (t.sweep / f64::from(4 * halves)).tan();
            polyline.add(edge.start.x, edge.start.y, bulge);
            if halves == 2 {
                let middle = edge.at(0.5);
                cuts.push(Cut { centre: t.centre, towards: (middle - t.centre).normalize_or_zero() });
                polyline.add(middle.x, middle.y, bulge);
            }
        }
        polyline
    };
    let polylines = outline.loops().iter().map(|l| one(&outline.edges()[l.edges.clone()])).collect();
    (polylines, cuts)
}

/// A place on a circle at which it was cut.
struct Cut {
    centre: DVec2,
    towards: DVec2,
}

impl Cut {
    fn is_between(&self, arc: Turn, joint: DVec2) -> bool {
        let out = joint - arc.centre;
        arc.centre.distance(self.centre) < SAME
            && (out.perp_dot(self.towards)).abs() < SAME
            && out.dot(self.towards) > 0.0
    }
}

/// A loop of the library as edges, travelled the other way; arcs that were cut for the library are one again.
fn edges(polyline: &Polyline, cuts: &[Cut]) -> Vec<OutlineEdge> {
    let count = polyline.vertex_count();
    let vertex = |i: usize| {
        let v = polyline.at(i % count);
        (DVec2::new(v.x, v.y), v.bulge)
    };
    let mut edges: Vec<OutlineEdge> = Vec::with_capacity(count);
    for i in (0..count).rev() {
        let ((start, bulge), (end, _)) = (vertex(i), vertex(i + 1));
        if start == end {
            continue;
        }
        let edge = OutlineEdge::bulge(start, end, bulge).reversed();
        let joined = edges.last().and_then(|last| join(last, &edge, cuts));
        match (joined, edges.last_mut()) {
            (Some(joined), Some(last)) => *last = joined,
            _ => edges.push(edge),
        }
    }
    if let [first, .., last] = &edges[..]
        && let Some(joined) = join(last, first, cuts)
    {
        edges[0] = joined;
        edges.pop();
    }
    edges
}

/// Two arcs that were one before they were cut.
fn join(a: &OutlineEdge, b: &OutlineEdge, cuts: &[Cut]) -> Option<OutlineEdge> {
    let (s, t) = (a.turn?, b.turn?);
    let one =
        s.centre.distance(t.centre) < SAME && (s.radius - t.radius).abs() < SAME && s.sweep * t.sweep > 0.0;
    let cut = one && cuts.iter().any(|cut| cut.is_between(s, a.end));
    let sweep = s.sweep + t.sweep;
    cut.then_some(OutlineEdge { start: a.start, end: b.end, turn: Some(Turn { sweep, ..s }), label: 0 })
}
