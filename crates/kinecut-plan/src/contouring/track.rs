//! A closed path of the cutter's centre, measured along its length.

use std::f64::consts::PI;

use glam::DVec2;

use crate::geom::OutlineEdge;

/// A closed path.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Track {
    edges: Vec<OutlineEdge>,
    /// Lengths up to the beginning of each edge, and last that of all [mm].
    begins: Vec<f64>,
}

/// Pieces shorter than this are dropped [mm].
const NOTHING: f64 = 1e-9;

impl Track {
    /// Of edges; arcs beyond a half circle are halved: controls refuse full circles under compensation.
    pub(super) fn new(edges: Vec<OutlineEdge>) -> Track {
        let is_wide = |e: &OutlineEdge| e.turn.is_some_and(|t| t.sweep.abs() > PI * (1.0 + 1e-9));
        let halved = |e: OutlineEdge| match is_wide(&e) {
            true => vec![e.part(0.0, 0.5), e.part(0.5, 1.0)],
            false => vec![e],
        };
        let edges: Vec<OutlineEdge> = edges.into_iter().flat_map(halved).collect();
        let mut begins = vec![0.0];
        for edge in &edges {
            begins.push(begins[begins.len() - 1] + edge.length());
        }
        Track { edges, begins }
    }

    /// Travelled the other way.
    pub(super) fn reversed(&self) -> Track {
        Track::new(self.edges.iter().rev().map(OutlineEdge::reversed).collect())
    }

    pub(super) fn edges(&self) -> &[OutlineEdge] {
        &self.edges
    }

    /// Length [mm].
    pub(super) fn length(&self) -> f64 {
        self.begins[self.edges.len()]
    }

    /// Least and greatest corner of the box around it [mm].
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        let ([x0, x1], [y0, y1]) = (extent(&self.edges, DVec2::X), extent(&self.edges, DVec2::Y));
        [DVec2::new(x0, y0), DVec2::new(x1, y1)]
    }

    /// The stretch of an edge along the length [mm].
    pub(super) fn stretch(&self, edge: usize) -> [f64; 2] {
        [self.begins[edge], self.begins[edge + 1]]
    }

    /// The edge at a place along the length, and the share of it.
    pub(super) fn locate(&self, s: f64) -> (usize, f64) {
        let s = s.rem_euclid(self.length());
        let edge = (self.begins.partition_point(|b| *b <= s) - 1).min(self.edges.len() - 1);
        let length = self.begins[edge + 1] - self.begins[edge];
        (edge, ((s - self.begins[edge]) / length).clamp(0.0, 1.0))
    }

    /// The point at a place along the length, and the direction of travel.
    pub(super) fn at(&self, s: f64) -> (DVec2, DVec2) {
        let (edge, share) = self.locate(s);
        let e = &self.edges[edge];
        (e.at(share), DVec2::from_angle(e.heading(share)))
    }

    /// The place that is nearest to a point, along the length.
    pub(super) fn nearest(&self, p: DVec2) -> f64 {
        let place = |i: usize| {
            let (share, distance) = self.edges[i].nearest(p);
            (self.begins[i] + share * (self.begins[i + 1] - self.begins[i]), distance)
        };
        let best = (0..self.edges.len()).map(place).min_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or(0.0, |(s, _)| s)
    }

    /// The edges between two places along the length, the second beyond the first; both may lie beyond the end.
    pub(super) fn part(&self, from: f64, to: f64) -> Vec<OutlineEdge> {
        let (mut parts, whole) = (Vec::new(), self.length());
        // Both from one remainder: a quotient of its own may round to the next turn.
        let within = from.rem_euclid(whole);
        let mut turn = ((from - within) / whole).round();
        let (mut edge, _) = self.locate(within);
        loop {
            let base = turn * whole;
            let (a, b) = (base + self.begins[edge], base + self.begins[edge + 1]);
            let share = |s: f64| ((s - a) / (b - a)).clamp(0.0, 1.0);
            let (low, high) = (share(from), share(to));
            if (high - low) * (b - a) > NOTHING {
                parts.push(self.edges[edge].part(low, high));
            }
            if b >= to {
                return parts;
            }
            edge += 1;
            if edge == self.edges.len() {
                (edge, turn) = (0, turn + 1.0);
            }
        }
    }
}

/// Least and greatest length along a direction [mm].
fn extent(edges: &[OutlineEdge], direction: DVec2) -> [f64; 2] {
    edges.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], edge| {
        let [a, b] = edge.extent(direction);
        [if a < low { a } else { low }, if b > high { b } else { high }]
    })
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;
    use crate::geom::Outline;

    #[test]
    fn parts_that_begin_within_rounding_of_a_turn_are_whole() {
        let square = [dvec2(0.0, 0.0), dvec2(0.0, 10.1), dvec2(10.1, 10.1), dvec2(10.1, 0.0)];
        let track = Track::new(Outline::polygon(&square).expect("a square").edges().to_vec());
        let whole = track.length();
        for turn in 0..200 {
            let exact = f64::from(turn) * whole;
            for from in [exact.next_down(), exact, exact.next_up(), exact - 1e-12] {
                let length: f64 = track.part(from, from + 12.0).iter().map(OutlineEdge::length).sum();
                assert!((length - 12.0).abs() < 1e-9, "{turn} {from} {length}");
            }
        }
    }

    #[test]
    fn parts_run_over_the_end_and_join() {
        let square = [dvec2(0.0, 0.0), dvec2(0.0, 10.0), dvec2(10.0, 10.0), dvec2(10.0, 0.0)];
        let track = Track::new(Outline::polygon(&square).expect("a square").edges().to_vec());
        assert!((track.length() - 40.0).abs() < 1e-12);
        for (from, to) in [(3.0, 7.0), (35.0, 48.0), (0.0, 40.0), (39.0, 81.0), (-5.0, 5.0), (10.0, 10.5)] {
            let parts = track.part(from, to);
            let length: f64 = parts.iter().map(OutlineEdge::length).sum();
            assert!((length - (to - from)).abs() < 1e-9, "{from} {to} {length}");
            assert!(parts.windows(2).all(|w| w[0].end.distance(w[1].start) < 1e-12));
            assert!(parts[0].start.distance(track.at(from).0) < 1e-12);
        }
        assert!((track.nearest(dvec2(-3.0, 4.0)) - 4.0).abs() < 1e-12);
    }
}
