//! Joints of a machine: its axes at home.

use glam::DVec3;

use super::Elementary;

/// Most joints of a machine.
pub const MOST_JOINTS: usize = 8;

/// An axis of a machine, in the frame of the machine with all axes at zero (home).
///
/// A positive value moves the tool side positively relative to the work side (ISO 841), for tables too: a table that
/// carries the work turns the other way, which ISO 841 writes X', C'.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Motion in the code.
    pub motion: Elementary,
    /// Address of the axis on the control: X Y Z, A B C, U V W.
    pub letter: char,
    /// Direction of the translation, or of the axis of the rotation, at home: a unit vector.
    pub direction: DVec3,
    /// A point of the axis of a rotation at home [mm].
    pub point: DVec3,
    /// Sense of the control's values: -1 where its positive direction is opposite to that of ISO 841.
    pub sense: f64,
    /// Least and greatest position [mm or rad], if known.
    pub travel: Option<[f64; 2]>,
    /// Limits of motion; rotary axes in rad/s, rad/s^2, rad/s^3.
    pub dynamics: Dynamics,
}

impl Joint {
    /// A joint of the standard direction, through the zero of the machine, without limits; an inclined rotation turns
    /// about Z until it gets its direction.
    pub fn standard(motion: Elementary) -> Joint {
        Joint {
            motion,
            letter: motion.letter().unwrap_or('B'),
            direction: motion.direction().unwrap_or(DVec3::Z),
            point: DVec3::ZERO,
            sense: 1.0,
            travel: None,
            dynamics: Dynamics::default(),
        }
    }
}

/// Limits of the motion of an axis, of a rotary one in rad instead of mm; `None` where not given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dynamics {
    /// Rapid speed [mm/s].
    pub rapid: Option<f64>,
    /// Acceleration [mm/s^2].
    pub acceleration: Option<f64>,
    /// Jerk [mm/s^3].
    pub jerk: Option<f64>,
}

impl Dynamics {
    /// These limits; missing ones are those of `before`.
    pub fn over(self, before: Dynamics) -> Dynamics {
        Dynamics {
            rapid: self.rapid.or(before.rapid),
            acceleration: self.acceleration.or(before.acceleration),
            jerk: self.jerk.or(before.jerk),
        }
    }
}

/// Positions of the joints of a machine, in the order of its code [mm or rad]; as a slice by `*`.
#[derive(Clone, Copy, PartialEq)]
pub struct JointValues {
    values: [f64; MOST_JOINTS],
    len: usize,
}

impl JointValues {
    /// This many joints, all at zero; more than [`MOST_JOINTS`] are cut off.
    pub fn zero(len: usize) -> JointValues {
        JointValues { values: [0.0; MOST_JOINTS], len: len.min(MOST_JOINTS) }
    }

    /// These positions; more than [`MOST_JOINTS`] are cut off.
    pub fn new(values: &[f64]) -> JointValues {
        let mut all = JointValues::zero(values.len());
        let len = all.len;
        all.values[..len].copy_from_slice(&values[..len]);
        all
    }
}

impl std::ops::Deref for JointValues {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.len]
    }
}

impl std::ops::DerefMut for JointValues {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.len]
    }
}

impl std::fmt::Debug for JointValues {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
