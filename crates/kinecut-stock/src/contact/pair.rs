//! A body that moves past another one.

use std::cell::Cell;

use glam::DVec3;

use super::body::Body;
use super::motion::{Lifted, Moment, Motion};
use super::search::{Nearest, Search};
use crate::geom::Aabb;

/// Distance [mm] up to which bodies touch: with the travel of a stretch no body is reported that stays 0.01 mm away.
pub(super) const TOUCH: f64 = 0.005;
/// Distance [mm] of a body from the hull of its places in a stretch that is not halved before its pieces are looked at.
const ROOM: f64 = 0.5;
/// Length of a stretch of a move that is not halved for that.
const LEAST_STRETCH: f64 = 1.0 / 4096.0;
/// A box that holds all.
const EVERYWHERE: Aabb = Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
/// Accuracy of the lift that clears a body [mm].
const LIFT: f64 = 0.01;

/// A body that moves, and one that stands in the coordinates of the motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a, M> {
    pub(super) motion: &'a M,
    pub(super) moving: &'a Body,
    pub(super) standing: &'a Body,
}

/// A stretch of a move in which a body keeps near the hull of its places at the ends.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    ends: [Moment; 2],
    /// Its distance from that hull [mm].
    room: f64,
}

/// Bodies that touch over a part of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// Part of the move, from 0 to 1, at which they first do.
    pub(super) from: f64,
    /// Part of the move at which they do for the last time.
    pub(super) to: f64,
    /// A place of the first contact.
    pub(super) place: DVec3,
}

/// Calls a function with the stretches of a move in which a body may come within a distance of a box.
fn stretches(
    motion: &impl Motion,
    moving: &Body,
    ends: [Moment; 2],
    (near, margin): (Aabb, f64),
    each: &mut impl FnMut(Stretch),
) {
    if !ends.iter().all(Moment::is_known) {
        return;
    }
    let room = motion.room(ends[0].t, ends[1].t, &moving.ball);
    let [from, to] = ends.map(|end| moving.bounds_at(&end.pose));
    if !from.union(to).grown(room + margin).meets(near) {
        return;
    }
    if room <= ROOM || ends[1].t - ends[0].t <= LEAST_STRETCH {
        each(Stretch { ends, room });
        return;
    }
    let middle = Moment::of(motion, 0.5 * (ends[0].t + ends[1].t));
    stretches(motion, moving, [ends[0], middle], (near, margin), each);
    stretches(motion, moving, [middle, ends[1]], (near, margin), each);
}

/// Whether a body may come within a distance of a box.
pub(super) fn may_meet(
    motion: &impl Motion,
    moving: &Body,
    ends: &[Moment; 2],
    near: Aabb,
    margin: f64,
) -> bool {
    let mut found = false;
    stretches(motion, moving, *ends, (near, margin), &mut |_| found = true);
    found
}

impl<M: Motion> Pair<'_, M> {
    /// The contact of the two, if there is one; of bodies that may be `off` [mm], of what may be one.
    pub(super) fn touch(&self, ends: &[Moment; 2], off: f64) -> Option<Touch> {
        let near = off + TOUCH;
        let mut met = self.within(ends);
        stretches(self.motion, self.moving, *ends, (self.standing.bounds, near), &mut |stretch| {
            let [start, end] = stretch.ends;
            self.pieces(
                &stretch,
                || near,
                |search| {
                    // Only what is sooner than the first, and later than the last.
                    if met.is_none_or(|m| start.t < m.from)
                        && let Some((from, place)) = search.touch([start, end], near, false)
                        && met.is_none_or(|m| from < m.from)
                    {
                        met = Some(Touch { from, to: met.map_or(from, |m| m.to), place });
                    }
                    if let Some(m) = &mut met
                        && end.t > m.to
                        && let Some((to, _)) = search.touch([start, end], near, true)
                        && to > m.to
                    {
                        m.to = to;
                    }
                },
            );
        });
        met
    }

    /// One body at an end of the move within another of triangles, away from all of them.
    pub(super) fn within(&self, ends: &[Moment; 2]) -> Option<Touch> {
        let [begin, end] = ends.map(|moment| {
            let moved = moment.pose.point(self.moving.a_point());
            let standing = self.standing.a_point();
            if self.standing.has_inside(moved) {
                Some(moved)
            } else {
                self.moving.has_inside(moment.pose.inverse().point(standing)).then_some(standing)
            }
        });
        let place = begin.or(end)?;
        let from = if begin.is_some() { ends[0].t } else { ends[1].t };
        let to = if end.is_some() { ends[1].t } else { ends[0].t };
        Some(Touch { from, to, place })
    }

    /// The least distance of the two where it is less than `near` [mm], and its place on the standing body.
    pub(super) fn nearest(&self, ends: &[Moment; 2], near: f64) -> Option<Nearest> {
        let best = Cell::new(near);
        let mut nearest: Option<Nearest> = None;
        stretches(self.motion, self.moving, *ends, (self.standing.bounds, near), &mut |stretch| {
            let margin = || best.get();
            self.pieces(&stretch, margin, |search| {
                if let Some(found) = search.nearest(stretch.ends, best.get()) {
                    best.set(found.distance);
                    nearest = Some(found);
                }
            });
        });
        nearest
    }

    /// Calls a function with the pieces that may come within a distance of each other.
    fn pieces(&self, stretch: &Stretch, margin: impl Fn() -> f64, mut each: impl FnMut(Search<'_, M>)) {
        let poses = stretch.ends.map(|end| end.pose);
        self.moving.pieces_between(
            &poses,
            || stretch.room + margin(),
            self.standing,
            |moving, region| {
                self.standing.pieces_in(region, |standing| {
                    let Body { ball, round, .. } = *self.moving;
                    each(Search { motion: self.motion, moving, ball, round, standing });
                });
            },
        );
    }
}

/// The lift along `up` with which bodies that move together clear one that stands, wherever it may be [mm].
pub(super) fn clearing<'a, M: Motion>(
    motion: &M,
    moving: impl Iterator<Item = &'a Body> + Clone,
    standing: &Body,
    up: DVec3,
) -> f64 {
    let mut lowest = f64::INFINITY;
    for body in moving.clone() {
        let ends = [0.0, 1.0].map(|t| Moment::of(motion, t));
        stretches(motion, body, ends, (EVERYWHERE, 0.0), &mut |stretch| {
            let poses = stretch.ends.map(|end| end.pose);
            lowest = lowest.min(body.lowest(&poses, up) - stretch.room);
        });
    }
    let corner = DVec3::select(up.cmpge(DVec3::ZERO), standing.bounds.max, standing.bounds.min);
    // Above all of the body it clears; in between it is sought where it begins to.
    let (mut meets, mut clears) = (0.0, (corner.dot(up) - lowest + standing.off + 2.0 * LIFT).max(LIFT));
    while clears - meets > LIFT {
        let lift = 0.5 * (meets + clears);
        let lifted = Lifted { motion, by: up * lift };
        let ends = [0.0, 1.0].map(|t| Moment::of(&lifted, t));
        let touches =
            |moving: &Body| Pair { motion: &lifted, moving, standing }.touch(&ends, standing.off).is_some();
        match moving.clone().any(touches) {
            true => meets = lift,
            false => clears = lift,
        }
    }
    clears
}
