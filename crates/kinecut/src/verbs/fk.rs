//! Joint positions to poses.

use serde::Serialize;

use crate::base::{Finding, Result};
use crate::machine::Machine;
use crate::page::{Block, Fact, Section};
use crate::verbs::Answer;
use crate::verbs::poses::PoseWords;
use crate::verbs::poses::{AxisValues, outside, triple};

/// Position and direction of the tool at some joint positions, in the frame of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForwardPose {
    /// Joint positions.
    pub joints: AxisValues,
    /// The tip [mm].
    pub tip: [f64; 3],
    /// Direction of the tool, from tip to holder.
    pub axis: [f64; 3],
    /// Direction of the spindle's own X, for tools that do not turn.
    pub x: [f64; 3],
    /// Axes outside their travel.
    pub findings: Vec<Finding>,
}

impl Answer for ForwardPose {
    fn sections(&self) -> Vec<Section> {
        let facts = vec![Fact::new("tip", triple(self.tip)), Fact::new("axis", triple(self.axis))];
        vec![Section::new(self.joints.words()).with(Block::Facts(facts))]
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    /// A position beyond its travel is an answer that says no.
    fn is_no(&self) -> bool {
        !self.findings.is_empty()
    }
}

/// The pose of joint positions given as words; axes that are not named are at zero. `length` is that of the tool
/// from the gauge point [mm].
///
/// # Errors
/// `KC0703` for a letter that the machine does not have, `KC0103` for a number that is not finite.
pub fn forward(machine: &Machine, words: &PoseWords, length: f64) -> Result<ForwardPose> {
    let values = AxisValues(words.words.clone()).joints(machine)?;
    let pose = machine.kinematics(length).forward(&values);
    Ok(ForwardPose {
        joints: AxisValues::of(machine, &values),
        tip: pose.translation.to_array(),
        axis: pose.rotation.z_axis.to_array(),
        x: pose.rotation.x_axis.to_array(),
        findings: outside(machine, &values),
    })
}
