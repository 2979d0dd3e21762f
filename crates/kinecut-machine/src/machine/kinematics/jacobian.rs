//! Jacobian: motion of the tool by the motion of one joint.

use glam::DVec3;

use super::Kinematics;
use crate::geom::Rigid;
use crate::machine::MOST_JOINTS;

/// A velocity of a rigid body, or a screw: the point `p` moves with `shift + turn x p`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Angular velocity [rad per unit].
    pub turn: DVec3,
    /// Velocity of the point at the origin of coordinates [mm per unit].
    pub shift: DVec3,
}

impl Twist {
    /// A rotation about an axis through a point.
    pub fn rotation(direction: DVec3, point: DVec3) -> Twist {
        Twist { turn: direction, shift: point.cross(direction) }
    }

    /// A translation.
    pub fn translation(direction: DVec3) -> Twist {
        Twist { turn: DVec3::ZERO, shift: direction }
    }

    /// Velocity of a point [mm per unit].
    pub fn velocity(&self, p: DVec3) -> DVec3 {
        self.shift + self.turn.cross(p)
    }
}

/// The Jacobian of a chain at one set of joint positions, in workpiece coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian {
    twists: [Twist; MOST_JOINTS],
    count: usize,
    /// The tip frame.
    pub frame: Rigid,
}

impl Jacobian {
    /// The motion of the tool for each joint, per mm or rad.
    pub fn twists(&self) -> &[Twist] {
        &self.twists[..self.count]
    }

    /// Velocity of the tip when the joint `i` moves [mm per mm or rad].
    pub fn tip_rate(&self, i: usize) -> DVec3 {
        self.twists[i].velocity(self.frame.translation)
    }

    /// Velocity of the direction of the tool when the joint `i` moves [1 per mm or rad].
    pub fn axis_rate(&self, i: usize) -> DVec3 {
        self.twists[i].turn.cross(self.frame.rotation.z_axis)
    }

    /// Velocity of tip and direction for velocities of the joints [mm/s or rad/s]: mm/s and 1/s.
    pub fn rates(&self, velocities: &[f64]) -> [DVec3; 2] {
        let mut sum = Twist::default();
        for (twist, &v) in self.twists().iter().zip(velocities) {
            sum.turn += twist.turn * v;
            sum.shift += twist.shift * v;
        }
        [sum.velocity(self.frame.translation), sum.turn.cross(self.frame.rotation.z_axis)]
    }

    /// The spin of the tool about its own axis, which does not matter for a cutter of revolution.
    pub fn spin(&self) -> Twist {
        Twist::rotation(self.frame.rotation.z_axis, self.frame.translation)
    }
}

impl Kinematics {
    /// The Jacobian at joint positions `q` [mm or rad]; positions that are missing count as zero.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let code = CoordinateCode::parse("612035").unwrap(); // C table, X, Y, bed, Z, B head
    /// let chain = Machine::new(code, [None; 3], Default::default()).unwrap().kinematics(0.0);
    /// let jacobian = chain.jacobian(&[0.0, 30.0, 0.0, 0.0, 0.0]);
    /// assert_eq!(jacobian.tip_rate(0), DVec3::new(0.0, 30.0, 0.0)); // C moves the tip along Y
    /// assert_eq!(jacobian.axis_rate(4), DVec3::X); // B tilts the tool towards X
    /// ```
    pub fn jacobian(&self, q: &[f64]) -> Jacobian {
        let mut twists = [Twist::default(); MOST_JOINTS];
        let mut before = self.to_work;
        for (i, screw) in self.screws[..self.count].iter().enumerate() {
            let here = screw.moved(&before);
            twists[i] = if screw.rotary {
                Twist::rotation(here.direction, here.point)
            } else {
                Twist::translation(here.direction)
            };
            before = before.after(&screw.motion(q.get(i).copied().unwrap_or(0.0)));
        }
        Jacobian { twists, count: self.count, frame: before.after(&self.tool) }
    }
}
