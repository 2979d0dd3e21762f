//! Edges of material that a body may clip between the lines.
//!
//! Material that the lines miss is narrower than 1.42 steps and lower than a step (see the head of [`super`]). It lies
//! at an edge of the material, and the edge is seen all the same:
//!
//! - **from above**: a line along the tool axis is no more than the diagonal of four lines away from a place where its
//!   material, continued by the slope of its end, reaches into the body; above the underside by less than a step;
//! - **from the side**: the body, lowered by a step, meets a line across its axis: the wall below the edge reaches into
//!   it. The end of an overhanging wall is continued up to the body.
//!
//! Both together are an edge that may be clipped, by about as much as the wall reaches in. A wall thinner than 1.42
//! steps may lie between the lines along the axis: it counts when it is met from the side alone. A spike that is thin
//! in both directions is left out. Shank and holder are lowered into what their own edges have cut: they are looked at
//! from the side after the cut, also where the tool rises.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use glam::DVec2;

use super::across::spans;
use super::across_slope::slope_spans;
use super::axial::{Hit, hits};
use super::body::{ConvexPart, RevolvedParts};
use super::effect::{Effects, Looked, met, near};
use super::strip::{Strip, View};
use super::task::{LEAST, Task};
use crate::geom::Aabb;
use crate::stock::raw::class;
use crate::stock::tile::Tile;
use crate::stock::{EndPoint, Interval, fixed, unfixed};

/// A slope is followed up to this rise from an end: beyond it the end is one of a wall, or of a floor, that other lines
/// see.
const STEEPEST: f64 = 1.5;

/// Slopes below this count as level: over a step they make no difference.
const FLAT: f64 = 0.1;

/// Largest distance below a body at which an edge may end that slopes up to it [mm].
pub(super) fn most_below(step: f64) -> f64 {
    SQRT_2 * step * STEEPEST
}

/// Notes a line along the tool axis if its material, continued near the line by the slope of its end, reaches into a
/// body; `wide` is the body made wider by [`beside`].
pub(super) fn from_above(
    tile: &Tile,
    l: usize,
    over: DVec2,
    task: &Task,
    (body, wide, looked): (&RevolvedParts, &RevolvedParts, Looked),
    effects: &mut Effects,
) {
    let step = i64::from(fixed(task.step));
    for (part, wide) in body.parts.iter().zip(&wide.parts) {
        hits(wide, &task.piece, over, |hit| {
            let (lo, hi) = task.along(hit.lo, hit.hi);
            let plain = met(tile.line(l), lo, hi).0;
            // A higher edge is seen from the side.
            if plain > step {
                return;
            }
            let clipped = |i: &Interval| {
                let found = Material::of(task, i);
                found.may_reach(task, &hit)
                    && ways(task, part, over).any(|way| found.reaches(task, part, over, way))
            };
            if tile.line(l).iter().any(clipped) {
                let point = task.frame.stock(over.extend(hit.lo));
                let seen = (plain.max(1), point.to_array(), Aabb::of_points([point]));
                near(&mut effects.of(task.index).edges[looked as usize], seen);
            }
        });
    }
}

/// An interval in the tool frame.
struct Material {
    /// Heights of its ends [mm].
    low: f64,
    high: f64,
    /// Rise of the upper end across the tool axis [mm per mm].
    slope: DVec2,
}

impl Material {
    fn of(task: &Task, i: &Interval) -> Material {
        let sign = task.frame.sign;
        let (low, high) = if sign > 0.0 { (i.lo, i.hi) } else { (i.hi, i.lo) };
        let normal = high.normal.normal();
        let [u, v, w] = task.frame.axes.map(|axis| normal[axis.index()]);
        let across = DVec2::new(u, v);
        let slope = -across.normalize_or_zero() * followed(across.length(), w.abs());
        Material { low: sign * unfixed(low.at), high: sign * unfixed(high.at), slope }
    }

    /// True if it may reach into a hit, its end rising to the highest that it can near the line.
    fn may_reach(&self, task: &Task, hit: &Hit) -> bool {
        self.low < hit.hi && self.high + self.slope.length() * SQRT_2 * task.step > hit.lo
    }

    /// True if it reaches into a part, continued along a way from its line.
    fn reaches(&self, task: &Task, part: &ConvexPart, over: DVec2, way: DVec2) -> bool {
        let mut found = false;
        hits(part, &task.piece, over + way, |hit| {
            found |= self.low < hit.hi && self.high + self.slope.dot(way) > hit.lo;
        });
        found
    }
}

