//! A piece against a tile of lines along the tool axis.
//!
//! Shank and holder are compared with the stock as it is when they come by. On a level or falling piece that is after
//! the piece has cut: at a point of the plan the edges, which are lower, have then been by wherever they remove what
//! the shank would meet. On a rising piece it is before: what the edges remove later, higher up, the shank has met.

use glam::{DVec2, DVec3};

use super::axial::{Hit, hits, surface};
use super::body::{ConvexPart, RevolvedParts};
use super::edge::{from_above, most_below};
use super::effect::{Effects, Looked, deeper, met};
use super::task::{Task, TileLines, reached};
use super::tile_hollow;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::{EndPoint, FIXED_STEP, Interval, fixed, unfixed};

/// Cuts a tile whose material lies between two coordinates; true when it was changed.
pub(super) fn cut_along(
    tile: &mut Tile,
    lines: &TileLines,
    task: &Task,
    material: (i32, i32),
    effects: &mut Effects,
) -> bool {
    let (low, high) = task.tip_range();
    // An edge that slopes up to the body may end below it; what cuts by right is not asked for edges.
    let slack = if task.tool.edges.is_some() { most_below(task.step) } else { 0.0 };
    let reach = |body: &RevolvedParts, slack: f64| {
        let (lo, hi) = task.along(low + body.bottom - slack, high + body.top);
        (lo.max(material.0), hi.min(material.1))
    };
    let meets = |(lo, hi): (i32, i32)| lo < hi;
    let tool = task.tool;
    let cutting = reach(&tool.cutting, if task.watch { slack } else { 0.0 });
    let (shank, holder) = (reach(&tool.shank, slack), reach(&tool.holder, slack));
    let probed = [(&tool.shank, shank), (&tool.holder, holder)]
        .map(|(body, range)| !body.parts.is_empty() && meets(range));
    if !(meets(cutting) || probed[0] || probed[1]) {
        return false;
    }
    let (lo, hi) = (cutting.0.min(shank.0).min(holder.0), cutting.1.max(shank.1).max(holder.1));
    let before = task.piece.rise() > 0.0;
    let swapped = task.frame.sign < 0.0;
    let mut cutter = Cutter { task, ends: None };
    let hollow = task.hollow();
    let mut changed = false;
    for b in 0..lines.size[1] {
        for a in 0..lines.size[0] {
            let l = b * TILE_EDGE as usize + a;
            let line = tile.line(l);
            let (Some(first), Some(last)) = (line.first(), line.last()) else { continue };
            if last.hi.at <= lo || hi <= first.lo.at {
                continue;
            }
            let (p, q) = (lines.at[0][a], lines.at[1][b]);
            let over = if swapped { DVec2::new(q, p) } else { DVec2::new(p, q) };
            if before {
                probe(tile, l, over, task, probed, effects);
            }
            if task.watch
                && let Some([wide, ..]) = &task.tool.edges
            {
                from_above(tile, l, over, task, (&task.tool.contact, wide, Looked::Cutting), effects);
            }
            changed |= match hollow {
                Some((edge, centre)) => tile_hollow::cut_line(tile, l, over, centre, task, edge, effects),
                None => cutter.cut_line(tile, l, over, effects),
            };
            if !before {
                probe(tile, l, over, task, probed, effects);
            }
        }
    }
    changed
}

/// Takes all above the lowest reach of the tasks of a move out of a line; what it meets is not noted.
pub(super) fn cut_above(tile: &mut Tile, l: usize, over: DVec2, tasks: &[Task]) {
    let mut lowest: Option<(&Task, usize, Hit)> = None;
    for task in tasks {
        let mut own: Option<(&Task, usize, Hit)> = None;
        for (i, part) in task.tool.cutting.parts.iter().enumerate() {
            hits(part, &task.piece, over, |hit| {
                if own.is_none_or(|(.., old)| hit.lo < old.lo) {
                    own = Some((task, i, hit));
                }
            });
        }
        // Of equal ends the earlier.
        let lower = |hit: &Hit| lowest.is_none_or(|(.., old)| fixed(hit.lo) < fixed(old.lo));
        lowest = own.filter(|(.., hit)| lower(hit)).or(lowest);
    }
    let Some((task, part, hit)) = lowest else { return };
    let (normal, face) = surface(&task.tool.cutting.parts[part], &task.piece, over, hit.lo_at);
    let end = |at: i32| task.end(at, normal, face.class(part));
    // Nothing is left beyond the other end.
    let beyond = |at: i32| EndPoint { at, ..EndPoint::default() };
    let (lower, upper) = match task.frame.sign > 0.0 {
        true => (end(fixed(hit.lo)), beyond(i32::MAX)),
        false => (beyond(i32::MIN), end(fixed(-hit.lo))),
    };
    tile.subtract(l, lower, upper);
}

/// Cuts lines with one task.
struct Cutter<'a> {
    task: &'a Task<'a>,
    /// The last ends left by a flat disc and a flat top, which are the same on all lines.
    ends: Option<[EndPoint; 2]>,
}

