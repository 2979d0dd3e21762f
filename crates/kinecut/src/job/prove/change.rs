//! A tool change inside the stock: the spindle leaves for the changing place from its last position.

use super::Simulated;
use super::work::radius;
use crate::base::{Code, Finding};
use crate::trace::StandKind;

/// Depth that is rounding of coordinates [mm].
const ROUNDING: f64 = 2e-3;

pub(super) fn change(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    let stock = simulated.job.stock.bounds();
    for (setup, looks) in simulated.simulation.looks.iter().enumerate() {
        for contact in &looks.stands {
            let stand = &simulated.setups[setup].trace.stands[contact.stand];
            let StandKind::Change(to) = stand.kind else { continue };
            let Some(tool) = simulated.tool(Some(stand.tool)) else { continue };
            let around = stock.grown(radius(tool));
            let within = (0..3).all(|i| {
                stand.axis[i].abs() > 0.5 || (stand.tip[i] > around.min[i] && stand.tip[i] < around.max[i])
            });
            if !(within && contact.below > ROUNDING) {
                continue;
            }
            let message = format!("{} is changed for {to} inside the stock", stand.tool);
            let finding = Finding::error(Code::CHANGE_IN_STOCK, message)
                .value((contact.below * 1e3).round() / 1e3, "mm below its top")
                .point(stand.tip.to_array())
                .help("retract above the stock before the change");
            found.push(simulated.at(setup, stand.item, finding));
        }
    }
    found
}
