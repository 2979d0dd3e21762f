//! A link of a machine in the coordinates of another one.

use std::ops::Range;

use super::super::motion::{Ball, Motion};
use super::way::Way;
use crate::geom::Rigid;
use crate::machine::{Kinematics, MOST_JOINTS};
use crate::sweep::chain_acceleration;

/// Motion of a link, seen from a link nearer to the work, along the way of all joints.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkMotion<'a> {
    pub(super) way: &'a Way<'a>,
    /// The joints between the two.
    pub(super) chain: &'a Kinematics,
    pub(super) first: usize,
    pub(super) last: usize,
    /// From the coordinates of the moving body into those of the machine at home.
    pub(super) place: Rigid,
}

/// A stretch in which no bound on the motion of a joint is found, and which is that short, is a jump at a pole: only its ends are known.
const JUMP: f64 = 1e-9;

impl LinkMotion<'_> {
    fn joints(&self) -> Range<usize> {
        self.first..self.last
    }
}

impl Motion for LinkMotion<'_> {
    fn pose(&self, t: f64) -> Rigid {
        self.chain.forward(&self.way.at(t)[self.joints()]).after(&self.place)
    }

    fn room(&self, from: f64, to: f64, ball: &Ball) -> f64 {
        let rates = self.way.rates(from, to);
        let own = &rates[self.joints()];
        let step = to - from;
        if own.iter().any(|(rate, _)| rate.is_infinite()) {
            return if step > JUMP { f64::INFINITY } else { 0.0 };
        }
        if self.way.is_still() {
            // Linear joints only, of directions of unit length.
            return 0.125 * step * step * own.iter().map(|(_, bend)| bend).sum::<f64>();
        }
        if own.iter().all(|rate| *rate == (0.0, 0.0)) {
            return 0.0;
        }
        let middle = self.way.at(0.5 * (from + to));
        let mut q = [0.0; MOST_JOINTS];
        q[..own.len()].copy_from_slice(&middle[self.joints()]);
        let jacobian = self.chain.jacobian(&q[..own.len()]);
        let centre = jacobian.frame.point(self.place.point(ball.centre));
        let acceleration = chain_acceleration(jacobian.twists(), centre, ball.radius, 0.5 * step, |i| own[i]);
        0.125 * step * step * acceleration
    }
}
