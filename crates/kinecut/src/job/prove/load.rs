//! Cuts that need nearly all of the spindle, or more than it has.

use super::Simulated;
use super::work::Work;
use crate::base::{Code, Finding};
use crate::cutting::{CuttingLoad, FORCE_SPREAD, TAPPING_SPREAD};
use crate::job::engagement::{Loads, force_of, tapped};
use crate::page::fixed;
use crate::tool::Cutter;

/// Share of the motor's power that arrives at the tool.
const EFFICIENCY: f64 = 0.8;
/// Share of a limit from which on a cut is near it.
const NEAR: f64 = 0.8;

/// A warning for each piece of work and each limit: at the block that needs most.
pub(super) fn load(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().flat_map(|work| one(simulated, work)).collect()
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Vec<Finding> {
    let job = simulated.job;
    let (Some(force), Some(machine), Some(engagement)) =
        (force_of(job.material.as_deref()), &job.machine, &simulated.simulation.engagement)
    else {
        return Vec::new();
    };
    if !machine.knows_spindle() {
        return Vec::new();
    }
    let control = &machine.control;
    let done = &simulated.setups[work.setup];
    let loads: Vec<(u32, CuttingLoad)> = work
        .feeds()
        .filter_map(|d| {
            let of_tap = || tapped(&job.tools, force, done, d.segment);
            let measured =
                |loads: Loads<'_>| Some(loads.greatest(engagement.moves[work.setup].get(d.index)?));
            let loads = Loads::with(&job.tools, force, done, d.segment);
            Some((d.segment.item, loads.and_then(measured).or_else(of_tap)?))
        })
        .collect();
    let speed = |item: u32| done.program.state(item as usize).spindle.rate();
    // The item, what it needs, and what there is: where most of it is needed.
    let worst = |needed: fn(&CuttingLoad) -> f64, limit: &dyn Fn(u32) -> Option<f64>| {
        let all = loads.iter().filter_map(|(item, load)| Some((*item, needed(load), limit(*item)?)));
        all.max_by(|a, b| (a.1 / a.2).total_cmp(&(b.1 / b.2)))
    };
    let curve = |item: u32| Some(machine.spindle_curve.as_ref()?.torque(speed(item)));
    let limits = [
        ("power", "kW", 1e-3, "power", worst(|load| load.power / EFFICIENCY, &|_| control.spindle_power)),
        ("torque", "N m", 1.0, "torque", worst(|load| load.torque, &|_| control.spindle_torque)),
        ("torque", "N m", 1.0, "curve", worst(|load| load.torque, &curve)),
    ];
    let is_tap = matches!(work.tool.cutter, Cutter::Tap(_));
    let spread = if is_tap { TAPPING_SPREAD } else { FORCE_SPREAD };
    let mut found = Vec::new();
    for (what, unit, factor, key, worst) in limits {
        let Some((item, needed, limit)) = worst else { continue };
        if needed <= NEAR * limit {
            continue;
        }
        let word = if needed > limit { "more than the" } else { "nearly all of the" };
        let turns = speed(item) * 60.0 / std::f64::consts::TAU;
        let message = format!(
            "a cut of {} needs {word} {what} of the spindle, within {:.0} %, at {turns:.0} rev/min",
            work.tool.number,
            100.0 * spread
        );
        let finding = Finding::warning(Code::CUTTING_LOAD, message)
            .value(rounded(needed * factor), unit)
            .bound(rounded(limit * factor), &format!("{unit}, `spindle_{key}` of the machine"))
            .help(match (is_tap, key) {
                (true, "power") => "take a lower speed, or mill the thread".to_owned(),
                (true, _) => "mill the thread, or take a wider core hole".to_owned(),
                (false, _) => format!(
                    "take a smaller depth, engagement or feed: {:.2} of the depth leaves a fifth in hand",
                    (NEAR * limit / needed * 100.0).floor() / 100.0
                ),
            });
        found.push(simulated.at(work.setup, item, finding));
    }
    found
}

/// One decimal.
fn rounded(value: f64) -> f64 {
    fixed(value, 1).parse().unwrap_or(value)
}
