//! Going down into material: a tool that does not cut at its centre, and ramps that are too steep.

use super::Simulated;
use crate::base::{Code, Finding};
use crate::job::look::{PLUNGE, RAMP_SLACK};

/// Least stretch of material through the middle of the tool that counts [mm]: below it is rounding.
const LEAST: f64 = 0.02;

pub(super) fn descent(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (setup, looks) in simulated.simulation.looks.iter().enumerate() {
        let trace = &simulated.setups[setup].trace;
        let mut told: Vec<(u32, Code)> = Vec::new();
        for descent in looks.descents.iter().filter(|d| d.core > LEAST) {
            let segment = &trace.segments[descent.segment];
            let Some(tool) = simulated.tool(segment.tool) else { continue };
            let degrees = (descent.angle.to_degrees() * 100.0).round() / 100.0;
            let ramp = tool.max_ramp_angle.filter(|most| descent.angle > most + RAMP_SLACK);
            let finding = if !tool.centre_cutting && descent.angle > PLUNGE {
                let message =
                    format!("{} does not cut at its centre and goes down into material", tool.number);
                Finding::error(Code::PLUNGE, message)
                    .value((descent.core * 1e3).round() / 1e3, "mm deep under its middle")
                    .help("enter along a ramp or a helix, in a drilled hole, or beside the part")
            } else if let Some(most) = ramp {
                Finding::error(Code::RAMP_TOO_STEEP, format!("{} goes down too steeply", tool.number))
                    .value(degrees, "deg")
                    .bound(most.to_degrees(), "deg, `max_ramp_angle` of the tool")
                    .help("make the ramp longer, or the helix wider")
            } else {
                continue;
            };
            // One for each block.
            if !told.contains(&(segment.item, finding.code)) {
                told.push((segment.item, finding.code));
                found.push(simulated.at(setup, segment.item, finding));
            }
        }
    }
    found
}
