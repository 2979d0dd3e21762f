//! A move of a tool as a rigid motion of one parameter: pose, twist and its derivative in closed form.
//!
//! The parameter `t` runs from 0 to 1. The twist is that of the tool's frame in its own coordinates: `turn = R^T W`,
//! `shift = R^T p'` with the tip as origin; [`MotionJet::change`] is its derivative by `t`. Four kinds of moves are
//! known, and nothing is linearised: the orientation is fixed, the joints of a machine go straight, the tip keeps to a
//! curve while the tool turns at a constant rate or with rotary axes that go straight, or the twist is constant.
//!
//! Source: product of exponentials, `xi = sum Ad((g_(i+1) .. g_n)^-1) xi_i q_i'`, and its derivative by the product rule.

mod bound;
mod given;
mod joints;
mod screw;
mod segment;

use glam::{DMat3, DQuat, DVec3};

pub(crate) use bound::chain_acceleration;
pub use given::{GivenTwist, ScrewMove, TipMove, TipPath, twist_of_rows};

use crate::base::{Code, Finding, Result};
use crate::geom::{Curve, Rigid};
use crate::machine::kinematics::Twist;
use crate::machine::{JointValues, Kinematics, Machine};

/// A tool at one moment of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionJet {
    /// From the tool's coordinates into those of the workpiece.
    pub pose: Rigid,
    /// Velocity of the tool in its own coordinates, by `t`.
    pub twist: Twist,
    /// Derivative of [`MotionJet::twist`] by `t`.
    pub change: Twist,
}

impl MotionJet {
    /// Acceleration of a point of the tool, in the tool's coordinates [mm by `t` squared].
    pub fn acceleration(&self, p: DVec3) -> DVec3 {
        let w = self.twist.turn;
        self.change.velocity(p) + w.cross(self.twist.velocity(p))
    }
}

/// A move of a tool: a rigid motion over `t` from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolMotion {
    kind: Kind,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    /// The tip runs along a curve at a constant speed, the tool turns at a constant rate [workpiece coordinates].
    Turning { curve: Curve, start: DMat3, rate: DVec3 },
    /// All joints go straight; `place` maps what the chain calls workpiece.
    Joints { chain: Box<Kinematics>, from: JointValues, to: JointValues, place: Rigid },
    /// The tip runs along a curve, and rotary joints go straight.
    TipAndJoints { curve: Curve, chain: Box<Kinematics>, from: JointValues, to: JointValues, place: DMat3 },
    /// A constant twist in tool coordinates.
    Screw { start: Rigid, twist: Twist },
}

/// Cosine of the angle of two directions that counts as opposite: between them no plane is determined.
const OPPOSITE: f64 = -1.0 + 1e-12;

impl ToolMotion {
    /// A move in which the tool does not turn; `axis` points from the tip to the holder.
    ///
    /// # Errors
    /// `KC1203` when the curve is not finite or the axis is no direction.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::Line;
    /// use kinecut::sweep::ToolMotion;
    /// let line = Line { start: DVec3::ZERO, end: DVec3::new(8.0, 0.0, -6.0) };
    /// let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
    /// let middle = motion.at(0.5);
    /// assert!((middle.twist.shift - DVec3::new(8.0, 0.0, -6.0)).length() < 1e-14);
    /// assert!((middle.pose.translation - DVec3::new(4.0, 0.0, -3.0)).length() < 1e-14);
    /// ```
    pub fn fixed(curve: Curve, axis: DVec3) -> Result<ToolMotion> {
        ToolMotion::turning(curve, upright_on(axis)?, DVec3::ZERO)
    }

    /// A move under control of the tool centre point: the tip keeps to the curve, the tool's axis goes from one direction to the
    /// other in their plane, at a constant rate.
    ///
    /// # Errors
    /// `KC1203` as [`ToolMotion::fixed`], and when the directions are opposite.
    pub fn between(curve: Curve, from: DVec3, to: DVec3) -> Result<ToolMotion> {
        let start = upright_on(from)?;
        let (from, to) = (start.z_axis, upright_on(to)?.z_axis);
        if from.dot(to) <= OPPOSITE {
            return Err(Finding::error(
                Code::MOVE_NOT_POSSIBLE,
                "a tool cannot be turned upside down in one move: no plane is told",
            )
            .value(from.angle_between(to).to_degrees(), "degrees")
            .bound(180.0, "degrees")
            .help("divide the move by a direction in between")
            .into());
        }
        let normal = from.cross(to);
        let angle = normal.length().atan2(from.dot(to));
        let rate = normal.try_normalize().map_or(DVec3::ZERO, |n| n * angle);
        ToolMotion::turning(curve, start, rate)
    }

