//! Control state that the operator sets: register values and the tool in the spindle.

use glam::DVec3;

use crate::program::ToolNumber;
use crate::tool::Tool;

/// Registers and spindle as the operator has set them up before the program runs.
///
/// A program of kinecut's own calls each tool by its own registers and needs none of this; a program of others may call a
/// tool by a register that holds the length of another one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegisterState<'a> {
    /// The tool in the spindle before the program calls one.
    pub in_spindle: Option<ToolNumber>,
    /// Lengths that the control reckons with where they are not the tool's own: tool, register (`None`: the length is
    /// switched off), length [mm].
    pub lengths: &'a [(ToolNumber, Option<u32>, f64)],
    /// Place of the tip before the first move, in coordinates of the program's first frame [mm].
    pub start: Option<DVec3>,
    /// True if a radius register without a value holds the radius of the tool in the spindle.
    pub own_radius: bool,
}

impl RegisterState<'_> {
    /// Height of the tip above the programmed place, along the tool [mm]: the control lifts a tool by the length of the
    /// register.
    pub(super) fn lift(&self, tool: &Tool, length: Option<u32>) -> f64 {
        let held =
            self.lengths.iter().find(|(number, register, _)| *number == tool.number && *register == length);
        match (held, tool.gauge_length) {
            (Some((_, _, held)), Some(own)) => held - own,
            _ => 0.0,
        }
    }
}
