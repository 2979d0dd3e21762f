//! A tool at the middle of a stretch of its move, with bounds that hold for all of the stretch.
//!
//! A point `p` of the stock is seen from the tool at `x(t) = R^T (p - c)`. From the twist of the tool, `x' = -v(x)`, the velocity of
//! the tool's own point there; and `x'' = -a(x) + 2 w x v(x)`, `a` its acceleration. With bounds on both for all points
//! within a reach of the tip, `x` strays from its tangent by no more than `h^2 / 2 (A + 2 W V)` up to a time `h` from the middle.

use glam::DVec3;

use crate::geom::Rigid;
use crate::machine::kinematics::Twist;
use crate::sweep::ToolMotion;

/// Reach for which the bounds hold, in reaches of the tool.
pub(super) const ROOM: f64 = 1.5;

/// A tool at the middle of a stretch of its move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// Time at the middle, and half the stretch.
    pub(super) t: f64,
    pub(super) half: f64,
    pub(super) pose: Rigid,
    twist: Twist,
    /// Most that a point within [`ROOM`] reaches moves from the middle to an end [mm].
    pub(super) travel: f64,
    /// Most that a point of the stock strays from its tangent, seen from the tool [mm].
    pub(super) stray: f64,
    /// Most that the tool turns from the middle to an end [rad].
    pub(super) turn: f64,
}

/// A point seen from the tool, with its velocity there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) x: DVec3,
    /// Its way from the middle to the end, on the tangent [mm].
    pub(super) way: DVec3,
}

impl Moment {
    /// The stretch of a motion, of a tool with a reach [mm].
    pub(super) fn of(motion: &ToolMotion, [from, to]: [f64; 2], reach: f64) -> Moment {
        let (t, half, room) = (0.5 * (from + to), 0.5 * (to - from), ROOM * reach);
        let jet = motion.at(t);
        let (acceleration, turn) = (motion.most_acceleration(from, to, room), motion.most_turn());
        let speed = jet.twist.shift.length() + jet.twist.turn.length() * room + acceleration * half;
        Moment {
            t,
            half,
            pose: jet.pose,
            twist: jet.twist,
            travel: speed * half,
            stray: 0.5 * half * half * (acceleration + 2.0 * turn * speed),
            turn: turn * half,
        }
    }

    /// A point of the stock, seen from the tool at the middle.
    pub(super) fn see(&self, p: DVec3) -> Seen {
        let x = self.direction(p - self.pose.translation);
        Seen { x, way: self.twist.velocity(x) * -self.half }
    }

    /// A direction in the stock, seen from the tool at the middle.
    pub(super) fn direction(&self, d: DVec3) -> DVec3 {
        self.pose.rotation.transpose() * d
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Arc, Curve, Line};

    fn motions() -> Vec<ToolMotion> {
        let line = Curve::from(Line { start: DVec3::ZERO, end: DVec3::new(7.0, -4.0, 2.0) });
        let arc = Arc::new(DVec3::new(5.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 0.0), DVec3::Z, 2.0, 3.0).unwrap();
        let turn = Twist { turn: DVec3::new(0.2, -0.3, 0.1), shift: DVec3::new(3.0, 1.0, -2.0) };
        let (a, b) = (DVec3::new(0.1, 0.2, 1.0), DVec3::new(-0.4, 0.3, 0.8));
        vec![
            ToolMotion::fixed(line, a).unwrap(),
            ToolMotion::fixed(arc.into(), b).unwrap(),
            ToolMotion::between(arc.into(), a, b).unwrap(),
            ToolMotion::screw(Rigid::IDENTITY, turn).unwrap(),
        ]
    }

    #[test]
    fn a_point_keeps_to_its_tangent_as_far_as_the_bound_says() {
        let reach = 25.0;
        let mut used: f64 = 0.0;
        for motion in motions() {
            for stretch in [[0.0, 1.0], [0.2, 0.5], [0.7, 0.71]] {
                let moment = Moment::of(&motion, stretch, reach);
                for i in 0..60 {
                    let f = |k: f64| (f64::from(i) * k).sin() * 14.0;
                    let p = moment.pose.translation + DVec3::new(f(1.3), f(2.1), f(3.7));
                    let seen = moment.see(p);
                    for share in [-1.0, -0.6, 0.3, 1.0] {
                        let pose = motion.pose(moment.t + share * moment.half);
                        let x = pose.rotation.transpose() * (p - pose.translation);
                        let off = x.distance(seen.x + seen.way * share);
                        assert!(off <= moment.stray + 1e-12, "{motion:?} {stretch:?} {off} {moment:?}");
                        assert!(x.distance(seen.x) <= moment.travel + 1e-12);
                        used = used.max(off / (moment.stray + 1e-12));
                    }
                }
            }
        }
        // The bound is no empty one.
        assert!(used > 0.2, "{used}");
    }
}
