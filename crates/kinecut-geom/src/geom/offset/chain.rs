//! Pieces of an offset joined into loops.
//!
//! A piece is followed by the one that begins nearest to its end, within the reach of what several candidates that meet in
//! nearly one point leave; of those as near, by the one that turns most to the right, so that loops which touch stay
//! apart, also where they touch along a tangent. Pieces of rounding, which lead nowhere, are left out on the way. Joints that are still apart, because edges that are
//! nearly tangent meet in no sharp point, are closed along the edges, and crumbs between them left out.

use std::f64::consts::PI;

use glam::DVec2;

use crate::geom::{OutlineEdge, Turn};
use crate::num::angle::wrap;

/// Length of a loop that is a crumb of candidates that meet at a small angle, in reaches.
const CRUMB: f64 = 4.0;

/// The loops of pieces whose ends are no farther apart than `reach`, and one where they are no farther apart than `same` [mm].
/// Parts of one candidate, which have the same label, are one edge again.
pub(super) fn chained(pieces: &[OutlineEdge], reach: f64, same: f64) -> Vec<Vec<OutlineEdge>> {
    let mut walk =
        Walk { pieces, next: followers(pieces, reach), spent: vec![false; pieces.len()], reach, same };
    walk.leave_out_ends();
    let mut loops = Vec::new();
    for first in 0..pieces.len() {
        if !walk.spent[first] {
            walk.from(first, &mut loops);
        }
    }
    let edges = loops.into_iter().map(|chain| closed(joined(chain), same));
    edges.filter(|edges| !edges.is_empty()).collect()
}

/// For each piece those that begin near its end.
fn followers(pieces: &[OutlineEdge], reach: f64) -> Vec<Vec<u32>> {
    let mut starts: Vec<u32> = (0..pieces.len() as u32).collect();
    let start = |i: u32| pieces[i as usize].start;
    starts.sort_by(|&a, &b| start(a).x.total_cmp(&start(b).x));
    let of = |end: DVec2| {
        let low = starts.partition_point(|&i| start(i).x < end.x - reach);
        let near = starts[low..].iter().take_while(|&&i| start(i).x <= end.x + reach);
        near.copied().filter(|&i| start(i).distance(end) <= reach).collect()
    };
    pieces.iter().map(|piece| of(piece.end)).collect()
}

/// A walk along pieces.
struct Walk<'a> {
    pieces: &'a [OutlineEdge],
    next: Vec<Vec<u32>>,
    /// Pieces that are in a loop, or in none.
    spent: Vec<bool>,
    reach: f64,
    same: f64,
}

impl Walk<'_> {
    /// Leaves out pieces that end where nothing goes on, or begin where nothing comes from.
    fn leave_out_ends(&mut self) {
        let mut before: Vec<Vec<u32>> = vec![Vec::new(); self.pieces.len()];
        for (i, next) in self.next.iter().enumerate() {
            next.iter().for_each(|&j| before[j as usize].push(i as u32));
        }
        let mut ways: Vec<[usize; 2]> =
            before.iter().zip(&self.next).map(|(b, n)| [b.len(), n.len()]).collect();
        let mut open: Vec<usize> = (0..ways.len()).filter(|&i| ways[i].contains(&0)).collect();
        while let Some(i) = open.pop() {
            if std::mem::replace(&mut self.spent[i], true) {
                continue;
            }
            for (others, side) in [(&self.next[i], 0), (&before[i], 1)] {
                for &j in others {
                    let left = &mut ways[j as usize][side];
                    *left -= 1;
                    if *left == 0 {
                        open.push(j as usize);
                    }
                }
            }
        }
    }

    /// Whether a chain is longer than a crumb.
    fn is_long(&self, chain: &[usize]) -> bool {
        let mut left = CRUMB * self.reach;
        chain.iter().any(|&i| {
            left -= self.pieces[i].length();
            left < 0.0
        })
    }

    /// Walks from a piece until nothing is left of the chain, taking out its loops.
    fn from(&mut self, first: usize, loops: &mut Vec<Vec<OutlineEdge>>) {
        let mut chain = vec![first];
        self.spent[first] = true;
        while let Some(&last) = chain.last() {
            let ahead = self.ahead(last, self.is_long(&chain).then(|| chain[0]));
            let closes = match ahead {
                Some(next) if next != chain[0] => {
                    self.spent[next] = true;
                    chain.push(next);
                    continue;
                }
                Some(_) => Some(0),
                // The way has come back to itself, or ends.
                None => chain.iter().rposition(|i| self.next[last].contains(&(*i as u32))),
            };
            match closes {
                Some(k) if self.is_long(&chain[k..]) => {
                    loops.push(chain.drain(k..).map(|i| self.pieces[i]).collect());
                }
                _ => {
                    chain.pop();
                }
            }
        }
    }

    /// The piece with which a piece goes on: one that is left, or the first of the chain.
    fn ahead(&self, last: usize, first: Option<usize>) -> Option<usize> {
        let end = &self.pieces[last];
        let ways = || {
            let left = self.next[last].iter().map(|&i| i as usize);
            left.filter(|&i| !self.spent[i] || Some(i) == first)
        };
        let apart = |i: usize| self.pieces[i].start.distance(end.end);
        let nearest = ways().map(apart).fold(f64::INFINITY, f64::min);
        let turn = |i: usize| turn(end, &self.pieces[i]);
        ways().filter(|&i| apart(i) <= nearest + self.same).min_by(|&a, &b| turn(a).total_cmp(&turn(b)))
    }
}

