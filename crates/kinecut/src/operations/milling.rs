//! The part that every operation has: tool, spindle, coolant, tolerance, and the plane in which it works.

use std::f64::consts::TAU;

use super::CalledTool;
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Result};
use crate::cutting::MillingCut;
use crate::geom::Rigid;
use crate::program::{Coolant, RotarySolution};
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
    /// The same where the operation says it.
    pub wanted_tolerance: Option<f64>,
    /// The tilted plane, if it works in one.
    pub plane: Option<JobPlane>,
}

impl Milling {
    /// A cut beside a wall, as wide as what is left on it [mm], at a feed [mm/s]; as deep as a level, or all of a depth, at most as the flutes
    /// are long [mm].
    pub(crate) fn beside_wall(&self, width: f64, feed: f64, [level, depth]: [Option<f64>; 2]) -> MillingCut {
        let deepest = self.tool.flute_length;
        let depth = [level, depth].into_iter().flatten().fold(deepest, f64::min);
        MillingCut {
            diameter: self.tool.cutter.diameter(self.tool.flute_length),
            teeth: self.tool.teeth,
            speed: self.spindle,
            feed,
            depth,
            width,
        }
    }
}

/// A tilted plane of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JobPlane {
    /// Maps coordinates of the plane into those of the work offset.
    pub motion: Rigid,
    /// Choice of the rotary axes.
    pub branch: RotarySolution,
    /// Height above the plane between operations [mm].
    pub safe_height: f64,
}

/// Tool, speed and coolant as a table names them; speed [rev/min].
pub(crate) fn milling(
    tool: &CalledTool,
    speed: f64,
    coolant: Coolant,
    tolerance: Option<f64>,
    tools: &[Tool],
) -> Result<Milling> {
    let tool = tool_of(tool, tools)?;
    milling_of(tool, positive("speed", speed, 200_000.0, "rev/min")? * TAU / 60.0, coolant, tolerance)
}

/// The feed of the cutter's centre [mm/s] from the keys `feed` [mm/min] or `feed_per_tooth` [mm] of an operation with a noun, at a
/// speed [rad/s].
pub(crate) fn feed_of(
    noun: &str,
    feed: Option<f64>,
    per_tooth: Option<f64>,
    speed: f64,
    teeth: u32,
) -> Result<f64> {
    match (feed, per_tooth) {
        (Some(feed), None) => Ok(positive("feed", feed, 1e6, "mm/min")? / 60.0),
        (None, Some(per_tooth)) => {
            let per_tooth = positive("feed_per_tooth", per_tooth, 100.0, "mm")?;
            Ok(per_tooth * f64::from(teeth) * speed / TAU)
        }
        (Some(_), Some(_)) => {
            let finding = Finding::error(Code::JOB_SHAPE, "`feed` and `feed_per_tooth` exclude each other");
            Err(finding.help("give one of them").key("feed").into())
        }
        (None, None) => {
            let finding = Finding::error(Code::JOB_SHAPE, format!("the {noun} needs a feed"));
            Err(finding.help("give feed = 600 (mm/min) or feed_per_tooth = 0.05 (mm)").into())
        }
    }
}

/// The tool that an operation calls.
pub(crate) fn tool_of(called: &CalledTool, tools: &[Tool]) -> Result<Tool> {
    let is_it = |tool: &&Tool| match called {
        CalledTool::Number(number) => tool.number.0 == *number,
        CalledTool::Name(_) => called.is_name(&tool.name),
    };
    let found: Vec<&Tool> = tools.iter().filter(is_it).collect();
    match &found[..] {
        [one] => Ok((*one).clone()),
        [] => Err(Finding::error(Code::JOB_REFERENCE, format!("{called} is not defined"))
            .help("define it with [[tool]]")
            .key("tool")
            .into()),
        several => {
            // Numbers differ; a name may be there twice.
            let all: Vec<String> = several.iter().map(|tool| tool.number.to_string()).collect();
            let message = format!("{called} is the name of several tools: {}", all.join(", "));
            let finding = Finding::error(Code::JOB_REFERENCE, message).key("tool");
            Err(finding.help("call it by its number, or give each a name of its own").into())
        }
    }
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
        wanted_tolerance: tolerance,
        plane: None,
        tool,
    })
}

/// Speed of the spindle [rad/s] from `speed` (rev/min) or `cutting_speed` (m/min) at a diameter [mm] with its key.
pub(crate) fn spindle(
    speed: Option<f64>,
    cutting_speed: Option<f64>,
    (key, diameter): (&str, f64),
) -> Result<f64> {
    match (speed, cutting_speed) {
        (Some(speed), None) => Ok(positive("speed", speed, 200_000.0, "rev/min")? * TAU / 60.0),
        (None, Some(v)) => {
            let v = positive("cutting_speed", v, 10_000.0, "m/min")? * 1000.0 / 60.0;
            Ok(v / (positive(key, diameter, MAX_LENGTH, "mm")? / 2.0))
        }
        (Some(_), Some(_)) => {
            let finding = Finding::error(Code::JOB_SHAPE, "`speed` and `cutting_speed` exclude each other");
            Err(finding.help("give one of them").key("speed").into())
        }
        (None, None) => {
            let finding = Finding::error(Code::JOB_SHAPE, "the operation needs a speed");
            Err(finding.help("give cutting_speed = 120 (m/min) or speed = 3800 (rev/min)").into())
        }
    }
}

/// A speed that a control takes: whole revolutions per minute, unless it turns very slowly.
pub(crate) fn whole_revolutions(rate: f64) -> f64 {
    const SLOW: f64 = 20.0;
    let rpm = rate / TAU * 60.0;
    if rpm > SLOW { rpm.round() * TAU / 60.0 } else { rate }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{Cutter, ToolLimits, ToolNumber, ToothSpacing};

    fn tool(number: u32, name: &str) -> Tool {
        Tool {
            number: ToolNumber(number),
            name: name.to_owned(),
            cutter: Cutter::EndMill { diameter: 10.0 },
            teeth: 3,
            spacing: ToothSpacing::default(),
            flute_length: 22.0,
            stickout: 22.0,
            shank_diameter: 10.0,
            holder: None,
            centre_cutting: true,
            max_ramp_angle: None,
            gauge_length: None,
            limits: ToolLimits::default(),
            elasticity: None,
        }
    }

    #[test]
    fn a_name_of_two_tools_is_refused() {
        let tools = [tool(3, "rough"), tool(5, "Rough"), tool(7, "finish")];
        let found = |called: &CalledTool| tool_of(called, &tools).map(|tool| tool.number.0);
        assert_eq!(found(&CalledTool::Name("FINISH".to_owned())).unwrap(), 7);
        assert_eq!(found(&CalledTool::Number(5)).unwrap(), 5);
        let error = found(&CalledTool::Name("rough".to_owned())).unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::JOB_REFERENCE, Some("tool")));
        assert!(error.to_string().contains("`rough` is the name of several tools: T3, T5"), "{error}");
        assert!(found(&CalledTool::Number(4)).unwrap_err().to_string().contains("T4 is not defined"));
    }
}
