//! Whether loops are the offset of an outline.
//!
//! Looked at: three points of each edge, which lie at the distance from the outline and on its right side; the joints; the
//! turning of each loop, once around; and points of the outline, each moved by the distance: one that keeps it from all of
//! the outline belongs to the offset, and lies on one of its loops. So nothing is missing either.

use std::f64::consts::TAU;

use glam::DVec2;

use super::failed;
use crate::base::Result;
use crate::geom::outline::NearestEdge;
use crate::geom::{Outline, OutlineEdge};
use crate::num::angle::wrap;

/// Largest gap of a joint, and largest difference of a distance [mm].
const LARGEST: f64 = 1e-6;
/// Turn of a corner that is taken for half a turn: it may go either way [rad].
const HALF_TURN: f64 = std::f64::consts::PI - 1e-3;

/// Distance before a tip at which the face is or is not [mm].
const TIP: f64 = 1e-4;

/// An outline and a distance, ready to look at loops.
pub(super) struct Check<'a> {
    outline: &'a Outline,
    distance: f64,
    near: NearestEdge,
}

impl<'a> Check<'a> {
    pub(super) fn new(outline: &'a Outline, distance: f64) -> Check<'a> {
        Check { outline, distance, near: NearestEdge::of(outline) }
    }

    /// The edges of the outline.
    pub(super) fn near(&self) -> &NearestEdge {
        &self.near
    }

    /// Looks at loops.
    ///
    /// # Errors
    /// `KC0806` with the first place that is wrong.
    pub(super) fn of(&self, loops: &[Vec<OutlineEdge>]) -> Result<()> {
        for edges in loops {
            self.joints(edges)?;
            self.turning(edges)?;
            for edge in edges {
                for share in [0.0, 0.25, 0.5] {
                    self.point(edge.at(share))?;
                }
            }
        }
        self.whole(loops)
    }

    fn error(&self, what: &str, at: DVec2) -> Result<()> {
        Err(failed(what, at, self.distance))
    }

    fn largest(&self) -> f64 {
        LARGEST.max(self.near.rounding())
    }

    fn joints(&self, edges: &[OutlineEdge]) -> Result<()> {
        for (i, edge) in edges.iter().enumerate() {
            let next = &edges[(i + 1) % edges.len()];
            if !(edge.end.distance(next.start) <= self.largest()) {
                return self.error("has a gap", edge.end);
            }
        }
        Ok(())
    }

    fn turning(&self, edges: &[OutlineEdge]) -> Result<()> {
        let sweeps: f64 = edges.iter().filter_map(|e| e.turn).map(|t| t.sweep).sum();
        let corner = |i: usize| {
            let (edge, next) = (&edges[i], &edges[(i + 1) % edges.len()]);
            wrap(next.heading(0.0) - edge.heading(1.0))
        };
        let corners: f64 = (0..edges.len()).map(corner).sum();
        // A corner of half a turn, that of a loop without width, goes either way.
        let off = ((sweeps + corners).abs() - TAU).abs();
        let is_once = off < 1e-3 || (0..edges.len()).any(|i| corner(i).abs() > HALF_TURN);
        if is_once { Ok(()) } else { self.error("does not turn once", edges[0].start) }
    }

    /// A point of the offset.
    fn point(&self, p: DVec2) -> Result<()> {
        let wanted = -self.distance;
        let largest = self.largest();
        match self.near.at(p, wanted.abs() + largest) {
            Some(nearest) if (nearest.distance - wanted).abs() <= largest => Ok(()),
            _ => self.error("does not keep its distance", p),
        }
    }

    /// Distance of a point from the outline, as far as it is less than another [mm].
    fn room(&self, p: DVec2, within: f64) -> f64 {
        self.near.at(p, within).map_or(within, |n| n.distance.abs())
    }

    /// Whether a place of a moved edge is where the face is as wide as twice the distance, but not beside it along the edge: the
    /// offset is a point there, which is no path.
    fn is_point(&self, place: &dyn Fn(f64, f64) -> DVec2, s: f64, length: f64) -> bool {
        /// Part of the distance along the edge at which the face must be narrower.
        const BESIDE: f64 = 0.01;
        let (distance, rounding) = (self.distance.abs(), self.near.rounding());
        let farther = distance + 4.0 * rounding;
        let has_width =
            self.room(place(s, farther.copysign(self.distance)), farther) > distance + 2.0 * rounding;
        let step = BESIDE * distance / length;
        let is_narrower = |s: f64| self.room(place(s, self.distance), distance) < distance - rounding;
        !has_width && [s - step, s + step].into_iter().all(|s| is_narrower(s.clamp(0.0, 1.0)))
    }

    /// Points that belong to the offset.
    fn whole(&self, loops: &[Vec<OutlineEdge>]) -> Result<()> {
        const SHARES: [f64; 5] = [0.03, 0.26, 0.5, 0.74, 0.97];
        let edges: Vec<OutlineEdge> = loops.concat();
        let found = NearestEdge::new(&edges);
        let least = self.distance.abs() - self.near.rounding();
        let has_room = |p: DVec2| self.room(p, self.distance.abs()) >= least;
        // A loop may begin or end within the rounding of where its candidates meet.
        let apart = 10.0 * self.largest();
        let look = |place: &dyn Fn(f64, f64) -> DVec2, s: f64, length: f64| {
            let p = place(s, self.distance);
            if !has_room(p) || found.at(p, apart).is_some() || self.is_point(place, s, length) {
                return Ok(());
            }
            self.error("lacks a loop", p)
        };
        for one in self.outline.loops() {
            let edges = &self.outline.edges()[one.edges.clone()];
            for (i, edge) in edges.iter().enumerate() {
                // An arc that is too small for the distance leaves nothing.
                let room = self.distance.abs() + self.largest();
                let vanishes = edge.turn.is_some_and(|t| t.sweep * self.distance < 0.0 && t.radius <= room);
                if !vanishes {
                    let moved = |s: f64, by: f64| edge.at(s) - by * DVec2::from_angle(edge.outward(s));
                    let radius = edge.turn.map(|t| t.radius + self.distance * t.sweep.signum());
                    let length = edge.turn.zip(radius).map_or(edge.length(), |(t, r)| (r * t.sweep).abs());
                    for s in SHARES {
                        look(&moved, s, length)?;
                    }
                }
                let next = &edges[(i + 1) % edges.len()];
                let mut turn = wrap(next.heading(0.0) - edge.heading(1.0));
                if turn.abs() > HALF_TURN {
                    // The face is all around the tip, or only behind it.
                    let before = edge.end + TIP * DVec2::from_angle(edge.heading(1.0));
                    turn = turn.abs().copysign(if self.outline.contains(before) { 1.0 } else { -1.0 });
                }
                if turn * self.distance > 0.0 && turn.abs() > 1e-6 {
                    let around =
                        |s: f64, by: f64| edge.end - by * DVec2::from_angle(edge.outward(1.0) + s * turn);
                    for s in SHARES {
                        look(&around, s, (self.distance * turn).abs())?;
                    }
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::super::offset;
    use super::*;

    fn plate() -> Outline {
        let corners = [dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(60.0, 40.0), dvec2(0.0, 40.0)];
        let mut loops = vec![Outline::polygon(&corners).unwrap().edges().to_vec()];
        loops.push(vec![OutlineEdge::arc(dvec2(20.0, 20.0), 5.0, 0.4, TAU)]);
        Outline::new(loops, vec![]).unwrap()
    }

    #[test]
    fn whatever_is_wrong_with_an_offset_is_seen() {
        let plate = plate();
        for distance in [4.0, -3.0] {
            let check = Check::new(&plate, distance);
            let right: Vec<Vec<OutlineEdge>> =
                offset(&plate, distance).unwrap().loops.into_iter().map(|l| l.edges).collect();
            assert!(right.len() == 2 && check.of(&right).is_ok());
            let wrong = |change: &dyn Fn(&mut Vec<Vec<OutlineEdge>>)| {
                let mut loops = right.clone();
                change(&mut loops);
                check.of(&loops).unwrap_err().to_string()
            };
            for left_out in [0, 1] {
                let message = wrong(&|loops| {
                    loops.remove(left_out);
                });
                assert!(message.contains("lacks a loop"), "{message}");
            }
            let gap = wrong(&|loops| loops[0][0].end += dvec2(2e-6, 2e-6));
            assert!(gap.contains("gap"), "{gap}");
            let moved =
                wrong(&|loops| loops[1] = loops[1].iter().map(|e| e.moved(0.0, dvec2(1e-5, 0.0))).collect());
            assert!(moved.contains("distance"), "{moved}");
            let other = offset(&plate, 1.01 * distance).unwrap().loops;
            assert!(wrong(&|loops| loops[0] = other[0].edges.clone()).contains("distance"));
            let twice = wrong(&|loops| {
                let again = loops[0].clone();
                loops[0].extend(again);
            });
            assert!(twice.contains("turn once"), "{twice}");
            // The loop on the other side of the edges has the distance too.
            let beyond = offset(&plate, -distance).unwrap().loops;
            assert!(wrong(&|loops| loops[0] = beyond[0].edges.clone()).contains("distance"));
        }
    }
}
