//! A machine: its axes from workpiece to tool.

use std::sync::Arc;

use glam::DVec3;

use super::control::positive;
use super::kinematics::Travels;
use super::{
    Body, CoordinateCode, Dynamics, Elementary, Joint, Kinematics, Link, MOST_JOINTS, MotionControl, OwnCode,
    Rapids, TorqueCurve,
};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;

/// A machine. In its code every positive motion moves the tool side positively relative to the work side, so a
/// table axis needs no change of sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Name.
    pub name: String,
    /// Motions from workpiece to tool.
    pub code: CoordinateCode,
    /// One joint for each motion of the code, in its order.
    pub joints: Vec<Joint>,
    /// The place of the work on the machine at home: maps coordinates of the table frame into the machine frame. Nearly
    /// always the identity: setups locate their work offsets in the table frame.
    pub work: Rigid,
    /// The spindle at home: maps the frame of the gauge point, whose Z points from the tool into the spindle, into the
    /// machine frame.
    pub spindle: Rigid,
    /// Limits of the linear axes that say nothing of their own.
    pub dynamics: Dynamics,
    /// Values of its control, of its spindle and of its tool change.
    pub control: MotionControl,
    /// Torque of its spindle by the speed, where it is given.
    pub spindle_curve: Option<TorqueCurve>,
    /// Course of its rapid moves, a parameter of the control; `None` where it is not known.
    pub rapids: Option<Rapids>,
    /// Codes of its control that the language does not have.
    pub codes: Arc<[OwnCode]>,
    /// Solids of its links; empty where they are not known. After a change of the joints the links of the bodies have
    /// to be changed too.
    pub bodies: Arc<[Body]>,
}

impl Machine {
    /// A checked machine whose axes have the standard directions and pass through the machine's zero; travel of X, Y, Z.
    ///
    /// # Errors
    /// Those of [`Machine::check`]; `KC0703` when X, Y or Z is missing from the code.
    pub fn new(code: CoordinateCode, travel: [Option<[f64; 2]>; 3], dynamics: Dynamics) -> Result<Machine> {
        for (motion, letter) in [Elementary::X, Elementary::Y, Elementary::Z].into_iter().zip(['X', 'Y', 'Z'])
        {
            if !code.has(motion) {
                return Err(Finding::error(
                    Code::MACHINE_AXIS,
                    format!("machine {code} has no {letter} axis"),
                )
                .help("a milling job needs 1, 2 and 3 in the code")
                .key("code")
                .into());
            }
        }
        let joints = code.word().0.iter().map(|&motion| {
            let limits = travel.get(motion.digit() as usize - 1).copied().flatten();
            Joint { travel: limits, ..Joint::standard(motion) }
        });
        let joints = joints.collect();
        let machine = Machine { joints, dynamics, ..Machine::of_code(code) };
        machine.check()?;
        Ok(machine)
    }

    /// A machine of a code whose axes have the standard directions, pass through the machine's zero and have no bounds;
    /// inclined rotations turn about Z until they get their direction.
    pub fn of_code(code: CoordinateCode) -> Machine {
        Machine {
            name: String::new(),
            joints: code.word().0.iter().map(|&motion| Joint::standard(motion)).collect(),
            code,
            work: Rigid::IDENTITY,
            spindle: Rigid::IDENTITY,
            dynamics: Dynamics::default(),
            control: MotionControl::default(),
            spindle_curve: None,
            rapids: None,
            codes: Arc::default(),
            bodies: Arc::default(),
        }
    }

    /// Whether something of what its spindle has is known: power, torque, or its curve.
    pub fn knows_spindle(&self) -> bool {
        self.control.spindle_power.is_some()
            || self.control.spindle_torque.is_some()
            || self.spindle_curve.is_some()
    }

