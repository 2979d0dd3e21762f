//! Offsets of loops of lines and arcs, their arcs kept.
//!
//! Each edge is moved aside, gaps at corners are bridged by arcs about the corner or by sharp corners, all pieces are cut
//! where they meet, and those cuts stay whose middle is not nearer to the loops than the offset. Joined end to end they
//! are the offset loops; loops that grow together or vanish do so by themselves.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::meet::{Whole, meet};
use super::path::distance;
use crate::geom::{OutlineEdge, Turn};
use crate::num::angle::wrap;

/// Way of an offset round a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// On an arc about the corner.
    Round,
    /// Along both edges to the point where they meet, where these are straight and turn by a right angle or a little
    /// more at most; else on an arc.
    Sharp,
}

/// Sharpest turn that is made without an arc [rad]: the point then lies 1.56 offsets from the corner at most.
const SHARPEST: f64 = 100.0 * std::f64::consts::PI / 180.0;

/// Distances below this, per size of the loops, are nought: the rounding of roots of tangent pieces.
const NEAR: f64 = 1e-8;

/// Pieces whose directions differ by less run into one another [rad]: cuts are that uncertain.
const TANGENT: f64 = 1e-6;

/// Corners that turn by less are smooth [rad]: the gap is then below rounding.
const SMOOTH: f64 = 1e-9;

/// The loops at `aside` [mm] to the left of these loops, negative to the right, in the same direction of travel. For
/// loops of an outline, which have their material on the right, positive is outside of the material. Empty where
/// nothing of the loops is left, or where the offset does not close (loops that touch themselves).
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::{Corner, offset_loops};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(20.0, 0.0), dvec2(20.0, 10.0), dvec2(0.0, 10.0)])?;
/// let loops = [plate.edges().to_vec()];
/// let length = |aside: f64, corner| -> f64 {
///     offset_loops(&loops, aside, corner).iter().flatten().map(|e| e.length()).sum()
/// };
/// assert!((length(3.0, Corner::Sharp) - 84.0).abs() < 1e-9);
/// assert!((length(3.0, Corner::Round) - 60.0 - 6.0 * std::f64::consts::PI).abs() < 1e-9);
/// assert!((length(-3.0, Corner::Round) - 36.0).abs() < 1e-9);
/// assert_eq!(length(-5.5, Corner::Round), 0.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn offset_loops(loops: &[Vec<OutlineEdge>], aside: f64, corner: Corner) -> Vec<Vec<OutlineEdge>> {
    if aside == 0.0 {
        return loops.to_vec();
    }
    let edges: Vec<&OutlineEdge> = loops.iter().flatten().collect();
    let size = edges.iter().fold(aside.abs(), |s, e| s.max(e.start.abs().max_element() + e.length()));
    let near = NEAR * size;
    let mut raw = Vec::new();
    for one in loops {
        for (i, edge) in one.iter().enumerate() {
            raw.extend(moved_aside(edge, aside));
            join(edge, &one[(i + 1) % one.len()], aside, &mut raw);
        }
    }
    raw.retain(|e| e.length() > near);
    let boxes: Vec<[DVec2; 2]> = raw.iter().map(box_of).collect();
    let mut kept: Vec<OutlineEdge> = Vec::new();
    let mut shares = Vec::new();
    // The edge that was too near to the cut before is asked first: mostly it is so to the next.
    let mut last = 0;
    for (i, piece) in raw.iter().enumerate() {
        shares.clear();
        for (j, other) in raw.iter().enumerate() {
            if j == i || !boxes_meet(boxes[i], boxes[j], near) {
                continue;
            }
            let first = shares.len();
            meet(piece, Whole::of(other), &mut shares);
            // A piece ends where it leaves the other's line only if the other is there.
            let mut k = first;
            while k < shares.len() {
                if distance(other, piece.at(shares[k])) > near {
                    shares.swap_remove(k);
                } else {
                    k += 1;
                }
            }
        }
        shares.extend([0.0, 1.0]);
        shares.sort_by(f64::total_cmp);
        let mut from = 0.0;
        for &to in &shares {
            if (to - from) * piece.length() <= near && to < 1.0 {
                continue;
            }
            let cut = part(piece, from, to);
            let middle = cut.at(0.5);
            from = to;
            let nearer = |e: &OutlineEdge| distance(e, middle) < aside.abs() - near;
            if cut.length() <= near || edges.get(last).is_some_and(|e| nearer(e)) {
                continue;
            }
            match edges.iter().position(|e| nearer(e)) {
                Some(edge) => last = edge,
                None => kept.push(cut),
            }
        }
    }
    // Two cuts of tangent pieces may end anywhere between the roots of a distance below rounding.
    let round = chained(kept, near.sqrt() * size.sqrt().min(1.0) + 4.0 * near);
    if corner == Corner::Sharp { sharpened(&round, aside, near) } else { round }
}

