//! Inverse kinematics in closed form: all joint positions that bring the tip to a point and the tool into a direction.
//!
//! Works for any order of up to three translations and up to two rotations, with any axes, offsets and senses; further
//! axes are held. The direction of the tool depends on the rotations only and is solved first ([`orient`]); the rest is
//! linear in the translations ([`place`]).

mod free;
mod orient;
mod pair;
mod place;
mod polar;

use glam::DVec3;

use super::Kinematics;
use crate::base::{Code, Finding, Result};
use crate::machine::JointValues;
use free::Free;

pub(super) use orient::{SLACK, branches, outside, tilt_range};
pub(super) use pair::{Pair, angle};

/// The chain of the axes that are free.
pub(super) fn free_chain<'a>(chain: &'a Kinematics, given: &[f64], locked: &[bool]) -> Result<Free<'a>> {
    Free::new(chain, given, locked)
}

/// One set of joint positions for a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Positions in the order of the chain [mm or rad]; free rotary axes in (-pi, pi].
    pub values: JointValues,
    /// True if an axis is not determined by the pose, and so keeps its given position: the tool is parallel to the
    /// first rotary axis, or the last one only spins the tool.
    pub singular: bool,
}

/// All solutions for a pose: one or two, as a slice by `*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solutions {
    list: [Solution; 2],
    len: usize,
}

impl Solutions {
    fn none() -> Solutions {
        Solutions { list: [Solution { values: JointValues::zero(0), singular: false }; 2], len: 0 }
    }

    fn push(&mut self, solution: Solution) {
        if let Some(slot) = self.list.get_mut(self.len) {
            *slot = solution;
            self.len += 1;
        }
    }
}

impl std::ops::Deref for Solutions {
    type Target = [Solution];

    fn deref(&self) -> &[Solution] {
        &self.list[..self.len]
    }
}

impl Kinematics {
    /// All joint positions for a tip [mm] and a direction of the tool (from tip to holder, any length) in workpiece
    /// coordinates. Axes that the pose leaves open keep their position of `given` [mm or rad]; what is missing there
    /// counts as zero.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let code = CoordinateCode::parse("641203").unwrap(); // C and A tables, X, Y, bed, Z
    /// let chain = Machine::new(code, [None; 3], Default::default()).unwrap().kinematics(0.0);
    /// let found = chain.inverse(DVec3::new(10.0, 0.0, 5.0), DVec3::new(0.0, -1.0, 1.0), &[]).unwrap();
    /// assert_eq!(found.len(), 2); // C and A, and C + 180 degrees and -A
    /// let a = found[0].values[1];
    /// assert!((a.abs().to_degrees() - 45.0).abs() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// `KC1111` for a direction that the rotary axes do not reach, with the degrees by which it lies outside; `KC1112`
    /// when the translations are not independent there and miss the tip; `KC1113` for more than two rotary axes or three
    /// translations; `KC1114` for a number that is not finite or a direction without length.
    pub fn inverse(&self, tip: DVec3, axis: DVec3, given: &[f64]) -> Result<Solutions> {
        self.inverse_nearest(tip, axis, given, &[], 0.0)
    }

    /// As [`Kinematics::inverse`], with the axes whose `locked` is true held at their position of `given`.
    ///
    /// # Errors
    /// As [`Kinematics::inverse`].
    pub fn inverse_locked(
        &self,
        tip: DVec3,
        axis: DVec3,
        given: &[f64],
        locked: &[bool],
    ) -> Result<Solutions> {
        self.inverse_nearest(tip, axis, given, locked, 0.0)
    }

    /// As [`Kinematics::inverse_locked`], but a direction that lies outside of what the rotary axes reach by no more than
    /// `allowance` [rad] is replaced by the nearest one inside; the tip is always exact. For measured axes that are not
    /// quite square, and directions that come rounded.
    ///
    /// # Errors
    /// As [`Kinematics::inverse`].
    pub fn inverse_nearest(
        &self,
        tip: DVec3,
        axis: DVec3,
        given: &[f64],
        locked: &[bool],
        allowance: f64,
    ) -> Result<Solutions> {
        let axis = checked(tip, axis, given)?;
        let free = Free::new(self, given, locked)?;
        let (tip, wanted) = match self.work_at_home {
            true => (tip, axis),
            false => (self.to_machine(tip), self.to_work.rotation.transpose() * axis),
        };
        let branches = orient::branches(&free, wanted, given, allowance)?;
        let mut solutions = Solutions::none();
        let mut miss = f64::INFINITY;
        for branch in &branches {
            match place::translations(&free, branch, tip, given) {
                Ok(placed) => {
                    let mut values = free.start;
                    for (k, screw) in free.screws().iter().enumerate() {
                        values[free.place[k]] =
                            if screw.rotary { branch.angle_of(k) } else { placed.values[k] };
                    }
                    solutions.push(Solution { values, singular: branch.singular || placed.dependent });
                }
                Err(distance) => miss = miss.min(distance),
            }
        }
        if solutions.is_empty() { Err(missed(miss)) } else { Ok(solutions) }
    }

    /// A point of the workpiece in the machine frame.
    fn to_machine(&self, tip: DVec3) -> DVec3 {
        self.to_work.rotation.transpose() * (tip - self.to_work.translation)
    }
}

fn missed(distance: f64) -> crate::base::Error {
    Finding::error(
        Code::TIP_UNREACHABLE,
        format!("the translations are not independent here, and the tip stays {distance:.6} mm away"),
    )
    .value_mm(distance)
    .help("turn the rotary axes, or take a layout whose translations stay independent")
    .into()
}

/// Directions shorter than this have no direction: rounding of coordinates of order one.
const SHORTEST_DIRECTION: f64 = 1e-9;

/// The unit direction, if all numbers can be used.
pub(super) fn checked(tip: DVec3, axis: DVec3, given: &[f64]) -> Result<DVec3> {
    let length = axis.length();
    let usable = tip.is_finite() && length.is_finite() && length > SHORTEST_DIRECTION;
    if usable && given.iter().all(|value| value.is_finite()) {
        return Ok(axis / length);
    }
    let what = if !tip.is_finite() {
        "the tip has a coordinate that is not finite"
    } else if given.iter().any(|value| !value.is_finite()) {
        "a given axis position is not finite"
    } else {
        "the direction of the tool has no length"
    };
    let finding = Finding::error(Code::POSE_NOT_USABLE, what);
    Err(finding.value(length, "length").bound(SHORTEST_DIRECTION, "length").into())
}
