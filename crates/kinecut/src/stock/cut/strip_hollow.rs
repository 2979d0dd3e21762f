//! A tool with a hollow edge that moves along its axis, against the lines of a strip across that axis: at each height
//! the rings of the section of its lowest position.

use glam::{DVec2, DVec3};

use super::effect::met;
use super::hollow::{Border, Hollow, Ring};
use super::strip::{Strip, View};
use crate::stock::fixed;

/// Cuts the rows of a strip for a tool that stands over `centre`, seen along the lines.
pub(super) fn cut_rows(
    strip: &mut Strip,
    view: &View,
    hollow: &Hollow,
    centre: DVec2,
    rows: std::ops::Range<usize>,
) {
    let task = view.task;
    let (low, high) = task.tip_range();
    let (first, last) = strip.layers(task, low, high + hollow.top);
    let mut rings: Vec<Ring> = Vec::new();
    for layer in first..last {
        let h = strip.height(layer) * task.frame.sign - low;
        hollow.rings(h, task.piece.lowest(), &mut rings);
        for row in rows.clone() {
            for ring in &rings {
                cut_ring(strip, view, ring, centre, row, layer);
            }
        }
    }
}

/// Takes a ring out of one line.
fn cut_ring(strip: &mut Strip, view: &View, ring: &Ring, centre: DVec2, row: usize, layer: usize) {
    let d = strip.row(row) - centre.y;
    let half = |r: f64| ((r - d) * (r + d)).sqrt();
    let outer = half(ring.outer.r);
    // NaN when the line passes by.
    if !(outer > 0.0) {
        return;
    }
    let end = |border: &Border, x: f64, at: i32| {
        let e = DVec2::new(x, d) / border.r;
        let (radial, axial) = border.normal;
        view.end(at, DVec3::new(radial * e.x, radial * e.y, axial), border.face, border.segment)
    };
    let mut take = |lo: (&Border, f64), hi: (&Border, f64)| {
        let (from, to) = (fixed(centre.x + lo.1), fixed(centre.x + hi.1));
        let (tile, line) = strip.place(row, layer);
        if met(strip.tiles[tile].line(line), from, to).0 > 0 {
            let ends = [end(lo.0, lo.1, from), end(hi.0, hi.1, to)];
            strip.tiles[tile].subtract(line, ends[0], ends[1]);
        }
    };
    let inner = half(ring.inner.r);
    if inner > 0.0 {
        take((&ring.outer, -outer), (&ring.inner, -inner));
        take((&ring.inner, inner), (&ring.outer, outer));
    } else {
        take((&ring.outer, -outer), (&ring.outer, outer));
    }
}
