//! A tool that cuts dry where every other tool of the program has coolant. What a job says of its operations is meant.

use std::collections::BTreeMap;

use super::Simulated;
use crate::base::{Code, Finding};
use crate::program::Coolant;
use crate::tool::ToolNumber;

pub(super) fn coolant(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (setup, outcome) in simulated.setups.iter().enumerate().filter(|(_, s)| s.external.is_some()) {
        // For each tool its first cutting item, and whether it ever has coolant.
        let mut tools: BTreeMap<ToolNumber, (u32, bool)> = BTreeMap::new();
        for done in simulated.segments(setup).filter(|d| d.cuts()) {
            let Some(tool) = done.segment.tool else { continue };
            let wet = outcome.program.state(done.segment.item as usize).coolant != Coolant::Off;
            tools.entry(tool).or_insert((done.segment.item, false)).1 |= wet;
        }
        let dry: Vec<_> = tools.iter().filter(|(_, (_, wet))| !wet).collect();
        if let [(tool, (item, _))] = dry[..]
            && tools.len() > 1
        {
            let message = format!("{tool} cuts without coolant, which all other tools of the program have");
            let finding = Finding::warning(Code::NEVER_STARTED, message)
                .help("switch it on, or let it be if it cuts dry");
            found.push(simulated.at(setup, *item, finding));
        }
    }
    found
}
