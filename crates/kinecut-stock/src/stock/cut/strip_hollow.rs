//! A tool with a hollow edge that moves along its axis, against the lines of a strip across that axis: at each height
//! the rings of the section of its lowest position.

use glam::{DVec2, DVec3};

use super::effect::{Effects, Looked, deeper, met};
use super::hollow::{Border, Hollow, Ring};
use super::strip::{Strip, View};
use super::strip_look::note;
use crate::stock::{fixed, unfixed};

/// Takes a tool over `centre`, seen along the lines, past the rows of a strip: material that it meets is noted where
/// that is asked for, then it is cut.
pub(super) fn pass_rows(
    strip: &mut Strip,
    view: &View,
    hollow: &Hollow,
    centre: DVec2,
    rows: std::ops::Range<usize>,
    effects: &mut Effects,
) {
    if view.task.watch {
        look_rows(strip, view, hollow, centre, rows.clone(), effects);
    }
    core(strip, view, hollow, centre, rows.clone(), effects);
    if view.task.removes {
        cut_rows(strip, view, hollow, centre, rows);
    }
}

fn cut_rows(strip: &mut Strip, view: &View, hollow: &Hollow, centre: DVec2, rows: std::ops::Range<usize>) {
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

/// Notes what the edge, made smaller by the clearance along the axis and across it, meets.
fn look_rows(
    strip: &Strip,
    view: &View,
    hollow: &Hollow,
    centre: DVec2,
    rows: std::ops::Range<usize>,
    effects: &mut Effects,
) {
    let task = view.task;
    let ((low, high), slack) = (task.tip_range(), task.clearance);
    let (first, last) = strip.layers(task, low + slack, high + hollow.top - slack);
    let mut rings: Vec<Ring> = Vec::new();
    for layer in first..last {
        let height = strip.height(layer);
        hollow.rings(height * task.frame.sign - low - slack, task.piece.lowest(), &mut rings);
        for row in rows.clone() {
            let d = strip.row(row) - centre.y;
            let half = |r: f64| ((r - d) * (r + d)).sqrt();
            for ring in &rings {
                let outer = half(ring.outer.r - slack);
                // NaN when the line passes by.
                if !(outer > 0.0) {
                    continue;
                }
                let inner = if ring.inner.r > 0.0 { half(ring.inner.r + slack) } else { 0.0 };
                let inner = if inner > 0.0 { inner } else { 0.0 };
                for (from, to) in [(-outer, -inner), (inner, outer)] {
                    let touch = met(strip.line(row, layer), fixed(centre.x + from), fixed(centre.x + to));
                    note(view, touch, [strip.row(row), height], Looked::Cutting, effects);
                }
            }
        }
    }
}

/// Notes material within the tool.
fn core(
    strip: &Strip,
    view: &View,
    hollow: &Hollow,
    centre: DVec2,
    rows: std::ops::Range<usize>,
    effects: &mut Effects,
) {
    let task = view.task;
    let ((low, high), slack) = (task.tip_range(), task.clearance);
    let inner = hollow.inner() - slack;
    if inner <= 0.0 {
        return;
    }
    let (first, last) = strip.layers(task, low + slack, high + hollow.top - slack);
    for (row, layer) in rows.flat_map(|row| (first..last).map(move |layer| (row, layer))) {
        let (y, height) = (strip.row(row), strip.height(layer));
        let half = ((inner - (y - centre.y)) * (inner + (y - centre.y))).sqrt();
        // NaN when the line passes by.
        if half > 0.0 {
            let (length, x, _) = met(strip.line(row, layer), fixed(centre.x - half), fixed(centre.x + half));
            if length > 0 {
                let w = height * task.frame.sign;
                let x = unfixed(x);
                let p = if view.mirrored { DVec3::new(y, x, w) } else { DVec3::new(x, y, w) };
                deeper(&mut effects.of(task.index).core, length, || task.frame.stock(p).to_array());
            }
        }
    }
}