/// The angle by which an edge turns to the left against the one before it [rad].
fn turn(end: &OutlineEdge, start: &OutlineEdge) -> f64 {
    /// Difference from a half turn that is rounding [rad].
    const BACK: f64 = 1e-6;
    let angle = wrap(start.heading(0.0) - end.heading(1.0));
    if angle.abs() < PI - BACK {
        return angle;
    }
    // A way back is on the side to which the two bend away from one another; of lines, on the right.
    let bend = |edge: &OutlineEdge| edge.turn.map_or(0.0, |t| t.sweep.signum() / t.radius);
    if bend(end) + bend(start) < 0.0 { PI } else { -PI }
}

/// A chain in which parts of one candidate are one edge again.
fn joined(chain: Vec<OutlineEdge>) -> Vec<OutlineEdge> {
    let one = |a: &OutlineEdge, b: &OutlineEdge| {
        let turn = |s: Turn, t: Turn| Turn { sweep: s.sweep + t.sweep, ..s };
        (a.label == b.label).then(|| OutlineEdge {
            end: b.end,
            turn: a.turn.zip(b.turn).map(|(s, t)| turn(s, t)),
            ..*a
        })
    };
    let mut edges: Vec<OutlineEdge> = Vec::with_capacity(chain.len());
    for edge in chain {
        match edges.last().and_then(|last| one(last, &edge)) {
            Some(both) => {
                edges.pop();
                edges.push(both);
            }
            None => edges.push(edge),
        }
    }
    if let [first, .., last] = &edges[..]
        && let Some(both) = one(last, first)
    {
        edges[0] = both;
        edges.pop();
    }
    edges.into_iter().map(|edge| edge.labelled(0)).collect()
}

/// A loop whose joints that are farther apart than `same` are closed in their middles, and whose edges that come to nothing by
/// that are left out.
fn closed(mut edges: Vec<OutlineEdge>, same: f64) -> Vec<OutlineEdge> {
    loop {
        let count = edges.len();
        let is_open = |i: usize| edges[i].end.distance(edges[(i + 1) % count].start) > same;
        if count < 2 || !(0..count).any(is_open) {
            return edges;
        }
        let joint = |i: usize| match (i + count - 1) % count {
            before if is_open(before) => Some(0.5 * (edges[before].end + edges[i].start)),
            _ => None,
        };
        let trimmed = |(i, edge): (usize, &OutlineEdge)| {
            let start = joint(i).unwrap_or(edge.start);
            let end = joint((i + 1) % count).unwrap_or(edge.end);
            trim(edge, start, end)
        };
        let trimmed: Vec<(OutlineEdge, f64)> = edges.iter().enumerate().map(trimmed).collect();
        edges = trimmed.into_iter().filter(|(_, length)| *length > same).map(|(edge, _)| edge).collect();
        if edges.len() == count {
            return edges;
        }
    }
}

/// An edge between other ends, which are nearly on it, and its length along the travel: not positive where they have changed
/// their order.
fn trim(edge: &OutlineEdge, start: DVec2, end: DVec2) -> (OutlineEdge, f64) {
    let Some(t) = edge.turn else {
        let along = (edge.end - edge.start).normalize_or_zero();
        return (OutlineEdge { start, end, ..*edge }, (end - start).dot(along));
    };
    let angle = |from: DVec2, to: DVec2| (from - t.centre).angle_to(to - t.centre);
    let [first, last] = [angle(edge.start, start), angle(edge.end, end)];
    let sweep = t.sweep - first + last;
    let turn = Turn { from: t.from + first, sweep, ..t };
    (OutlineEdge { start, end, turn: Some(turn), ..*edge }, t.radius * sweep * t.sweep.signum())
}
