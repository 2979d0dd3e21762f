//! The motion that a machine gives a tool by the laws of a way.

use super::{FrameMotion, TaskMotion};
use crate::geom::Rigid;
use crate::machine::{Kinematics, Machine};

/// The motion that a machine gives a tool by the laws of a way: [`super::ToolEnvelope`] compares it when the tool touches
/// or rolls.
#[derive(Clone, Debug)]
pub struct MachineMotion<'a> {
    way: &'a TaskMotion,
    chain: Kinematics,
    /// From the frame of the task to the tip frame of the tool.
    back: Rigid,
}

impl<'a> MachineMotion<'a> {
    /// The motion of a tool of this length [mm] that is mounted so: `mount` maps its tip frame into the tool's frame of the
    /// task.
    pub fn new(way: &'a TaskMotion, machine: &Machine, tool_length: f64, mount: Rigid) -> MachineMotion<'a> {
        MachineMotion { way, chain: machine.kinematics(tool_length), back: mount.inverse() }
    }
}

impl FrameMotion for MachineMotion<'_> {
    fn pose(&self, u: [f64; 2]) -> Rigid {
        self.chain.forward(&self.way.positions_at(u)).after(&self.back)
    }
}
