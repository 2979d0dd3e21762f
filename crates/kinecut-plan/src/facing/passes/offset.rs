//! Frames around a face: its outline at a distance, with arcs or sharp corners, in the order of its edges.

use glam::DVec2;

use super::meet::{Whole, meet};
use super::path::distance;
use crate::geom::{NearestEdge, Outline, OutlineEdge, offset};
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

/// The loops at `aside` [mm] from an outline, outside of its material positive, the material on their right. They begin
/// beside the first edge of the outline that they follow. Empty where nothing of the material is left, or where the
/// offset fails ([`offset`]).
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::{Corner, offset_loops};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(20.0, 0.0), dvec2(20.0, 10.0), dvec2(0.0, 10.0)])?;
/// let length = |aside: f64, corner| -> f64 {
///     offset_loops(&plate, aside, corner).iter().flatten().map(|e| e.length()).sum()
/// };
/// assert!((length(3.0, Corner::Sharp) - 84.0).abs() < 1e-9);
/// assert!((length(3.0, Corner::Round) - 60.0 - 6.0 * std::f64::consts::PI).abs() < 1e-9);
/// assert!((length(-3.0, Corner::Round) - 36.0).abs() < 1e-9);
/// assert_eq!(length(-5.5, Corner::Round), 0.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn offset_loops(outline: &Outline, aside: f64, corner: Corner) -> Vec<Vec<OutlineEdge>> {
    let Ok(made) = offset(outline, -aside) else { return Vec::new() };
    let round = made.loops.into_iter().filter(|l| !l.collapsed).map(|l| merged(l.edges));
    let mut loops = in_order(round.collect(), outline, aside);
    if corner == Corner::Sharp {
        let size =
            outline.edges().iter().fold(aside.abs(), |s, e| s.max(e.start.abs().max_element() + e.length()));
        loops = sharpened(&loops, aside, NEAR * size);
    }
    loops
}

/// Loops in the order of the edges of the outline that they follow, each from the first of them on.
fn in_order(loops: Vec<Vec<OutlineEdge>>, outline: &Outline, aside: f64) -> Vec<Vec<OutlineEdge>> {
    let near = NearestEdge::new(outline.edges());
    // The place along the outline, in edges; an arc about a corner comes after the edge that ends there.
    let place = |e: &OutlineEdge| {
        let found = near.at(e.at(0.5), aside.abs() + 10.0 * near.rounding());
        let Some(n) = found else { return f64::INFINITY };
        let is_first = outline.loops().iter().find(|l| l.edges.start == n.edge);
        match is_first.filter(|_| n.share <= 0.0) {
            Some(own) => own.edges.end as f64,
            None => n.edge as f64 + n.share,
        }
    };
    let mut keyed: Vec<(f64, Vec<OutlineEdge>)> = loops
        .into_iter()
        .filter_map(|mut one| {
            let places: Vec<f64> = one.iter().map(place).collect();
            let first = (0..one.len()).min_by(|&i, &j| places[i].total_cmp(&places[j]))?;
            one.rotate_left(first);
            Some((places[first], one))
        })
        .collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    keyed.into_iter().map(|(_, one)| one).collect()
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

/// Neighbours on one line become one piece; each piece begins where the one before it ends.
fn merged(one: Vec<OutlineEdge>) -> Vec<OutlineEdge> {
    let mut out: Vec<OutlineEdge> = Vec::with_capacity(one.len());
    for mut edge in one {
        if let Some(last) = out.last().copied() {
            edge.start = last.end;
            let is_one = last.turn.is_none()
                && edge.turn.is_none()
                && wrap(edge.heading(0.0) - last.heading(0.0)).abs() < SMOOTH;
            if is_one {
                out.pop();
                edge.start = last.start;
            }
        }
        out.push(edge);
    }
    if let [first, .., last] = &mut out[..] {
        first.start = last.end;
    }
    out
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use glam::dvec2;

    use super::*;

    fn lengths(loops: &[Vec<OutlineEdge>]) -> Vec<f64> {
        loops.iter().map(|l| l.iter().map(OutlineEdge::length).sum()).collect()
    }

    #[test]
    fn a_ring_narrows_to_nothing_and_grows_into_its_bore() {
        let outer = OutlineEdge::arc(DVec2::ZERO, 20.0, 0.3, -TAU);
        let bore = OutlineEdge::arc(dvec2(2.0, 0.0), 8.0, 1.0, TAU);
        let ring = Outline::new(vec![vec![outer], vec![bore]], vec![]).unwrap();
        let out = offset_loops(&ring, 3.0, Corner::Round);
        assert_eq!(out.len(), 2);
        assert!((lengths(&out)[0] - TAU * 23.0).abs() < 1e-9 && (lengths(&out)[1] - TAU * 5.0).abs() < 1e-9);
        // The web is 10 wide on one side and 14 on the other: at 6 a crescent is left, at 7.1 nothing.
        let half = offset_loops(&ring, -6.0, Corner::Round);
        assert_eq!(half.len(), 1);
        for e in &half[0] {
            for s in [0.0, 0.3, 1.0] {
                let p = e.at(s);
                let gap = (20.0 - p.length()).min(p.distance(dvec2(2.0, 0.0)) - 8.0);
                assert!((gap - 6.0).abs() < 1e-6, "{gap}");
            }
        }
        assert!(offset_loops(&ring, -7.1, Corner::Round).is_empty());
        assert_eq!(offset_loops(&ring, 9.0, Corner::Round).len(), 1);
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
        let bell = Outline::polygon(&corners).unwrap();
        let inside = offset_loops(&bell, -3.0, Corner::Round);
        assert_eq!(inside.len(), 2);
        // Squares of 14 that bulge towards the neck on arcs about its corners, which meet over its middle.
        let want = 52.0 + 6.0 * (2f64 / 3.0).asin();
        assert!(lengths(&inside).iter().all(|l| (l - want).abs() < 1e-7), "{:?}", lengths(&inside));
        let outside = offset_loops(&bell, 6.0, Corner::Round);
        assert_eq!(outside.len(), 1);
        assert!(outside[0].iter().all(|e| e.length() > 0.0));
        // Notches of 10 by 8 close to a point where both sides' arcs meet over the middle.
        let want = 120.0 + 2.0 * PI * 6.0 + 4.0 * 6.0 * (5f64 / 6.0).asin();
        assert!((lengths(&outside)[0] - want).abs() < 1e-6, "{} {want}", lengths(&outside)[0]);
    }
}