/// Puts the corner in place of arcs about corners that have straight neighbours on both sides, where it is clear of the
/// other pieces.
fn sharpened(loops: &[Vec<OutlineEdge>], aside: f64, near: f64) -> Vec<Vec<OutlineEdge>> {
    let tip = |one: &[OutlineEdge], i: usize| -> Option<DVec2> {
        let (before, arc) = (one[(i + one.len() - 1) % one.len()], one[i]);
        let after = one[(i + 1) % one.len()];
        let turn = arc.turn.filter(|t| t.sweep * aside < 0.0 && t.sweep.abs() <= SHARPEST)?;
        let smooth = |a: f64, b: f64| wrap(a - b).abs() < TANGENT;
        let about_corner = before.turn.is_none()
            && after.turn.is_none()
            && (turn.radius - aside.abs()).abs() <= near
            && smooth(before.heading(1.0), arc.heading(0.0))
            && smooth(arc.heading(1.0), after.heading(0.0));
        if !about_corner {
            return None;
        }
        let tip = turn.centre + (arc.start + arc.end - 2.0 * turn.centre) / (1.0 + turn.sweep.cos());
        let clear = loops.iter().flatten().filter(|p| **p != before && **p != arc && **p != after).all(|p| {
            [arc.start, arc.end].into_iter().all(|end| {
                let mut shares = Vec::new();
                let line = OutlineEdge::line(end, tip);
                meet(&line, Whole::of(p), &mut shares);
                shares.iter().all(|&s| distance(p, line.at(s)) > near)
            })
        });
        clear.then_some(tip)
    };
    let sharp = |one: &Vec<OutlineEdge>| {
        let mut out = Vec::with_capacity(one.len());
        for (i, piece) in one.iter().enumerate() {
            match tip(one, i) {
                Some(tip) => {
                    out.extend([OutlineEdge::line(piece.start, tip), OutlineEdge::line(tip, piece.end)])
                }
                None => out.push(*piece),
            }
        }
        merged(out)
    };
    loops.iter().map(sharp).collect()
}

fn moved_aside(edge: &OutlineEdge, aside: f64) -> Option<OutlineEdge> {
    let Some(turn) = edge.turn else {
        let shift = aside * (edge.end - edge.start).normalize_or_zero().perp();
        return Some(OutlineEdge { start: edge.start + shift, end: edge.end + shift, ..*edge });
    };
    let radius = turn.radius - aside.copysign(aside * turn.sweep);
    (radius > 0.0).then(|| {
        let scaled = |p: DVec2| turn.centre + (p - turn.centre) * (radius / turn.radius);
        let turn = Some(Turn { radius, ..turn });
        OutlineEdge { start: scaled(edge.start), end: scaled(edge.end), turn, label: edge.label }
    })
}

/// Bridges the gap between the offsets of two edges, if they part.
fn join(edge: &OutlineEdge, next: &OutlineEdge, aside: f64, raw: &mut Vec<OutlineEdge>) {
    let (before, after) = (edge.heading(1.0), next.heading(0.0));
    let turn = wrap(after - before);
    if turn.abs() < SMOOTH || turn * aside > 0.0 {
        return;
    }
    let left = |heading: f64| aside * DVec2::from_angle(heading + FRAC_PI_2);
    let at = edge.end;
    let (from, to) = (at + left(before), at + left(after));
    let out = from - at;
    let turn = Turn { centre: at, radius: aside.abs(), from: out.y.atan2(out.x), sweep: turn };
    raw.push(OutlineEdge { start: from, end: to, turn: Some(turn), label: edge.label });
}

fn box_of(edge: &OutlineEdge) -> [DVec2; 2] {
    let ([x0, x1], [y0, y1]) = (edge.extent(DVec2::X), edge.extent(DVec2::Y));
    [DVec2::new(x0, y0), DVec2::new(x1, y1)]
}

fn boxes_meet(a: [DVec2; 2], b: [DVec2; 2], near: f64) -> bool {
    let near = DVec2::splat(near);
    a[0].cmple(b[1] + near).all() && b[0].cmple(a[1] + near).all()
}

/// A part of an edge, by shares of its length.
pub(super) fn part(edge: &OutlineEdge, from: f64, to: f64) -> OutlineEdge {
    if from == 0.0 && to == 1.0 {
        return *edge;
    }
    let turn = edge.turn.map(|t| Turn { from: t.from + from * t.sweep, sweep: (to - from) * t.sweep, ..t });
    OutlineEdge { start: edge.at(from), end: edge.at(to), turn, label: edge.label }
}

/// Joins pieces end to end into closed loops; pieces that do not close are left out.
fn chained(pieces: Vec<OutlineEdge>, near: f64) -> Vec<Vec<OutlineEdge>> {
    let mut used = vec![false; pieces.len()];
    let mut loops = Vec::new();
    for first in 0..pieces.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        let start = pieces[first].start;
        let mut one = vec![pieces[first]];
        let closed = loop {
            let end = one[one.len() - 1].end;
            let next = (0..pieces.len())
                .filter(|&i| !used[i])
                .map(|i| (end.distance(pieces[i].start), i))
                .filter(|(gap, _)| *gap <= near)
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let home = end.distance(start);
            if home <= near && next.is_none_or(|(gap, _)| home <= gap) {
                break true;
            }
            let Some((_, i)) = next else { break false };
            used[i] = true;
            one.push(pieces[i]);
        };
        if closed {
            loops.push(merged(one));
        }
    }
    loops
}

