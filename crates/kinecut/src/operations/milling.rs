//! The part that every operation has: tool, spindle, coolant, tolerance, and the plane in which it works.

use std::f64::consts::TAU;

use crate::base::bounded::{length, positive};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::program::{Branch, Coolant};
use crate::tool::Tool;

/// The part that every operation has.
#[derive(Clone, Debug)]
pub struct Milling {
    /// The tool.
    pub tool: Tool,
    /// Spindle speed [rad/s].
    pub spindle: f64,
    /// Coolant.
    pub coolant: Coolant,
    /// Largest allowed deviation of wall and floor [mm].
    pub tolerance: f64,
    /// The tilted plane, if it works in one.
    pub plane: Option<JobPlane>,
}

/// A tilted plane of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JobPlane {
    /// Maps coordinates of the plane into those of the work offset.
    pub motion: Rigid,
    /// Choice of the rotary axes.
    pub branch: Branch,
    /// Height above the plane between operations [mm].
    pub safe_height: f64,
}

/// Tool, speed and coolant as a table names them; speed [rev/min].
pub(crate) fn milling(
    tool: u32,
    speed: f64,
    coolant: Coolant,
    tolerance: Option<f64>,
    tools: &[Tool],
) -> Result<Milling> {
    let tool = tool_of(tool, tools)?;
    milling_of(tool, positive("speed", speed, 200_000.0, "rev/min")? * TAU / 60.0, coolant, tolerance)
}

/// The tool of a number.
pub(crate) fn tool_of(number: u32, tools: &[Tool]) -> Result<Tool> {
    let found = tools.iter().find(|t| t.number.0 == number).cloned();
    found.ok_or_else(|| {
        Finding::error(Code::JOB_REFERENCE, format!("T{number} is not defined"))
            .help("define it with [[tool]]")
            .key("tool")
            .into()
    })
}

/// With a tool and a spindle speed [rad/s] that are known.
pub(crate) fn milling_of(
    tool: Tool,
    spindle: f64,
    coolant: Coolant,
    tolerance: Option<f64>,
) -> Result<Milling> {
    Ok(Milling {
        spindle,
        coolant,
        tolerance: length("tolerance", tolerance.unwrap_or(0.02), 1e-6, 100.0)?,
        plane: None,
        tool,
    })
}
