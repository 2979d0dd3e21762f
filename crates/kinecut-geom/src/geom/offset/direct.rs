//! Offsets made directly: every edge is moved, every corner that opens gets an arc, all are cut where any two of them
//! meet, and the pieces that keep the distance are joined into loops (`chain.rs`). Quadratic where many candidates lie
//! together.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::chain::chained;
use crate::geom::outline::{EdgeBins, NearestEdge, meetings};
use crate::geom::{Outline, OutlineEdge, Turn};
use crate::num::angle::wrap;

/// Distance of two points that are one, in roundings.
const JOINED: f64 = 10.0;
/// Deficits of the distance of a piece that still keeps it, in roundings, to be tried in turn: where edges meet at small
/// angles, pieces beyond their meeting lack little; where the ends of edges are rounded, so do pieces that belong.
pub(super) const DEFICITS: [f64; 2] = [1e-3, 1.0];
/// Deficit from which on a piece is kept where any part of it keeps the distance: a passage as wide as twice the distance is
/// narrower here and there.
const ROUGH: f64 = 0.1;

/// The loops, the face on their right.
pub(super) fn loops(
    outline: &Outline,
    distance: f64,
    near: &NearestEdge,
    deficit: f64,
) -> Vec<Vec<OutlineEdge>> {
    let (same, fine) = (near.rounding(), deficit * near.rounding());
    let shares: &[f64] = if deficit > ROUGH { &[0.5, 0.03, 0.26, 0.74, 0.97] } else { &[0.5] };
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
            let has_room = |share: f64| {
                let nearest = near.at(piece.at(share), distance.abs());
                nearest.is_none_or(|nearest| nearest.distance.abs() >= distance.abs() - fine)
            };
            let kept = piece.length() > same && shares.iter().any(|&share| has_room(share));
            if kept {
                pieces.push(piece);
            }
        }
    }
    let reach = JOINED * same;
    chained(&without_twins(pieces, same), reach, same)
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
    // At the end of a line, where one edge goes back along the other, there is nothing between them.
    if PI - turn.abs() < SAME { turn.abs().copysign(if apart < -SAME { 1.0 } else { -1.0 }) } else { turn }
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
