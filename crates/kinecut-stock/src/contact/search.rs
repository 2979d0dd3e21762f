//! The time at which a part of a tool first comes to a piece of a body, the time at which it last leaves it, and how near it comes.
//!
//! In a stretch of a move the part keeps within a distance of the hull of its places at the two ends. The distance of that hull
//! from the piece bounds that of the part: a stretch in which the part stays away is left out, another one is halved.

use glam::DVec3;

use super::body::Piece;
use super::gap::{Gap, gap};
use super::tool::{Between, Placed, Round};
use crate::geom::Rigid;
use crate::sweep::ToolMotion;

/// Travel [mm] of a part in a stretch that is not halved again: the accuracy of the times of a contact.
const LEAST_TRAVEL: f64 = 0.004;
/// A stretch of time that is not halved again, whatever it travels.
const LEAST_TIME: f64 = 1e-12;
/// Distance [mm] of a part from the hull of its places up to which a stretch is not halved for a distance.
const STRAIGHT: f64 = 1e-3;

/// A moment of a move with the pose of the tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    pub(super) t: f64,
    pub(super) pose: Rigid,
}

/// A part that moves past a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search<'a> {
    pub(super) motion: &'a ToolMotion,
    pub(super) round: &'a Round,
    /// Farthest point of the tool from its tip [mm].
    pub(super) reach: f64,
    pub(super) piece: &'a Piece,
    /// The piece is lower by this [mm], in the coordinates of the moves.
    pub(super) lift: DVec3,
}

impl Search<'_> {
    fn moment(&self, t: f64) -> Moment {
        moment(self.motion, self.lift, t)
    }

    /// Distance of the piece from the hull of two places, and the room of the part around that hull.
    fn gap(&self, [from, to]: &[Moment; 2], near: f64, far: f64) -> (Gap, f64) {
        let room = self.motion.chord_error(from.t, to.t, self.reach);
        let placed = |moment: &Moment| Placed { round: self.round, pose: moment.pose };
        (gap(&Between([placed(from), placed(to)]), self.piece, near, far + room), room)
    }

    /// The first time in a stretch at which the part is no farther than `touch` from the piece, and the place; the last one
    /// where `back`. A part that stays farther away by a hundredth of a millimetre is not found.
    pub(super) fn touch(&self, stretch: [Moment; 2], touch: f64, back: bool) -> Option<(f64, DVec3)> {
        let (gap, room) = self.gap(&stretch, 0.0, touch);
        if gap.least > touch + room {
            return None;
        }
        let [from, to] = stretch;
        let turned = (to.pose.rotation.z_axis - from.pose.rotation.z_axis).length();
        let travel =
            (to.pose.translation - from.pose.translation).length() + self.reach * turned + 2.0 * room;
        if travel <= LEAST_TRAVEL || to.t - from.t <= LEAST_TIME {
            return Some((if back { to.t } else { from.t }, gap.place));
        }
        let middle = self.moment(0.5 * (from.t + to.t));
        let (sooner, later) = ([from, middle], [middle, to]);
        let (one, other) = if back { (later, sooner) } else { (sooner, later) };
        self.touch(one, touch, back).or_else(|| self.touch(other, touch, back))
    }

    /// The least distance in a stretch where it is less than `best`, and the place on the piece.
    pub(super) fn nearest(&self, stretch: [Moment; 2], best: f64) -> Option<(f64, DVec3)> {
        let (gap, room) = self.gap(&stretch, 0.0, best);
        if gap.least - room >= best - STRAIGHT {
            return None;
        }
        let [from, to] = stretch;
        if room <= STRAIGHT || to.t - from.t <= LEAST_TIME {
            return Some((gap.most, gap.place));
        }
        let middle = self.moment(0.5 * (from.t + to.t));
        let first = self.nearest([from, middle], best);
        let best = first.map_or(best, |found| found.0);
        self.nearest([middle, to], best).or(first)
    }
}

/// A moment of a move of a tool that is lifted.
pub(super) fn moment(motion: &ToolMotion, lift: DVec3, t: f64) -> Moment {
    let pose = motion.pose(t);
    Moment { t, pose: Rigid { translation: pose.translation + lift, ..pose } }
}
