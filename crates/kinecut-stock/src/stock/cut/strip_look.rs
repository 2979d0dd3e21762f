//! Contacts of a body with the lines of a strip across the tool axis, without taking material out.
//!
//! The body is one that was made smaller by the clearance. Each of its convex parts is looked at by itself: on level
//! paths and along the axis by the section of the lowest position, on slopes by the spans of `across_slope.rs`.

use super::across::{Spans, spans};
use super::across_slope::slope_spans;
use super::body::{ConvexPart, RevolvedParts};
use super::effect::{Effects, Looked, deeper, met};
use super::strip::{Strip, View};
use super::task::reached;
use crate::stock::{fixed, unfixed};

/// Notes what a body meets on its way.
pub(super) fn look(
    strip: &mut Strip,
    view: &View,
    body: &RevolvedParts,
    looked: Looked,
    effects: &mut Effects,
) {
    let (low, high) = view.task.tip_range();
    let layers = strip.layers(view.task, low + body.bottom, high + body.top);
    let rows = strip.rows_within(view, body.radius);
    if body.parts.is_empty() || layers.0 >= layers.1 || rows.is_empty() {
        return;
    }
    for part in &body.parts {
        if view.is_level() {
            look_level(strip, view, part, rows.clone(), looked, effects);
        } else {
            look_sloping(strip, view, part, rows.clone(), looked, effects);
        }
    }
}

fn look_level(
    strip: &mut Strip,
    view: &View,
    part: &ConvexPart,
    rows: std::ops::Range<usize>,
    looked: Looked,
    effects: &mut Effects,
) {
    let task = view.task;
    let (low, high) = task.tip_range();
    let side = strip.layers(task, low + part.z1, high + part.top);
    let foot = strip.layers(task, low + part.z0, (low + part.z1).min(high + part.top));
    for row in rows {
        look_row(strip, view, part.r1, row, side, looked, effects);
        for layer in foot.0..foot.1 {
            let radius = part.radius(strip.height(layer) * task.frame.sign - low);
            look_row(strip, view, radius, row, (layer, layer + 1), looked, effects);
        }
    }
}

/// A row over layers of equal section.
fn look_row(
    strip: &mut Strip,
    view: &View,
    radius: f64,
    row: usize,
    layers: (usize, usize),
    looked: Looked,
    effects: &mut Effects,
) {
    let y = strip.row(row);
    let Some((from, to)) = view.outer(radius, y).map(|(from, to)| (fixed(from), fixed(to))) else { return };
    if layers.0 >= layers.1 || strip.void(looked, row).holds(from, to, layers) {
        return;
    }
    let (mut found, mut void): (Option<Spans>, bool) = (None, from < to);
    for layer in layers.0..layers.1 {
        let line = strip.line(row, layer);
        if met(line, from, to).0 == 0 {
            continue;
        }
        void = false;
        for span in found.get_or_insert_with(|| spans(&view.plan, radius, y)).as_slice() {
            let touch = met(line, fixed(span.lo.x), fixed(span.hi.x));
            note(view, touch, [y, strip.height(layer)], looked, effects);
        }
    }
    if void {
        strip.void(looked, row).widen(from, to, layers);
    }
}

fn look_sloping(
    strip: &Strip,
    view: &View,
    part: &ConvexPart,
    rows: std::ops::Range<usize>,
    looked: Looked,
    effects: &mut Effects,
) {
    let task = view.task;
    let (low, high) = task.tip_range();
    let (first, last) = strip.layers(task, low + part.z0, high + part.top);
    for layer in first..last {
        let height = strip.height(layer);
        let w = height * task.frame.sign;
        let most = part.radius(w - low);
        for row in rows.clone() {
            let y = strip.row(row);
            let Some((from, to)) = view.outer(most, y) else { continue };
            let line = strip.line(row, layer);
            if met(line, fixed(from), fixed(to)).0 == 0 {
                continue;
            }
            slope_spans(part, &task.piece, &view.plan, y, w, |found| {
                let touch = met(line, fixed(found.span.lo.x), fixed(found.span.hi.x));
                note(view, touch, [y, height], looked, effects);
            });
        }
    }
}

/// Notes the touch of a line at `y` and a height of the stock: its length, and from where to where.
pub(super) fn note(
    view: &View,
    (length, first, last): (i64, i32, i32),
    [y, height]: [f64; 2],
    looked: Looked,
    effects: &mut Effects,
) {
    if length == 0 {
        return;
    }
    let task = view.task;
    let local = |at: i32| view.local(unfixed(at), [y, height]);
    let effect = effects.of(task.index);
    let kept = match looked {
        Looked::Shank => &mut effect.shank,
        Looked::Holder => &mut effect.holder,
        Looked::Cutting => {
            if length <= effect.deepest && effect.first.is_some_and(|(t, _)| t <= task.piece.fractions[0]) {
                return;
            }
            effect.deepest = effect.deepest.max(length);
            for p in [local(first), local(last)] {
                let t = reached(task, p);
                if effect.first.is_none_or(|(old, _)| t < old) {
                    effect.first = Some((t, task.frame.stock(p).to_array()));
                }
            }
            return;
        }
    };
    deeper(kept, length, || task.frame.stock(local(first)).to_array());
}
