//! The time at which a piece of a body first comes to a piece of another, the time at which it last leaves it, and how near it comes.
//!
//! In a stretch of a move a piece keeps within a distance of the hull of its places at the two ends. The distance of that hull
//! from the other piece bounds that of the piece itself: a stretch in which it stays away is left out, another one is halved.

use glam::DVec3;

use super::gap::{Gap, gap};
use super::motion::{Ball, Moment, Motion};
use super::piece::{Between, Piece, Placed};

/// Travel [mm] of a piece in a stretch that is not halved again: the accuracy of the times of a contact.
const LEAST_TRAVEL: f64 = 0.004;
/// A stretch of time that is not halved again, whatever it travels.
const LEAST_TIME: f64 = 1e-12;
/// Distance [mm] of a piece from the hull of its places up to which a stretch is not halved for a distance.
const STRAIGHT: f64 = 1e-3;

/// A piece that moves past another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search<'a, M> {
    pub(super) motion: &'a M,
    pub(super) moving: &'a Piece,
    /// A ball that holds the moving body.
    pub(super) ball: Ball,
    /// A turn of the moving body about its Z changes nothing.
    pub(super) round: bool,
    pub(super) standing: &'a Piece,
}

/// The least distance of two pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest {
    /// The moment.
    pub(super) t: f64,
    /// The distance [mm].
    pub(super) distance: f64,
    /// The place on the standing piece.
    pub(super) place: DVec3,
}

impl<M: Motion> Search<'_, M> {
    /// Distance of the standing piece from the hull of two places, and the room of the moving one around that hull.
    fn gap(&self, [from, to]: &[Moment; 2], near: f64, far: f64) -> (Gap, f64) {
        let room = self.motion.room(from.t, to.t, &self.ball);
        let placed = |moment: &Moment| Placed { piece: self.moving, pose: moment.pose };
        (gap(&Between([placed(from), placed(to)]), self.standing, near, far + room), room)
    }

    /// The first time in a stretch at which the piece is no farther than `touch` from the other, and the place; the last one
    /// where `back`. A piece that stays farther away by a hundredth of a millimetre is not found.
    pub(super) fn touch(&self, stretch: [Moment; 2], touch: f64, back: bool) -> Option<(f64, DVec3)> {
        if !stretch.iter().all(Moment::is_known) {
            return None;
        }
        let (gap, room) = self.gap(&stretch, 0.0, touch);
        if gap.least > touch + room {
            return None;
        }
        let [from, to] = stretch;
        if self.travel(&from, &to) + 2.0 * room <= LEAST_TRAVEL || to.t - from.t <= LEAST_TIME {
            return Some((if back { to.t } else { from.t }, gap.place));
        }
        let middle = Moment::of(self.motion, 0.5 * (from.t + to.t));
        let (sooner, later) = ([from, middle], [middle, to]);
        let (one, other) = if back { (later, sooner) } else { (sooner, later) };
        self.touch(one, touch, back).or_else(|| self.touch(other, touch, back))
    }

    /// A bound on the distance of the places of each point of the moving body at two moments [mm].
    fn travel(&self, from: &Moment, to: &Moment) -> f64 {
        let (a, b) = (&from.pose, &to.pose);
        if !self.round {
            return self.ball.travel(a, b);
        }
        let turned = (b.rotation.z_axis - a.rotation.z_axis).length();
        (b.point(self.ball.centre) - a.point(self.ball.centre)).length() + self.ball.radius * turned
    }

    /// The least distance in a stretch where it is less than `best`, and the place on the standing piece.
    pub(super) fn nearest(&self, stretch: [Moment; 2], best: f64) -> Option<Nearest> {
        if !stretch.iter().all(Moment::is_known) {
            return None;
        }
        let (gap, room) = self.gap(&stretch, 0.0, best);
        if gap.least - room >= best - STRAIGHT {
            return None;
        }
        let [from, to] = stretch;
        if room <= STRAIGHT || to.t - from.t <= LEAST_TIME {
            return Some(Nearest { t: from.t, distance: gap.most, place: gap.place });
        }
        let middle = Moment::of(self.motion, 0.5 * (from.t + to.t));
        let first = self.nearest([from, middle], best);
        let best = first.map_or(best, |found| found.distance);
        self.nearest([middle, to], best).or(first)
    }
}
