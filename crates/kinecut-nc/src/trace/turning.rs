//! Turning of the tool axis along a segment.

use glam::{DQuat, DVec3};

use super::chain::Chain;
use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics};
use crate::program::RotarySolution;

/// The turning of the tool axis along one segment.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTurning {
    /// From the table frame into part coordinates.
    pub(super) to_part: Rigid,
    /// The machine with the tool, if it is known.
    pub(super) chain: Option<Chain>,
    pub(super) law: TurningLaw,
}

/// Law of the directions between the ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TurningLaw {
    /// In the plane of the two directions, at a constant rate [table frame].
    Vector { from: DVec3, to: DVec3, rotary: Option<[[f64; 3]; 2]> },
    /// Rotary axes go straight from position to position [rad], and so do the linear axes where they are given [mm]: the
    /// tip's line is then a chord of what the tip does.
    Rotary { from: [f64; 3], to: [f64; 3], linear: Option<[DVec3; 2]> },
}

/// Motion that carries a turning tool: for callers that need more of it than the axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Carried {
    /// The axis turns in a plane at a constant rate, the tip keeps to the segment's curve.
    Plane,
    /// All joints go straight [mm, rad]; the chain's workpiece is mapped into part coordinates.
    Joints {
        /// Chain of the machine with the tool.
        chain: Kinematics,
        /// Positions at the start.
        from: JointValues,
        /// Positions at the end.
        to: JointValues,
        /// Into part coordinates.
        to_part: Rigid,
    },
    /// The rotary joints go straight [rad], the tip keeps to the segment's curve; positions of linear joints do not matter.
    TipAndJoints {
        /// Chain of the machine with the tool.
        chain: Kinematics,
        /// Positions at the start.
        from: JointValues,
        /// Positions at the end.
        to: JointValues,
        /// Into part coordinates.
        to_part: Rigid,
    },
}

impl AxisTurning {
    /// Motion that carries the tool.
    pub fn carried(&self) -> Carried {
        let (TurningLaw::Rotary { from, to, linear }, Some(chain)) = (&self.law, &self.chain) else {
            return Carried::Plane;
        };
        let to_part = self.to_part;
        let kinematics = chain.kinematics().clone();
        match linear {
            Some([start, end]) => {
                let (from, to) = (chain.joints(*start, *from), chain.joints(*end, *to));
                Carried::Joints { chain: kinematics, from, to, to_part }
            }
            None => {
                let (from, to) = (chain.joints(DVec3::ZERO, *from), chain.joints(DVec3::ZERO, *to));
                Carried::TipAndJoints { chain: kinematics, from, to, to_part }
            }
        }
    }

    /// The tool axis [part coordinates] at a part `t` of the way, and the vector of its rate of turning by `t` [rad].
    pub fn axis(&self, t: f64) -> (DVec3, DVec3) {
        let (axis, rate) = match &self.law {
            TurningLaw::Vector { from, to, .. } => {
                let rate = plane_rate(*from, *to);
                (DQuat::from_scaled_axis(rate * t) * *from, rate)
            }
            TurningLaw::Rotary { from, to, .. } => match &self.chain {
                Some(chain) => rotary_rate(chain, *from, *to, t),
                None => (DVec3::Z, DVec3::ZERO),
            },
        };
        (self.to_part.vector(axis), self.to_part.vector(rate))
    }

    /// The most by which the tool axis turns along the segment [rad].
    pub fn most_turned(&self) -> f64 {
        match &self.law {
            TurningLaw::Vector { from, to, .. } => from.cross(*to).length().atan2(from.dot(*to)),
            TurningLaw::Rotary { from, to, .. } => (0..3).map(|i| (to[i] - from[i]).abs()).sum(),
        }
    }

    /// Positions of the linear and of the rotary axes at a part `t` of the way, with the tip at this point [part
    /// coordinates].
    pub(super) fn joints(&self, tip: DVec3, t: f64) -> Option<(DVec3, [f64; 3])> {
        let chain = self.chain.as_ref()?;
        let rotary = self.rotary(chain, t)?;
        if let TurningLaw::Rotary { linear: Some([start, end]), .. } = &self.law {
            return Some((start.lerp(*end, t), rotary));
        }
        let (matrix, shift) = chain.to_linear(rotary)?;
        Some((matrix * self.to_part.inverse().point(tip) + shift, rotary))
    }

    /// Positions of the rotary axes at a part `t` of the way.
    pub(super) fn rotary(&self, chain: &Chain, t: f64) -> Option<[f64; 3]> {
        match &self.law {
            TurningLaw::Rotary { from, to, .. } => Some(between(*from, *to, t)),
            TurningLaw::Vector { from, to, rotary } => {
                let [start, end] = (*rotary)?;
                if t <= 0.0 {
                    return Some(start);
                }
                if t >= 1.0 {
                    return Some(end);
                }
                let axis = DQuat::from_scaled_axis(plane_rate(*from, *to) * t) * *from;
                chain.rotary_for(axis, between(start, end, t), RotarySolution::Free).ok()
            }
        }
    }
}

/// Rate by which a direction turns into another in their plane, by the part of the way [rad].
pub(super) fn plane_rate(from: DVec3, to: DVec3) -> DVec3 {
    let normal = from.cross(to);
    let angle = normal.length().atan2(from.dot(to));
    normal.try_normalize().map_or(DVec3::ZERO, |n| n * angle)
}

/// Positions between two.
pub(super) fn between(from: [f64; 3], to: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * t)
}

/// Tool axis and its rate of turning while rotary axes go straight [table frame].
fn rotary_rate(chain: &Chain, from: [f64; 3], to: [f64; 3], t: f64) -> (DVec3, DVec3) {
    let at = between(from, to, t);
    let turn = chain.pose(DVec3::ZERO, at).rotation;
    // The rate of a rotary axis is the axis of the small turn that it makes, wherever it is in the chain.
    let mut rate = DVec3::ZERO;
    for i in 0..3 {
        let by = to[i] - from[i];
        if by != 0.0 && chain.has(i) {
            let mut beyond = at;
            // A quarter turn gives the axis without loss of digits: its antisymmetric part is the axis.
            beyond[i] += std::f64::consts::FRAC_PI_2;
            let quarter = chain.pose(DVec3::ZERO, beyond).rotation * turn.transpose();
            let axis = DVec3::new(
                quarter.y_axis.z - quarter.z_axis.y,
                quarter.z_axis.x - quarter.x_axis.z,
                quarter.x_axis.y - quarter.y_axis.x,
            );
            rate += 0.5 * axis * by;
        }
    }
    (turn.z_axis, rate)
}
