//! Drills that enter a face that leans against their axis, in programs of others.

use super::Simulated;
use crate::base::{Code, Finding};

/// Greatest angle between the axis of a drill and the normal of the face that it enters [rad].
const MOST: f64 = 10.0 / 180.0 * std::f64::consts::PI;

/// A doubt for each setup, at the first block, with the greatest angle of all.
pub(super) fn inclined_entry(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (setup, looks) in simulated.simulation.looks.iter().enumerate() {
        let done = &simulated.setups[setup];
        if done.external.is_none() {
            continue;
        }
        let leaning: Vec<_> = looks.entries.iter().filter(|e| e.angle > MOST).collect();
        let Some(first) = leaning.first() else { continue };
        let segment = &done.trace.segments[first.segment];
        let Some(tool) = simulated.tool(segment.tool) else { continue };
        let angle = leaning.iter().map(|e| e.angle).fold(0.0, f64::max);
        let also = match leaning.len() {
            1 => String::new(),
            n => format!(" (in {n} holes, this is the first)"),
        };
        let what = format!("{} enters a face that leans: it is pushed aside{also}", tool.number);
        let finding = Finding::doubt(Code::INCLINED_ENTRY, what)
            .value((angle.to_degrees() * 10.0).round() / 10.0, "deg")
            .bound(MOST.to_degrees(), "deg")
            .help("turn the plane square to the face, or mill the face flat first");
        found.push(simulated.at(setup, segment.item, finding));
    }
    found
}
