//! A tool change inside the stock: the spindle leaves for the changing place from its last position; where zeros, lengths
//! or the stock may be off, also one close to it.

use super::Simulated;
use super::work::radius;
use crate::base::{Code, Finding};
use crate::trace::StandKind;

/// Depth that is rounding of coordinates [mm].
const ROUNDING: f64 = 2e-3;

pub(super) fn change(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    let stock = simulated.job.stock.bounds();
    let uncertainty = simulated.job.uncertainty;
    let off = uncertainty.map_or(0.0, |off| off.of_stock());
    for (setup, looks) in simulated.simulation.looks.iter().enumerate() {
        for contact in &looks.stands {
            let stand = &simulated.setups[setup].trace.stands[contact.stand];
            let StandKind::Change(to) = stand.kind else { continue };
            let Some(tool) = simulated.tool(Some(stand.tool)) else { continue };
            let is_within = |off: f64| {
                let around = stock.grown(radius(tool) + off);
                let beside = (0..3).all(|i| {
                    stand.axis[i].abs() > 0.5
                        || (stand.tip[i] > around.min[i] && stand.tip[i] < around.max[i])
                });
                beside && contact.below + off > ROUNDING
            };
            let message = format!("{} is changed for {to} inside the stock", stand.tool);
            let finding = match uncertainty {
                _ if is_within(0.0) => Finding::error(Code::CHANGE_IN_STOCK, message)
                    .value(rounded(contact.below), "mm below its top"),
                Some(may) if is_within(off) => Finding::doubt(Code::CHANGE_IN_STOCK, may.possible(&message))
                    .value(rounded(contact.below + off), "mm below its top"),
                _ => continue,
            };
            let finding =
                finding.point(stand.tip.to_array()).help("retract above the stock before the change");
            found.push(simulated.at(setup, stand.item, finding));
        }
    }
    found
}

/// A length to the micrometre [mm].
fn rounded(length: f64) -> f64 {
    (length * 1e3).round() / 1e3
}