    /// A move whose tip keeps to the curve at a constant speed while the tool turns at a constant rate [rad, workpiece
    /// coordinates].
    ///
    /// # Errors
    /// `KC1203` when a number is not finite.
    pub fn turning(curve: Curve, start: DMat3, rate: DVec3) -> Result<ToolMotion> {
        let finite = curve.length().is_finite() && curve.start().is_finite() && curve.end().is_finite();
        if !(finite && start.is_finite() && rate.is_finite()) {
            return Err(not_finite());
        }
        Ok(ToolMotion { kind: Kind::Turning { curve, start, rate } })
    }

    /// A move in which all joints of a chain go straight from position to position [mm, rad].
    ///
    /// # Errors
    /// `KC1203` when a position is not finite or there are not as many as joints.
    pub fn joints(chain: Kinematics, from: &[f64], to: &[f64]) -> Result<ToolMotion> {
        check_positions(&chain, from, to)?;
        let (from, to) = (JointValues::new(from), JointValues::new(to));
        Ok(ToolMotion { kind: Kind::Joints { chain: Box::new(chain), from, to, place: Rigid::IDENTITY } })
    }

    /// As [`ToolMotion::joints`], on a machine with a tool of this gauge length [mm], inside the travel of its axes.
    ///
    /// # Errors
    /// `KC1203` when an axis would leave its travel, and as [`ToolMotion::joints`].
    pub fn on_machine(machine: &Machine, length: f64, from: &[f64], to: &[f64]) -> Result<ToolMotion> {
        let chain = machine.kinematics(length);
        check_positions(&chain, from, to)?;
        for (i, joint) in machine.joints.iter().enumerate() {
            let Some([least, most]) = joint.travel else { continue };
            let angular = joint.motion.is_rotation();
            if let Some(q) = [from[i], to[i]].into_iter().find(|&q| q < least || q > most) {
                let bound = if q < least { least } else { most };
                let what = format!("axis {} would leave its travel", joint.letter);
                let finding = Finding::error(Code::MOVE_NOT_POSSIBLE, what);
                let finding = if angular {
                    finding.value(q.to_degrees(), "degrees").bound(bound.to_degrees(), "degrees")
                } else {
                    finding.value_mm(q).bound_mm(bound)
                };
                return Err(finding.help("keep the move inside the travel of the machine").into());
            }
        }
        ToolMotion::joints(chain, from, to)
    }

    /// A move under control of the tool centre point in which the rotary joints of a chain go straight while the tip keeps to a
    /// curve. Positions of linear joints do not matter.
    ///
    /// # Errors
    /// As [`ToolMotion::joints`] and [`ToolMotion::turning`].
    pub fn tip_and_joints(curve: Curve, chain: Kinematics, from: &[f64], to: &[f64]) -> Result<ToolMotion> {
        check_positions(&chain, from, to)?;
        if !(curve.length().is_finite() && curve.start().is_finite() && curve.end().is_finite()) {
            return Err(not_finite());
        }
        let (from, to) = (JointValues::new(from), JointValues::new(to));
        Ok(ToolMotion {
            kind: Kind::TipAndJoints { curve, chain: Box::new(chain), from, to, place: DMat3::IDENTITY },
        })
    }

    /// A constant twist in coordinates of the tool, from a pose.
    ///
    /// # Errors
    /// `KC1203` when a number is not finite.
    pub fn screw(start: Rigid, twist: Twist) -> Result<ToolMotion> {
        let pose = start.rotation.is_finite() && start.translation.is_finite();
        if !(pose && twist.turn.is_finite() && twist.shift.is_finite()) {
            return Err(not_finite());
        }
        Ok(ToolMotion { kind: Kind::Screw { start, twist } })
    }

    /// Pose, twist and its derivative at `t`.
    pub fn at(&self, t: f64) -> MotionJet {
        match &self.kind {
            Kind::Turning { curve, start, rate } => {
                let rotation = turned(*start, *rate, t);
                tip_jet(curve, t, rotation, rotation.transpose() * *rate, DVec3::ZERO)
            }
            Kind::Joints { chain, from, to, place } => {
                let jet = joints::jet(chain, from, to, t);
                MotionJet { pose: place.after(&jet.pose), ..jet }
            }
            Kind::TipAndJoints { curve, chain, from, to, place } => {
                let jet = joints::jet(chain, from, to, t);
                tip_jet(curve, t, *place * jet.pose.rotation, jet.twist.turn, jet.change.turn)
            }
            Kind::Screw { start, twist } => MotionJet {
                pose: start.after(&screw::motion(twist, t)),
                twist: *twist,
                change: Twist::default(),
            },
        }
    }

