//! A drill that moves across its axis in material: it has no edges that could cut there.
//!
//! Drills whose edge leaves a core or a nub are found by the simulation itself. A pointed tool of 100 degrees or less
//! (a spot drill, a countersink) may chamfer an edge with its cone.

use super::Simulated;
use crate::base::{Code, Finding};
use crate::tool::{Cutter, DrillPoint};

/// Depth of material that counts [mm].
const LEAST: f64 = 0.05;
/// Largest sine of the angle to its axis at which a drill still goes along it: rounding of a short move.
const ALONG: f64 = 0.01;
/// Largest point angle of a tool that may chamfer [rad].
const CHAMFERS: f64 = 100.0 / 180.0 * std::f64::consts::PI;

pub(super) fn sideways(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for setup in 0..simulated.setups.len() {
        let mut last = None;
        for done in simulated.segments(setup).filter(|d| d.cuts() && !d.effect.as_filled) {
            let Some(tool) = simulated.tool(done.segment.tool) else { continue };
            let (kind, point) = match &tool.cutter {
                Cutter::Drill { point, .. } => ("drill", Some(point)),
                Cutter::Tap(_) => ("tap", None),
                _ => continue,
            };
            let length = done.segment.curve.length();
            let across = [0.0, 0.5, 1.0].into_iter().any(|t| {
                let along = done.segment.curve.at(t * length).d1;
                along.cross(done.segment.axis).length() > ALONG
            });
            let pointed = match point {
                Some(DrillPoint::SinglePlane { angle }) => *angle <= CHAMFERS,
                Some(DrillPoint::Cone { .. }) => true,
                _ => false,
            };
            let depth = done.effect.deepest;
            if !across || depth < LEAST || (pointed && depth <= tool.cutter.tip_height() + LEAST) {
                continue;
            }
            if last.replace(done.segment.item) == Some(done.segment.item) {
                continue;
            }
            let message = format!("{} is a {kind} and cuts sideways", tool.number);
            let finding = Finding::error(Code::DRILL_SIDEWAYS, message)
                .value((depth * 1e3).round() / 1e3, "mm deep")
                .help(format!("retract the {kind} along its axis before it moves on"));
            found.push(simulated.at(setup, done.segment.item, finding));
        }
    }
    found
}
