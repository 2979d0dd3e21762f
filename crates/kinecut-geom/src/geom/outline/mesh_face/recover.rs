//! Arcs from chords.
//!
//! A mesh has chords where the part has arcs. A run of chords is one arc again when its vertices lie on a circle within a
//! tolerance, all turn the same way by angles as tessellations have them (a hexagon stays a hexagon), and have about the
//! same length. The arc goes through the first, a middle and the last vertex of the run; a loop that is all one run
//! becomes a circle, fitted to all vertices. Runs are found greedily, by doubling their length and then halving the
//! interval: `n log n`.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::geom::outline::OutlineEdge;
use crate::geom::outline::through::arc_through;

/// Fewest chords of an arc: a chamfer or a corner of few facets stays as it is.
const LEAST_CHORDS: usize = 5;
/// Most that a chord turns from the one before [rad]: 12 chords for a circle, the coarsest tessellation in use. A regular
/// octagon turns by 45 degrees.
const MOST_TURN: f64 = TAU / 11.9;
/// Most by which chords of one arc differ in length; the last ones may have been trimmed.
const MOST_RATIO: f64 = 2.0;
/// Distance from the line through its neighbours below which a vertex is dropped, per size: rounding.
const COLLINEAR: f64 = 1e-12;

/// The loop of points as edges, and how many chords became arcs; `size` [mm] is that of the whole outline.
pub(super) fn recover(points: &[DVec2], tolerance: f64, size: f64) -> (Vec<OutlineEdge>, usize) {
    let points = without_collinear(points, COLLINEAR * size);
    let n = points.len();
    if n < 3 {
        return (lines(&points), 0);
    }
    let run = Run { points: &points, tolerance };
    if !(tolerance > 0.0) {
        return (lines(&points), 0);
    }
    if let Some(circle) = run.circle() {
        return (vec![circle], n);
    }
    // The first run may begin in the middle of an arc; where it ends an edge ends for certain.
    let Some(first) = (0..n).find_map(|i| Some(i + run.longest(i, n - 1)?)) else {
        return (lines(&points), 0);
    };
    let mut edges = Vec::new();
    let (mut gone, mut joined) = (0, 0);
    while gone < n {
        let from = first + gone;
        match run.longest(from, n - gone) {
            Some(chords) => {
                edges.push(arc_through(run.at(from), run.at(from + chords / 2), run.at(from + chords)));
                gone += chords;
                joined += chords;
            }
            None => {
                edges.push(OutlineEdge::line(run.at(from), run.at(from + 1)));
                gone += 1;
            }
        }
    }
    (edges, joined)
}

fn lines(points: &[DVec2]) -> Vec<OutlineEdge> {
    (0..points.len()).map(|i| OutlineEdge::line(points[i], points[(i + 1) % points.len()])).collect()
}

/// Without vertices on the line between their neighbours.
fn without_collinear(points: &[DVec2], near: f64) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::with_capacity(points.len());
    let n = points.len();
    for i in 0..n {
        let before = kept.last().copied().unwrap_or(points[n - 1]);
        let (p, after) = (points[i], points[(i + 1) % n]);
        let along = after - before;
        let off = along.perp_dot(p - before).abs();
        let between = (p - before).dot(along) > 0.0 && (after - p).dot(along) > 0.0;
        if !(off <= near * along.length() && between) {
            kept.push(p);
        }
    }
    kept
}

struct Run<'a> {
    points: &'a [DVec2],
    tolerance: f64,
}

impl Run<'_> {
    fn at(&self, i: usize) -> DVec2 {
        self.points[i % self.points.len()]
    }

    fn chord(&self, i: usize) -> DVec2 {
        self.at(i + 1) - self.at(i)
    }

    /// The largest number of chords from a vertex on that are one arc, up to `most`.
    fn longest(&self, from: usize, most: usize) -> Option<usize> {
        if most < LEAST_CHORDS || !self.is_arc(from, LEAST_CHORDS) {
            return None;
        }
        let (mut good, mut bad) = (LEAST_CHORDS, most + 1);
        while 2 * good < bad && self.is_arc(from, 2 * good) {
            good *= 2;
        }
        bad = bad.min(2 * good);
        while bad - good > 1 {
            let middle = good + (bad - good) / 2;
            if self.is_arc(from, middle) { good = middle } else { bad = middle }
        }
        Some(good)
    }

    /// True if the chords are one arc.
    fn is_arc(&self, from: usize, chords: usize) -> bool {
        if !self.turns_evenly(from, chords)
            || !self.lengths_agree(from + 1, chords - 2, &[from, from + chords - 1])
        {
            return false;
        }
        let arc = arc_through(self.at(from), self.at(from + chords / 2), self.at(from + chords));
        let Some(t) = arc.turn else { return false };
        // Chords that are straight within the tolerance form no arc.
        let sagitta = t.radius * (1.0 - (0.5 * t.sweep.abs()).min(std::f64::consts::PI).cos());
        let near = |i: usize| (self.at(from + i).distance(t.centre) - t.radius).abs() <= self.tolerance;
        sagitta > 2.0 * self.tolerance && (1..chords).all(near)
    }

    fn turns_evenly(&self, from: usize, chords: usize) -> bool {
        let turn = |i: usize| self.chord(from + i).angle_to(self.chord(from + i + 1));
        let way = turn(0).signum();
        (0..chords - 1).map(turn).all(|a| a * way > 0.0 && a * way <= MOST_TURN)
    }

    /// True if the chords have about one length; those at the ends may be shorter.
    fn lengths_agree(&self, from: usize, chords: usize, ends: &[usize]) -> bool {
        let (mut least, mut most) = (f64::INFINITY, 0.0);
        for i in 0..chords {
            let length = self.chord(from + i).length();
            least = if length < least { length } else { least };
            most = if length > most { length } else { most };
        }
        most <= MOST_RATIO * least && ends.iter().all(|&i| self.chord(i).length() <= MOST_RATIO * least)
    }

    /// The circle of a loop that is all one.
    fn circle(&self) -> Option<OutlineEdge> {
        let n = self.points.len();
        if n < LEAST_CHORDS || !self.turns_evenly(0, n + 1) || !self.lengths_agree(0, n, &[]) {
            return None;
        }
        let (centre, radius) = fitted_circle(self.points)?;
        let near = |p: &DVec2| (p.distance(centre) - radius).abs() <= self.tolerance;
        if !self.points.iter().all(near) {
            return None;
        }
        let way = self.chord(0).angle_to(self.chord(1)).signum();
        Some(OutlineEdge::arc(centre, radius, (self.points[0] - centre).to_angle(), way * TAU))
    }
}

/// The circle with the least sum of squared differences of squared distances (Kasa 1976): linear in what is sought.
fn fitted_circle(points: &[DVec2]) -> Option<(DVec2, f64)> {
    let n = points.len() as f64;
    let middle = points.iter().sum::<DVec2>() / n;
    let (mut xx, mut xy, mut yy, mut right) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for p in points {
        let d = *p - middle;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        right += 0.5 * d * d.length_squared();
    }
    let det = xx * yy - xy * xy;
    let aside = DVec2::new(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / det;
    let radius = (aside.length_squared() + (xx + yy) / n).sqrt();
    (aside.is_finite() && radius.is_finite()).then_some((middle + aside, radius))
}
