//! The place of the programmed path that is nearest to a tool that runs along it.
//!
//! A control leaves the path at joints, and its way is then shorter than the programmed one: the way that it has run says
//! less and less about the place. So from sample to sample the nearest place is looked for: on the present curve, and
//! beyond a joint on the other side of it as far as the tool's distance from the joint allows. A path that comes back
//! to a place, as rings do, is never left for a part of it that is later.

use glam::DVec3;

use super::PassPiece;
use crate::geom::Jet;

/// Steps of Newton's method from sample to sample: they start within a step of the cycle.
const STEPS: usize = 4;
/// Way to the nearest place of a curve over the distance of the tool from its end.
const REACH: f64 = 2.0;

/// A tool that is followed along a path.
pub(super) struct Track<'a> {
    pieces: &'a [PassPiece],
    starts: &'a [f64],
    /// Way on which the tool is [mm], and the curve there.
    s: f64,
    piece: usize,
}

impl<'a> Track<'a> {
    /// At the start of the path; `starts`: way at the start of each curve and at the end of the last one [mm].
    pub(super) fn new(pieces: &'a [PassPiece], starts: &'a [f64]) -> Track<'a> {
        Track { pieces, starts, s: 0.0, piece: 0 }
    }

    /// The way at the nearest place to a tool that has run a way since the last sample [mm], and its distance [mm].
    pub(super) fn follow(&mut self, tool: DVec3, run: f64) -> (f64, f64) {
        let Some(mut best) = self.nearest_on(self.piece, tool, self.s + run) else { return (self.s, 0.0) };
        let mut on = self.piece;
        for next in self.piece + 1..self.pieces.len() {
            let joint = self.starts[next];
            let from_joint = (self.pieces[next].curve.start() - tool).length();
            if joint - self.s > REACH * from_joint + 2.0 * run {
                break;
            }
            let Some(found) = self.nearest_on(next, tool, self.s + run) else { break };
            // At a joint itself the next curve is as near.
            if found.1 <= best.1 {
                (best, on) = (found, next);
            }
        }
        self.s = if best.0 > self.s { best.0 } else { self.s };
        self.piece = on;
        (self.s, best.1)
    }

    /// The nearest place of a curve, from a way on that is near to it [mm], and its distance [mm]; not before the present place.
    fn nearest_on(&self, piece: usize, tool: DVec3, near: f64) -> Option<(f64, f64)> {
        let curve = &self.pieces.get(piece)?.curve;
        let (start, end) = (self.starts[piece], self.starts[piece + 1]);
        let start_here = if self.s > start { self.s } else { start };
        let inside = |s: f64| s.clamp(start_here, if end > start_here { end } else { start_here });
        let at = |s: f64| curve.at((s - start).clamp(0.0, curve.length()));
        let mut s = inside(near);
        for _ in 0..STEPS {
            let jet: Jet = at(s);
            let off = tool - jet.p;
            // The distance is least where the tool is square to the path; its bend changes the step.
            let bend = 1.0 - off.dot(jet.d2);
            let step = off.dot(jet.d1) / if bend.is_finite() && bend > 0.5 { bend } else { 1.0 };
            if !step.is_finite() || step == 0.0 {
                break;
            }
            s = inside(s + step);
        }
        Some((s, (at(s).p - tool).length()))
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;
    use crate::geom::{Arc, Line};

    fn path() -> (Vec<PassPiece>, Vec<f64>) {
        let lines = [
            Line { start: dvec3(0.0, 0.0, 0.0), end: dvec3(10.0, 0.0, 0.0) },
            Line { start: dvec3(10.0, 0.0, 0.0), end: dvec3(10.0, 8.0, 0.0) },
        ];
        let pieces: Vec<PassPiece> =
            lines.into_iter().map(|line| PassPiece { curve: line.into(), feed: 100.0 }).collect();
        (pieces, vec![0.0, 10.0, 18.0])
    }

    #[test]
    fn a_tool_that_cuts_a_corner_is_at_the_nearest_place_and_behind_it_at_the_programmed_way() {
        let (pieces, starts) = path();
        let mut track = Track::new(&pieces, &starts);
        let mut farthest: f64 = 0.0;
        let mut before = 0.0;
        for k in 0..=160 {
            // To 3 mm before the corner, across it, and on.
            let run = 0.1 * f64::from(k);
            let across = 18f64.sqrt();
            let tool = if run <= 7.0 {
                dvec3(run, 0.0, 0.0)
            } else if run <= 7.0 + across {
                dvec3(7.0, 0.0, 0.0) + (run - 7.0) / across * dvec3(3.0, 3.0, 0.0)
            } else {
                dvec3(10.0, 3.0 + run - 7.0 - across, 0.0)
            };
            let (s, off) = track.follow(tool, if k > 0 { 0.1 } else { 0.0 });
            assert!(s >= before, "{run} {s}");
            before = s;
            farthest = farthest.max(off);
            // By hand.
            let [along, up] = [tool.x, tool.y];
            let want = if up < 10.0 - along { along } else { 10.0 + up };
            assert!((s - want).abs() < 1e-9, "{tool}: {s}, by hand {want}");
        }
        assert!((farthest - 1.5).abs() < 0.08, "{farthest}");
    }

    #[test]
    fn a_ring_is_not_left_where_it_begins() {
        let (mut pieces, mut starts) = path();
        pieces.truncate(1);
        let centre = dvec3(13.0, 0.0, 0.0);
        let ring = Arc::new(dvec3(10.0, 0.0, 0.0), centre, DVec3::Z, std::f64::consts::TAU, 0.0).unwrap();
        pieces.push(PassPiece { curve: ring.into(), feed: 100.0 });
        let out = Line { start: dvec3(10.0, 0.0, 0.0), end: dvec3(2.0, 0.0, 0.0) };
        pieces.push(PassPiece { curve: out.into(), feed: 100.0 });
        let around = 6.0 * std::f64::consts::PI;
        starts = vec![starts[0], 10.0, 10.0 + around, 18.0 + around];
        let mut track = Track::new(&pieces, &starts);
        for k in 0..=((10.0 + around + 8.0) / 0.05) as u32 {
            let way = 0.05 * f64::from(k);
            let piece = starts.partition_point(|s| *s <= way).clamp(1, 3) - 1;
            let tool = pieces[piece].curve.at(way - starts[piece]).p;
            let (s, off) = track.follow(tool, if k > 0 { 0.05 } else { 0.0 });
            assert!((s - way).abs() < 1e-6 && off < 1e-9, "{way}: {s} {off}");
        }
    }
}