impl Cutter<'_> {
    /// Cuts one line; true when it was changed.
    fn cut_line(&mut self, tile: &mut Tile, l: usize, over: DVec2, effects: &mut Effects) -> bool {
        let task = self.task;
        let mut changed = false;
        let sloping = task.piece.rise() != 0.0;
        for (i, part) in task.tool.cutting.parts.iter().enumerate() {
            if sloping && !may_reach(part, task, tile.line(l), over) {
                continue;
            }
            hits(part, &task.piece, over, |hit| {
                let (lo, hi) = task.along(hit.lo, hit.hi);
                let (length, ..) = met(tile.line(l), lo, hi);
                if length == 0 {
                    return;
                }
                contact(tile, l, over, task, length, effects);
                if !task.removes {
                    return;
                }
                let [lower, upper] = match self.ends {
                    Some(ends) if hit.is_flat() && ends[0].at == lo && ends[1].at == hi => ends,
                    _ => self.ends_of(i, over, &hit, lo, hi),
                };
                if hit.is_flat() {
                    self.ends = Some([lower, upper]);
                }
                effects.of(task.index).removed += tile.subtract(l, lower, upper);
                changed = true;
            });
        }
        changed
    }

    /// The end points of a hit of a part.
    fn ends_of(&self, part: usize, over: DVec2, hit: &Hit, lo: i32, hi: i32) -> [EndPoint; 2] {
        let task = self.task;
        let end = |at: i32, touch| {
            let (normal, face) = surface(&task.tool.cutting.parts[part], &task.piece, over, touch);
            task.end(at, normal, face.class(part))
        };
        if task.frame.sign > 0.0 {
            [end(lo, hit.lo_at), end(hi, hit.hi_at)]
        } else {
            [end(lo, hit.hi_at), end(hi, hit.lo_at)]
        }
    }
}

/// True if a part on a slope may come down to the material of a line; false if it does not even on a level path at its
/// lowest tip.
fn may_reach(part: &ConvexPart, task: &Task, line: &[Interval], over: DVec2) -> bool {
    let d2 = task.piece.plan.distance_squared(over);
    // Rounding of the distance must not lose a touch.
    let least = task.tip_range().0 + part.height(d2.sqrt().clamp(0.0, part.r1)) - FIXED_STEP;
    let top = match (line.first(), line.last()) {
        (_, Some(last)) if task.frame.sign > 0.0 => unfixed(last.hi.at),
        (Some(first), _) => -unfixed(first.lo.at),
        _ => return false,
    };
    top > least
}

/// Notes a contact of the cutting part with a line; `length` is the stretch of material that it meets there.
fn contact(tile: &Tile, l: usize, over: DVec2, task: &Task, length: i64, effects: &mut Effects) {
    let effect = effects.of(task.index);
    let from = task.piece.fractions[0];
    if length <= effect.deepest && effect.first.is_some_and(|(t, _)| t <= from) {
        return;
    }
    let body = &task.tool.contact;
    let Some((_, point)) = touched(tile, l, over, task, body) else { return };
    effect.deepest = effect.deepest.max(length);
    let t = reached(task, over.extend(point.dot(task.frame.stock(DVec3::Z))));
    if effect.first.is_none_or(|(old, _)| t < old) {
        effect.first = Some((t, point.to_array()));
    }
}

/// Notes contacts of shank and holder with a line.
fn probe(tile: &Tile, l: usize, over: DVec2, task: &Task, wanted: [bool; 2], effects: &mut Effects) {
    for (body, is_holder) in [(&task.tool.shank, false), (&task.tool.holder, true)] {
        if !wanted[usize::from(is_holder)] {
            continue;
        }
        if let Some((depth, point)) = touched(tile, l, over, task, body) {
            let effect = effects.of(task.index);
            let kept = if is_holder { &mut effect.holder } else { &mut effect.shank };
            deeper(kept, depth, || point.to_array());
        } else if let Some([_, wide_shank, wide_holder]) = &task.tool.edges {
            let (wide, looked) =
                if is_holder { (wide_holder, Looked::Holder) } else { (wide_shank, Looked::Shank) };
            from_above(tile, l, over, task, (body, wide, looked), effects);
        }
    }
}

/// Longest length of material that a part of a body meets on a line, with the point of it nearest to the holder.
fn touched(tile: &Tile, l: usize, over: DVec2, task: &Task, body: &RevolvedParts) -> Option<(i64, DVec3)> {
    let mut best: Option<(i64, DVec3)> = None;
    for part in &body.parts {
        hits(part, &task.piece, over, |hit| {
            let (lo, hi) = task.along(hit.lo, hit.hi);
            let (length, first, last) = met(tile.line(l), lo, hi);
            if length > best.map_or(0, |b| b.0) {
                let height = if task.frame.sign > 0.0 { unfixed(last) } else { -unfixed(first) };
                best = Some((length, task.frame.stock(over.extend(height))));
            }
        });
    }
    best
}