/// Neighbours on one line become one piece; gaps of rounding between pieces are closed.
fn merged(one: Vec<OutlineEdge>) -> Vec<OutlineEdge> {
    let mut out: Vec<OutlineEdge> = Vec::with_capacity(one.len());
    for mut edge in one {
        if let Some(last) = out.last().copied() {
            bridge(last.end, &mut edge, &mut out);
            if last.turn.is_none() && edge.turn.is_none() {
                let bend = wrap(edge.heading(0.0) - last.heading(0.0));
                if bend.abs() < SMOOTH {
                    out.pop();
                    edge.start = last.start;
                }
            }
        }
        out.push(edge);
    }
    if let (Some(end), Some(mut first)) = (out.last().map(|e| e.end), out.first().copied()) {
        bridge(end, &mut first, &mut out);
        out[0] = first;
    }
    out
}

/// Makes a piece start at `end`: lines are drawn there, arcs begin earlier or later on their circle, after a line where
/// `end` is off it.
fn bridge(end: DVec2, edge: &mut OutlineEdge, out: &mut Vec<OutlineEdge>) {
    if let Some(turn) = &mut edge.turn {
        let radial = end - turn.centre;
        if (radial.length() - turn.radius).abs() > NEAR * (turn.radius + end.abs().max_element()) {
            out.push(OutlineEdge::line(end, edge.start));
            return;
        }
        let earlier = wrap(turn.from - radial.y.atan2(radial.x));
        turn.from -= earlier;
        turn.sweep = (turn.sweep + earlier).clamp(-TAU, TAU);
    }
    edge.start = end;
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::dvec2;

    use super::*;
    use crate::geom::Outline;

    fn lengths(loops: &[Vec<OutlineEdge>]) -> Vec<f64> {
        loops.iter().map(|l| l.iter().map(OutlineEdge::length).sum()).collect()
    }

    #[test]
    fn a_ring_narrows_to_nothing_and_grows_into_its_bore() {
        let outer = OutlineEdge::arc(DVec2::ZERO, 20.0, 0.3, -TAU);
        let bore = OutlineEdge::arc(dvec2(2.0, 0.0), 8.0, 1.0, TAU);
        let loops = [vec![outer], vec![bore]];
        let out = offset_loops(&loops, 3.0, Corner::Round);
        assert_eq!(out.len(), 2);
        assert!((lengths(&out)[0] - TAU * 23.0).abs() < 1e-9 && (lengths(&out)[1] - TAU * 5.0).abs() < 1e-9);
        // The web is 10 wide on one side and 14 on the other: at 6 a crescent is left, at 7.1 nothing.
        let half = offset_loops(&loops, -6.0, Corner::Round);
        assert_eq!(half.len(), 1);
        for e in &half[0] {
            for s in [0.0, 0.3, 1.0] {
                let p = e.at(s);
                let gap = (20.0 - p.length()).min(p.distance(dvec2(2.0, 0.0)) - 8.0);
                assert!((gap - 6.0).abs() < 1e-6, "{gap}");
            }
        }
        assert!(offset_loops(&loops, -7.1, Corner::Round).is_empty());
        assert_eq!(offset_loops(&loops, 9.0, Corner::Round).len(), 1);
    }

    #[test]
    fn a_notch_closes_and_two_lobes_part() {
        // A dumb-bell: two squares of 20 joined by a neck of 4.
        let p = [
            (0.0, 0.0),
            (20.0, 0.0),
            (20.0, 8.0),
            (30.0, 8.0),
            (30.0, 0.0),
            (50.0, 0.0),
            (50.0, 20.0),
            (30.0, 20.0),
            (30.0, 12.0),
            (20.0, 12.0),
            (20.0, 20.0),
            (0.0, 20.0),
        ];
        let corners: Vec<DVec2> = p.iter().map(|&(x, y)| dvec2(x, y)).collect();
        let loops = [Outline::polygon(&corners).unwrap().edges().to_vec()];
        let inside = offset_loops(&loops, -3.0, Corner::Round);
        assert_eq!(inside.len(), 2);
        // Squares of 14 that bulge towards the neck on arcs about its corners, which meet over its middle.
        let want = 52.0 + 6.0 * (2f64 / 3.0).asin();
        assert!(lengths(&inside).iter().all(|l| (l - want).abs() < 1e-7), "{:?}", lengths(&inside));
        let outside = offset_loops(&loops, 6.0, Corner::Round);
        assert_eq!(outside.len(), 1);
        assert!(outside[0].iter().all(|e| e.length() > 0.0));
        // Notches of 10 by 8 close to a point where both sides' arcs meet over the middle.
        let want = 120.0 + 2.0 * PI * 6.0 + 4.0 * 6.0 * (5f64 / 6.0).asin();
        assert!((lengths(&outside)[0] - want).abs() < 1e-6, "{} {want}", lengths(&outside)[0]);
    }
}
