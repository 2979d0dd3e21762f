//! A tap that is not fed by its pitch in the sense of its thread, or that meets material where a core hole should be; and
//! a tapping cycle with another tool.
//!
//! An operation of the job measures its core holes itself.

use super::work::Work;
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::program::{Cycle, Item, SAME_PITCH};
use crate::tool::{Cutter, Tap};

/// Depth of material that counts [mm].
const LEAST: f64 = 0.05;

pub(super) fn thread(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for work in simulated.works {
        let Cutter::Tap(tap) = work.tool.cutter else {
            found.extend(work.feeds().find_map(|done| no_tap(simulated, work, done)));
            continue;
        };
        found.extend(work.feeds().find_map(|done| not_geared(simulated, work, done, tap)));
        found.extend(solid(simulated, work));
    }
    found
}

/// A tapping cycle with a tool that is no tap: the pitch that its feed should have is not known.
fn no_tap(simulated: &Simulated<'_>, work: &Work<'_>, done: &Done<'_>) -> Option<Finding> {
    let item = done.segment.item;
    let Item::Cycle(Cycle::Tap(cycle), _) = simulated.setups[work.setup].program.items.get(item as usize)
    else {
        return None;
    };
    let message = format!("{} is no tap, but the program taps with it", work.tool.number);
    let finding = Finding::error(Code::TAP_FEED, message)
        .value(cycle.pitch, "mm/rev in the program")
        .help("if it is one, give it `type = \"tap\"` and its `pitch`: feed and speed are compared with it");
    Some(simulated.at(work.setup, item, finding))
}

/// The defect of a feed move of a tap.
fn not_geared(simulated: &Simulated<'_>, work: &Work<'_>, done: &Done<'_>, tap: Tap) -> Option<Finding> {
    let item = done.segment.item;
    let (number, hand) = (work.tool.number, work.tool.limits.hand);
    let finding = match simulated.setups[work.setup].program.items.get(item as usize) {
        Item::Cycle(Cycle::Tap(cycle), _) if (cycle.pitch - tap.pitch).abs() > SAME_PITCH => {
            let finding =
                Finding::error(Code::TAP_FEED, format!("{number} is fed by another pitch than its own"));
            finding.value(cycle.pitch, "mm/rev").bound(tap.pitch, "mm, `pitch`").help("correct F or S")
        }
        Item::Cycle(Cycle::Tap(cycle), _) if cycle.hand != hand => {
            let message = format!("{number} is turned in the sense of a thread of the other hand");
            Finding::error(Code::TAP_FEED, message).help("`hand` of the tool says which way it cuts")
        }
        Item::Cycle(Cycle::Tap(_), _) => return None,
        _ => {
            let inside = done.segment.curve.bounds().meets(simulated.job.stock.bounds());
            if !inside {
                return None;
            }
            let message = format!("{number} is a tap and moves at a feed that nothing keeps to its turns");
            Finding::error(Code::TAP_FEED, message).help("write the tapping cycle of the control")
        }
    };
    Some(simulated.at(work.setup, item, finding))
}

/// The first thread in solid material.
fn solid(simulated: &Simulated<'_>, work: &Work<'_>) -> Option<Finding> {
    let done = work.done.iter().find(|d| d.cuts() && d.effect.deepest > LEAST)?;
    let message = format!("{} meets material where its core hole should be", work.tool.number);
    let finding = Finding::error(Code::TAP_MEETS, message)
        .value((done.effect.deepest * 1e3).round() / 1e3, "mm deep")
        .help("drill the core hole before it, as wide and as deep as the thread needs");
    work.operation.is_none().then(|| simulated.at(work.setup, done.segment.item, finding))
}