/// Ways from a line to places up to [`beside`] from it, and to the border of a part that it lies outside.
fn ways(task: &Task, part: &ConvexPart, over: DVec2) -> impl Iterator<Item = DVec2> {
    const C: f64 = FRAC_1_SQRT_2;
    const AROUND: [[f64; 2]; 8] =
        [[1.0, 0.0], [C, C], [0.0, 1.0], [-C, C], [-1.0, 0.0], [-C, -C], [0.0, -1.0], [C, -C]];
    const ALONG: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
    let by = SQRT_2 * task.step;
    let round = ALONG.iter().flat_map(move |far| AROUND.map(|way| DVec2::from_array(way) * by * *far));
    let foot = task.piece.plan.point(task.piece.plan.nearest(over));
    let out = foot.distance(over) - part.r1;
    let inwards = (out > 0.0).then(|| (foot - over).normalize_or_zero() * (out + 0.5 * LEAST));
    inwards.into_iter().chain(round)
}

/// The components of a surface's normal along an axis and across it.
fn normal(end: &EndPoint, up: usize) -> [f64; 2] {
    let n = end.normal.normal();
    [n[up], n[(up + 1) % 3].hypot(n[(up + 2) % 3])]
}

/// The part of a slope a / b that is followed: up to the steepest, and 0 when it is flat.
fn followed(a: f64, b: f64) -> f64 {
    if a < FLAT * b {
        0.0
    } else if a < STEEPEST * b {
        a / b
    } else {
        STEEPEST
    }
}

/// Notes what a body lowered by a step meets on the lines of a strip.
pub(super) fn from_beside(
    strip: &Strip,
    view: &View,
    body: &RevolvedParts,
    looked: Looked,
    effects: &mut Effects,
) {
    let rows = strip.rows_within(view, body.radius);
    if rows.is_empty() || view.task.tool.edges.is_none() {
        return;
    }
    for part in &body.parts {
        let task = view.task;
        let (low, high) = task.tip_range();
        // On a level path the sections above the foot are those of the body itself.
        let top = if view.is_level() { low + part.z1 } else { high + part.top - task.step };
        let (first, last) = strip.layers(task, low + part.z0 - task.step, top);
        for layer in first..last {
            for row in rows.clone() {
                lowered(strip, view, part, [row, layer], looked, effects);
            }
        }
    }
}

fn lowered(
    strip: &Strip,
    view: &View,
    part: &ConvexPart,
    [row, layer]: [usize; 2],
    looked: Looked,
    effects: &mut Effects,
) {
    let task = view.task;
    let (height, y) = (strip.height(layer), strip.row(row));
    // Height of the body, lowered, at the layer.
    let w = height * task.frame.sign + task.step;
    let low = task.tip_range().0;
    let radius = part.radius(w - low);
    let Some((from, to)) = view.outer(radius, y) else { return };
    let line = strip.line(row, layer);
    let most = STEEPEST * task.step;
    if met(line, fixed(from - most), fixed(to + most)).0 == 0 {
        return;
    }
    let mut found = |lo: f64, hi: f64| note(view, line, [fixed(lo), fixed(hi)], [y, height], looked, effects);
    if view.is_level() {
        spans(&view.plan, radius, y).as_slice().iter().for_each(|s| found(s.lo.x, s.hi.x));
    } else {
        slope_spans(part, &task.piece, &view.plan, y, w, |s| found(s.span.lo.x, s.span.hi.x));
    }
}

fn note(
    view: &View,
    line: &[Interval],
    [lo, hi]: [i32; 2],
    at: [f64; 2],
    looked: Looked,
    effects: &mut Effects,
) {
    let task = view.task;
    let (up, step) = (task.frame.axes[2].index(), i64::from(fixed(task.step)));
    // Reach of an overhanging wall on the way up to the body.
    let on = |end: &EndPoint| {
        let [along, across] = normal(end, up);
        if along * task.frame.sign < 0.0 { fixed(task.step * followed(along.abs(), across)) } else { 0 }
    };
    for i in line {
        let from = i64::from(i.lo.at) - i64::from(on(&i.lo));
        let to = i64::from(i.hi.at) + i64::from(on(&i.hi));
        let (from, to) = (from.max(i64::from(lo)), to.min(i64::from(hi)));
        if from >= to {
            continue;
        }
        let effect = effects.of(task.index);
        let goes_on = [i.lo, i.hi].iter().any(|end| end.normal.class() == class::BEYOND && end.cut == 0);
        let thin = !goes_on && i64::from(i.hi.at) - i64::from(i.lo.at) < step * 142 / 100;
        let kept = if thin { &mut effect.thin } else { &mut effect.edges };
        let [first, last] = [from, to].map(|x| task.frame.stock(view.local(unfixed(x as i32), at)));
        let seen = (to - from, first.to_array(), Aabb::of_points([first, last]));
        near(&mut kept[looked as usize], seen);
    }
}