    /// The pose at `t`.
    pub fn pose(&self, t: f64) -> Rigid {
        match &self.kind {
            Kind::Turning { curve, start, rate } => {
                Rigid { rotation: turned(*start, *rate, t), translation: curve.at(t * curve.length()).p }
            }
            Kind::Joints { chain, from, to, place } => {
                place.after(&chain.forward(&joints::between(from, to, t)))
            }
            Kind::TipAndJoints { curve, chain, from, to, place } => Rigid {
                rotation: *place * chain.forward(&joints::between(from, to, t)).rotation,
                translation: curve.at(t * curve.length()).p,
            },
            Kind::Screw { start, twist } => start.after(&screw::motion(twist, t)),
        }
    }

    /// Its beginning: the same move up to `t`.
    #[must_use]
    pub fn until(&self, t: f64) -> ToolMotion {
        let kind = match &self.kind {
            Kind::Turning { curve, start, rate } => {
                Kind::Turning { curve: curve.part(0.0, t * curve.length()), start: *start, rate: *rate * t }
            }
            Kind::Joints { chain, from, to, place } => Kind::Joints {
                chain: chain.clone(),
                from: *from,
                to: joints::between(from, to, t),
                place: *place,
            },
            Kind::TipAndJoints { curve, chain, from, to, place } => Kind::TipAndJoints {
                curve: curve.part(0.0, t * curve.length()),
                chain: chain.clone(),
                from: *from,
                to: joints::between(from, to, t),
                place: *place,
            },
            Kind::Screw { start, twist } => {
                Kind::Screw { start: *start, twist: Twist { turn: twist.turn * t, shift: twist.shift * t } }
            }
        };
        ToolMotion { kind }
    }

    /// The curve of the tip and the tool's axis, if the axis keeps its direction; else `None`.
    pub fn as_fixed(&self) -> Option<(&Curve, DVec3)> {
        match &self.kind {
            Kind::Turning { curve, start, rate } if *rate == DVec3::ZERO => Some((curve, start.z_axis)),
            _ => None,
        }
    }
}

/// The jet of a tip on a curve at a constant speed, with a given orientation and its rates.
fn tip_jet(curve: &Curve, t: f64, rotation: DMat3, turn: DVec3, turn_change: DVec3) -> MotionJet {
    let length = curve.length();
    let jet = curve.at(t * length);
    let back = rotation.transpose();
    let shift = back * (jet.d1 * length);
    // A cusp has no second derivative; there the motion is continued by its neighbours.
    let bend = if jet.d2.is_finite() { back * (jet.d2 * (length * length)) } else { DVec3::ZERO };
    MotionJet {
        pose: Rigid { rotation, translation: jet.p },
        twist: Twist { turn, shift },
        change: Twist { turn: turn_change, shift: bend - turn.cross(shift) },
    }
}

/// An orientation turned for a time at a constant rate.
fn turned(start: DMat3, rate: DVec3, t: f64) -> DMat3 {
    if rate == DVec3::ZERO { start } else { DMat3::from_quat(DQuat::from_scaled_axis(rate * t)) * start }
}

/// An orientation with this axis, turned from Z the short way.
fn upright_on(axis: DVec3) -> Result<DMat3> {
    let axis = axis.try_normalize().filter(|a| a.is_finite()).ok_or_else(|| {
        Finding::error(Code::MOVE_NOT_POSSIBLE, "the axis of a tool is no direction")
            .help("give a vector from the tip to the holder")
    })?;
    Ok(if axis == DVec3::Z {
        DMat3::IDENTITY
    } else {
        DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis))
    })
}

fn check_positions(chain: &Kinematics, from: &[f64], to: &[f64]) -> Result<()> {
    let joints = chain.joints();
    if from.len() != joints || to.len() != joints {
        let count = if from.len() == joints { to.len() } else { from.len() };
        return Err(Finding::error(
            Code::MOVE_NOT_POSSIBLE,
            "a move of joints needs a position for each joint of the machine",
        )
        .value(count as f64, "")
        .bound(joints as f64, "")
        .help("give as many positions as the machine has joints")
        .into());
    }
    if from.iter().chain(to).any(|q| !q.is_finite()) {
        return Err(not_finite());
    }
    Ok(())
}

fn not_finite() -> crate::base::Error {
    Finding::error(Code::MOVE_NOT_POSSIBLE, "a move has a number that is not finite")
        .help("give finite positions and directions")
        .into()
}
