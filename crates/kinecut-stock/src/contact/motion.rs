//! Motion of a body in the coordinates of another.

use glam::DVec3;

use crate::geom::Rigid;
use crate::sweep::ToolMotion;

/// A ball that holds a body, in the body's coordinates [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ball {
    pub(super) centre: DVec3,
    pub(super) radius: f64,
}

impl Ball {
    /// A bound on the distance of the places of each of its points in two poses [mm].
    pub(super) fn travel(&self, from: &Rigid, to: &Rigid) -> f64 {
        let by = to.rotation - from.rotation;
        let turned = [by.x_axis, by.y_axis, by.z_axis].map(DVec3::length_squared).iter().sum::<f64>().sqrt();
        (to.point(self.centre) - from.point(self.centre)).length() + self.radius * turned
    }
}

/// A motion over `t` from 0 to 1.
pub(super) trait Motion {
    /// From the coordinates of the moving body into those of the other one; not of numbers where it is not known.
    fn pose(&self, t: f64) -> Rigid;

    /// A bound on the distance of the points of a ball from straight lines between their places at two moments [mm].
    fn room(&self, from: f64, to: f64, ball: &Ball) -> f64;
}

impl Motion for ToolMotion {
    fn pose(&self, t: f64) -> Rigid {
        ToolMotion::pose(self, t)
    }

    fn room(&self, from: f64, to: f64, ball: &Ball) -> f64 {
        self.chord_error(from, to, ball.centre.length() + ball.radius)
    }
}

/// A motion whose body is lifted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lifted<'a, M: ?Sized> {
    pub(super) motion: &'a M,
    /// In the coordinates of the other body [mm].
    pub(super) by: DVec3,
}

impl<M: Motion + ?Sized> Motion for Lifted<'_, M> {
    fn pose(&self, t: f64) -> Rigid {
        let pose = self.motion.pose(t);
        Rigid { translation: pose.translation + self.by, ..pose }
    }

    fn room(&self, from: f64, to: f64, ball: &Ball) -> f64 {
        self.motion.room(from, to, ball)
    }
}

/// A body that does not move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing(pub(super) Rigid);

impl Motion for Standing {
    fn pose(&self, _: f64) -> Rigid {
        self.0
    }

    fn room(&self, _: f64, _: f64, _: &Ball) -> f64 {
        0.0
    }
}

/// A moment of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    pub(super) t: f64,
    pub(super) pose: Rigid,
}

impl Moment {
    pub(super) fn of(motion: &(impl Motion + ?Sized), t: f64) -> Moment {
        Moment { t, pose: motion.pose(t) }
    }

    /// Whether the pose is known. Where it is not, a search ends: the move is one in which nothing counts as compared.
    pub(super) fn is_known(&self) -> bool {
        self.pose.translation.is_finite()
    }
}