    /// Checks directions, senses, travel and dynamics.
    ///
    /// # Errors
    /// `KC0702` when joints and code do not match or are too many; `KC0703` for a direction without length, a sense
    /// that is not 1 or -1, a travel that is reversed or not finite, a letter that occurs twice, or a dynamic limit
    /// that is not positive; those of [`MotionControl::check`].
    pub fn check(&self) -> Result<()> {
        let motions = self.joints.iter().map(|j| j.motion);
        if !motions.eq(self.code.word().0.iter().copied()) || self.joints.len() > MOST_JOINTS {
            return Err(Finding::error(
                Code::MACHINE_CODE,
                format!(
                    "the {} axes of the machine are not those of its code {}",
                    self.joints.len(),
                    self.code
                ),
            )
            .bound(MOST_JOINTS as f64, "axes at most")
            .key("code")
            .into());
        }
        for (i, joint) in self.joints.iter().enumerate() {
            let letter = joint.letter;
            let fail = |what: &str, key: &str| {
                Finding::error(Code::MACHINE_AXIS, format!("axis {letter}: {what}"))
                    .key(format!("{key}.{letter}"))
            };
            if self.joints[..i].iter().any(|other| other.letter == letter) {
                return Err(fail("two axes have this letter", "axis").into());
            }
            if !((joint.direction.length() - 1.0).abs() < UNIT && joint.point.is_finite()) {
                return Err(fail("its direction has no length, or a number is not finite", "axis").into());
            }
            if joint.sense.abs() != 1.0 {
                return Err(fail("its sense is 1 or -1", "axis").value(joint.sense, "").into());
            }
            if let Some([min, max]) = joint.travel
                && !(min.is_finite() && max.is_finite() && min < max)
            {
                let rotary = joint.motion.is_rotation();
                let finding = fail("its travel is reversed or not finite", "travel");
                return Err(if rotary {
                    finding.value(min.to_degrees(), "degrees").bound(max.to_degrees(), "degrees")
                } else {
                    finding.value_mm(min).bound_mm(max)
                }
                .into());
            }
            check_dynamics(&joint.dynamics, &format!("axis.{letter}"))?;
        }
        let lost = |body: &Body| matches!(body.link, Link::Axis(i) if i >= self.joints.len());
        if let Some(i) = self.bodies.iter().position(lost) {
            return Err(Finding::error(Code::MACHINE_BODY, "a body hangs on an axis that is not there")
                .bound(self.joints.len() as f64, "axes")
                .key(format!("body[{i}].link"))
                .into());
        }
        check_dynamics(&self.dynamics, "dynamics")?;
        self.control.check()
    }

    /// The joint of an axis letter, with its place in the code.
    pub fn joint(&self, letter: char) -> Option<(usize, &Joint)> {
        self.joints.iter().enumerate().find(|(_, joint)| joint.letter == letter)
    }

    /// Travel of an axis [mm or rad], if it is known.
    pub fn travel(&self, letter: char) -> Option<[f64; 2]> {
        self.joint(letter).and_then(|(_, joint)| joint.travel)
    }

    /// True if it has a rotary axis.
    pub fn is_multi_axis(&self) -> bool {
        self.joints.iter().any(|joint| joint.motion.is_rotation())
    }

    /// Its kinematics for a tool whose tip is `length` [mm] in front of the gauge point.
    pub fn kinematics(&self, length: f64) -> Kinematics {
        let tip = Rigid::from_translation(DVec3::Z * -length);
        Kinematics::new(&self.joints, self.work, self.spindle.after(&tip))
    }

    /// The link that carries the work: that of the first joint, or the bed.
    pub fn work_link(&self) -> Link {
        if self.code.bed() > 0 { Link::Axis(0) } else { Link::Bed }
    }

    /// The link that carries the tool: that of the last joint, or the bed.
    pub fn tool_link(&self) -> Link {
        match self.joints.len().checked_sub(1) {
            Some(last) if self.code.bed() <= last => Link::Axis(last),
            _ => Link::Bed,
        }
    }

    /// Motion of a link from home at joint positions `q` [mm or rad], in the frame of the machine.
    pub fn link(&self, link: Link, q: &[f64]) -> Rigid {
        self.kinematics(0.0).link(self.code.bed(), link, q)
    }

    /// Motion of each body from home at joint positions `q` [mm or rad], in the order of [`Machine::bodies`]; the frame
    /// of a body there is this motion times [`Body::place`].
    pub fn body_motions(&self, q: &[f64]) -> Vec<Rigid> {
        let chain = self.kinematics(0.0);
        self.bodies.iter().map(|body| chain.link(self.code.bed(), body.link, q)).collect()
    }

    /// Travel of its joints.
    pub fn travels(&self) -> Travels {
        let mut travels = Travels::default();
        for (slot, joint) in travels.0.iter_mut().zip(&self.joints) {
            *slot = joint.travel;
        }
        travels
    }
}

/// Largest difference of the length of a direction from one: rounding of a normalised vector.
const UNIT: f64 = 1e-9;

fn check_dynamics(dynamics: &Dynamics, key: &str) -> Result<()> {
    for (name, value) in
        [("rapid", dynamics.rapid), ("acceleration", dynamics.acceleration), ("jerk", dynamics.jerk)]
    {
        positive(key, name, value)?;
    }
    Ok(())
}
