//! A bound on how far a move is from straight lines between its poses.
//!
//! Between two moments a point of the tool leaves the straight line by at most `h^2/8 max |p''|`. The bound on the acceleration
//! holds for every point within a reach of the tip and for every moment between the two: joints are taken at the middle and
//! given the room in which they can move. If two motions keep all points of the tool within `e`, so do the volumes they sweep.

use glam::DVec3;

use super::{Kind, ToolMotion, joints};
use crate::machine::Kinematics;
use crate::machine::kinematics::Twist;

impl ToolMotion {
    /// A bound on the distance [mm] of the points within `reach` of the tip from straight lines between their places at `from`
    /// and `to`. Strict, but for tips on spirals and cubics, whose curvature is sampled.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::Rigid;
    /// use kinecut::machine::kinematics::Twist;
    /// use kinecut::sweep::ToolMotion;
    /// let turn = Twist { turn: DVec3::X * 0.1, shift: DVec3::ZERO };
    /// let motion = ToolMotion::screw(Rigid::IDENTITY, turn).unwrap();
    /// assert!((motion.chord_error(0.0, 1.0, 30.0) - 30.0 * 0.01 / 8.0).abs() < 1e-15); // L angle^2 / 8
    /// ```
    pub fn chord_error(&self, from: f64, to: f64, reach: f64) -> f64 {
        let step = to - from;
        0.125 * step * step * self.most_acceleration(from, to, reach)
    }

    /// A bound on the acceleration of the points within `reach` of the tip between two moments [mm by `t` squared].
    pub(crate) fn most_acceleration(&self, from: f64, to: f64, reach: f64) -> f64 {
        match &self.kind {
            Kind::Turning { curve, rate, .. } => curve.most_bend(from, to) + rate.length_squared() * reach,
            Kind::Joints { chain, from: q0, to: q1, .. } => {
                let jacobian = chain.jacobian(&joints::between(q0, q1, 0.5 * (from + to)));
                chain_acceleration(
                    jacobian.twists(),
                    jacobian.frame.translation,
                    reach,
                    0.5 * (to - from),
                    |i| (q1[i] - q0[i], 0.0),
                )
            }
            Kind::TipAndJoints { curve, chain, from: q0, to: q1, .. } => {
                curve.most_bend(from, to) + turning_acceleration(chain, |i| q1[i] - q0[i]) * reach
            }
            Kind::Screw { twist, .. } => {
                let w = twist.turn;
                w.cross(twist.shift).length() + w.length_squared() * reach
            }
        }
    }

    /// True if the bound on the acceleration rests on samples of the curvature: the tip goes along a spiral or a cubic.
    pub(crate) fn is_sampled(&self) -> bool {
        match &self.kind {
            Kind::Turning { curve, .. } | Kind::TipAndJoints { curve, .. } => curve.is_bend_sampled(),
            Kind::Joints { .. } | Kind::Screw { .. } => false,
        }
    }

    /// A bound on the rate of turning at all moments [rad by `t`].
    pub(crate) fn most_turn(&self) -> f64 {
        let rotary = |chain: &Kinematics, rate: &dyn Fn(usize) -> f64| -> f64 {
            let twists = chain.jacobian(&[]);
            twists.twists().iter().enumerate().map(|(i, t)| t.turn.length() * rate(i).abs()).sum()
        };
        match &self.kind {
            Kind::Turning { rate, .. } => rate.length(),
            Kind::Joints { chain, from, to, .. } | Kind::TipAndJoints { chain, from, to, .. } => {
                rotary(chain, &|i| to[i] - from[i])
            }
            Kind::Screw { twist, .. } => twist.turn.length(),
        }
    }

    /// A bound on the speed of the points within `reach` of the tip at `t` [mm by `t`].
    pub fn speed(&self, t: f64, reach: f64) -> f64 {
        let twist = self.at(t).twist;
        twist.shift.length() + twist.turn.length() * reach
    }
}

/// A bound on `|w'| + |w|^2` of a chain whose joints go straight: each rotary joint carries those behind it.
fn turning_acceleration(chain: &Kinematics, rate: impl Fn(usize) -> f64) -> f64 {
    let twists = chain.jacobian(&[]);
    let (mut sum, mut carried) = (0.0, 0.0);
    for (i, _) in twists.twists().iter().enumerate().filter(|(_, t)| t.turn != DVec3::ZERO) {
        let w = rate(i).abs();
        carried += w * sum;
        sum += w;
    }
    carried + sum * sum
}

/// A bound on the acceleration of all points in a ball, carried by the screws of a chain for at most `half` to both sides;
/// `rate` bounds the speed and the acceleration of a joint.
///
/// From the tool outwards: after each joint the ball holds every place of the points, with bounds on speed and acceleration.
pub(crate) fn chain_acceleration(
    twists: &[Twist],
    centre: DVec3,
    radius: f64,
    half: f64,
    rate: impl Fn(usize) -> (f64, f64),
) -> f64 {
    let (mut room, mut speed, mut acceleration) = (radius, 0.0, 0.0);
    for (i, twist) in twists.iter().enumerate().rev() {
        let (w, bend) = rate(i);
        let w = w.abs();
        if twist.turn == DVec3::ZERO {
            acceleration += bend * twist.shift.length();
            speed += w * twist.shift.length();
            room += w * twist.shift.length() * half;
            continue;
        }
        // Velocity of the centre by the joint is its distance from the axis; no joint shifts along its axis.
        let arm = twist.velocity(centre).length() + room;
        acceleration += 2.0 * w * speed + w * w * arm + bend * arm;
        speed += w * arm;
        room += w * arm * half;
    }
    acceleration
}
