//! A dwell or a stop while the tool touches material.
//!
//! A tool that went straight down before a dwell (a drill, a spot facer, a countersink) dwells there to clean the floor: that
//! is right. A stop is not, wherever it touches.

use std::f64::consts::TAU;

use super::Simulated;
use crate::base::{Code, Finding};
use crate::program::StopKind;
use crate::trace::StandKind;

/// A dwell of this many turns of the spindle, or this time [s], is one of those that make corners sharp.
const TURNS: f64 = 5.0;
const SHORT: f64 = 0.25;

pub(super) fn dwell(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (setup, looks) in simulated.simulation.looks.iter().enumerate() {
        let done = &simulated.setups[setup];
        for contact in looks.stands.iter().filter(|c| c.touches) {
            let stand = &done.trace.stands[contact.stand];
            let before = done.trace.segments[..stand.next].iter().rev().find(|s| !s.alternative);
            let axial = before.is_some_and(|s| {
                let way = s.curve.end() - s.curve.start();
                way.cross(s.axis).length() <= 1e-6 * way.length()
            });
            let finding = match stand.kind {
                StandKind::Dwell(seconds) => {
                    let turn = TAU / done.program.state(stand.item as usize).spindle.rate();
                    let short = if turn.is_finite() && TURNS * turn > SHORT { TURNS * turn } else { SHORT };
                    if axial || seconds <= short {
                        continue;
                    }
                    let message = format!("{} dwells while it touches material", stand.tool);
                    Finding::warning(Code::DWELL_IN_CUT, message).value(seconds, "s")
                }
                StandKind::Stop(StopKind::Program | StopKind::Optional | StopKind::Pallet) => {
                    let message = format!("the program stops while {} touches material", stand.tool);
                    Finding::warning(Code::DWELL_IN_CUT, message)
                }
                _ => continue,
            };
            let finding = finding.help("lift the tool off first").point(stand.tip.to_array());
            found.push(simulated.at(setup, stand.item, finding));
        }
    }
    found
}
