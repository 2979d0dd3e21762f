//! Offsets made directly: every edge is moved, every corner that opens gets an arc, all are cut where any two of them
//! meet, and the pieces that keep the distance are joined into loops. Quadratic where many candidates lie together.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::failed;
use crate::base::Result;
use crate::geom::outline::{EdgeBins, NearestEdge, meetings};
use crate::geom::{Outline, OutlineEdge, Turn};
use crate::num::angle::wrap;

/// Distance of two points that are one, in roundings.
const JOINED: f64 = 10.0;
/// Deficit of the distance of a piece that still keeps it, in roundings: where edges meet at small angles, pieces beyond
/// their meeting lack little.
const FINE: f64 = 1e-3;

/// The loops, the face on their right.
pub(super) fn loops(outline: &Outline, distance: f64, near: &NearestEdge) -> Result<Vec<Vec<OutlineEdge>>> {
    let (same, fine) = (near.rounding(), FINE * near.rounding());
    let all = candidates(outline, distance);
    let mut pieces = Vec::new();
    let bins = EdgeBins::new(&all);
    for (i, candidate) in all.iter().enumerate() {
        let mut cuts = vec![0.0, 1.0];
        bins.around(candidate, same, &mut |j| {
            if j != i {
                let met = meetings(candidate, &all[j], same);
                cuts.extend(met.into_iter().map(|p| candidate.nearest(p).0));
            }
        });
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let piece = candidate.part(pair[0], pair[1]).labelled(i as u32);
            let kept = piece.length() > same
                && near
                    .at(piece.at(0.5), distance.abs())
                    .is_none_or(|nearest| nearest.distance.abs() >= distance.abs() - fine);
            if kept {
                pieces.push(piece);
            }
        }
    }
    let reach = JOINED * same;
    chained(&without_ends(without_twins(pieces, same), reach), distance, reach)
}

/// Edges moved by the distance to the right, and arcs about corners that open.
fn candidates(outline: &Outline, distance: f64) -> Vec<OutlineEdge> {
    let mut all = Vec::new();
    for one in outline.loops() {
        let edges = &outline.edges()[one.edges.clone()];
        for (i, edge) in edges.iter().enumerate() {
            let moved = |s: f64| edge.at(s) - distance * DVec2::from_angle(edge.outward(s));
            match edge.turn {
                None => all.push(OutlineEdge::line(moved(0.0), moved(1.0))),
                Some(t) => {
                    let radius = t.radius + distance * t.sweep.signum();
                    if radius > 0.0 {
                        let (start, end) = (moved(0.0), moved(1.0));
                        all.push(OutlineEdge { start, end, turn: Some(Turn { radius, ..t }), label: 0 });
                    }
                }
            }
            let next = &edges[(i + 1) % edges.len()];
            let turn = corner(edge, next);
            if turn * distance > 0.0 && turn.abs() > 1e-12 {
                let from = edge.heading(1.0) - FRAC_PI_2.copysign(distance);
                let arc = OutlineEdge::arc(edge.end, distance.abs(), from, turn);
                let end = next.at(0.0) - distance * DVec2::from_angle(next.outward(0.0));
                all.push(OutlineEdge { start: moved(1.0), end, ..arc });
            }
        }
    }
    all
}

/// The turn at a corner [rad]. One of half a turn, where two edges touch, goes to the right where the face is the tip
/// between them, to the left where it is all around them: the curvatures tell.
fn corner(edge: &OutlineEdge, next: &OutlineEdge) -> f64 {
    /// Rounding of half a turn [rad], and of the curvature of a line (1/mm).
    const SAME: f64 = 1e-6;
    let turn = wrap(next.heading(0.0) - edge.heading(1.0));
    let apart = edge.curvature() + next.curvature();
    if PI - turn.abs() < SAME && apart.abs() > SAME { turn.abs().copysign(-apart) } else { turn }
}

/// The pieces without those that lie on another one and run the same way.
fn without_twins(mut pieces: Vec<OutlineEdge>, same: f64) -> Vec<OutlineEdge> {
    let key = |e: &OutlineEdge| e.at(0.5).x;
    pieces.sort_by(|a, b| key(a).total_cmp(&key(b)));
    let mut kept: Vec<OutlineEdge> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let twin = kept.iter().rev().take_while(|k| key(&piece) - key(k) <= same).any(|k| {
            k.start.distance(piece.start) <= same
                && k.end.distance(piece.end) <= same
                && k.at(0.5).distance(piece.at(0.5)) <= same
        });
        if !twin {
            kept.push(piece);
        }
    }
    kept
}

/// Pieces joined into loops; where several go on from a point, the one that turns most to the right, so that loops which
/// touch stay apart. Arcs and lines that were cut and go on are one again.
fn chained(pieces: &[OutlineEdge], distance: f64, reach: f64) -> Result<Vec<Vec<OutlineEdge>>> {
    let mut starts: Vec<usize> = (0..pieces.len()).collect();
    starts.sort_by(|&a, &b| pieces[a].start.x.total_cmp(&pieces[b].start.x));
    let mut used = vec![false; pieces.len()];
    let mut loops = Vec::new();
    for first in 0..pieces.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        let mut chain = vec![pieces[first]];
        loop {
            let last = chain[chain.len() - 1];
            let low = starts.partition_point(|&i| pieces[i].start.x < last.end.x - reach);
            let next = starts[low..]
                .iter()
                .take_while(|&&i| pieces[i].start.x <= last.end.x + reach)
                .filter(|&&i| !used[i] && pieces[i].start.distance(last.end) <= reach)
                .min_by(|&&a, &&b| {
                    let turn = |i: usize| wrap(pieces[i].heading(0.0) - last.heading(1.0));
                    turn(a).total_cmp(&turn(b))
                });
            let closes = chain[0].start.distance(last.end) <= reach;
            match next {
                Some(&next) if !closes || turns_more(&pieces[next], &chain, last) => {
                    used[next] = true;
                    chain.push(pieces[next]);
                }
                _ if closes => break,
                _ => return Err(failed("does not close", last.end, distance)),
            }
        }
        // A crumb of two candidates that meet at a small angle is no loop.
        if chain.iter().map(OutlineEdge::length).sum::<f64>() > 4.0 * reach {
            loops.push(joined(chain));
        }
    }
    Ok(loops)
}

/// Whether going on along a piece keeps more to the right than closing the chain.
fn turns_more(piece: &OutlineEdge, chain: &[OutlineEdge], last: OutlineEdge) -> bool {
    let turn = |e: &OutlineEdge| wrap(e.heading(0.0) - last.heading(1.0));
    turn(piece) < turn(&chain[0]) - 1e-9
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

/// The pieces without those that end where nothing goes on, or begin where nothing comes from.
fn without_ends(mut pieces: Vec<OutlineEdge>, reach: f64) -> Vec<OutlineEdge> {
    loop {
        let by_x = |point: fn(&OutlineEdge) -> DVec2| {
            let mut points: Vec<DVec2> = pieces.iter().map(point).collect();
            points.sort_by(|a, b| a.x.total_cmp(&b.x));
            points
        };
        let (starts, ends) = (by_x(|e| e.start), by_x(|e| e.end));
        let is_near = |list: &[DVec2], p: DVec2| {
            let low = list.partition_point(|q| q.x < p.x - reach);
            list[low..].iter().take_while(|q| q.x <= p.x + reach).any(|q| q.distance(p) <= reach)
        };
        let before = pieces.len();
        pieces.retain(|e| is_near(&starts, e.end) && is_near(&ends, e.start));
        if pieces.len() == before {
            return pieces;
        }
    }
}
