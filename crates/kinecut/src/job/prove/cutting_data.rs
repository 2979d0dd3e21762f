//! Cutting data outside of what any maker recommends for any material: mostly a wrong digit, a wrong unit, or the number of
//! another tool. The bounds are in one file with their sources.

use std::f64::consts::TAU;

use super::cutting_data_bounds::{Bounds, bounds};
use super::work::Work;
use super::{Done, Simulated};
use crate::base::{Code, Finding};
use crate::tool::Cutter;

pub(super) fn cutting_data(simulated: &Simulated<'_>) -> Vec<Finding> {
    simulated.works.iter().flat_map(|work| one(simulated, work)).collect()
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>) -> Vec<Finding> {
    let bounds = bounds(&work.tool.cutter, 2.0 * work.radius());
    let mut found: Vec<(String, Finding)> = Vec::new();
    for done in work.done.iter().filter(|d| d.cuts() && d.segment.turning.is_none()) {
        for (what, finding) in wrong(simulated, work, done, &bounds) {
            // The first block of each kind is enough.
            if !found.iter().any(|(told, _)| *told == what) {
                found.push((what, simulated.at(work.setup, done.segment.item, finding)));
            }
        }
    }
    found.into_iter().map(|(_, f)| f).collect()
}

/// Values of one move that are outside their bounds.
fn wrong(
    simulated: &Simulated<'_>,
    work: &Work<'_>,
    done: &Done<'_>,
    bounds: &Bounds,
) -> Vec<(String, Finding)> {
    let mut found = Vec::new();
    let state = simulated.setups[work.setup].program.state(done.segment.item as usize);
    let turns = state.spindle.rate() / TAU;
    let Some(feed) = done.feed().filter(|_| turns > 0.0) else { return found };
    let mut check = |what: &str, value: f64, [least, most]: [f64; 2], unit: &str| {
        let (word, bound) = match (value < least, value > most) {
            (true, _) => ("small", least),
            (_, true) => ("large", most),
            _ => return,
        };
        let message = format!("the {what} of {} is implausibly {word}", work.tool.number);
        let finding = Finding::warning(Code::CUTTING_DATA, message)
            .value(significant(value), unit)
            .bound(significant(bound), unit)
            .help("correct S or F, or the number of teeth of the tool");
        found.push((format!("{what} {word}"), finding));
    };
    let diameter = 2.0 * work.radius();
    // [m/min] of [mm/s].
    check("cutting speed", std::f64::consts::PI * diameter * turns * 0.06, bounds.speed, "m/min");
    let per_turn = feed / turns;
    match work.tool.cutter {
        // Its feed is its pitch.
        Cutter::Tap(_) => {}
        Cutter::Drill { .. } => check("feed per revolution", per_turn, bounds.feed, "mm"),
        _ => check("feed per tooth", per_turn / f64::from(work.tool.teeth.max(1)), bounds.feed, "mm"),
    }
    if let Some(time) = done.segment.duration.filter(|t| *t > 0.0) {
        // [cm^3/min] of [mm^3/s].
        let removed = f64::min(done.effect.removed, most_swept(done, work.radius()));
        check("removal rate", removed / time * 0.06, [0.0, bounds.removal], "cm3/min");
    }
    found
}

/// The most that a move can sweep anew [mm^3]: a line of the stock stands for a square of a step, and a short move that
/// takes one takes less.
fn most_swept(done: &Done<'_>, radius: f64) -> f64 {
    let way = done.segment.curve.length();
    let along = (done.segment.curve.end() - done.segment.curve.start()).dot(done.segment.axis).abs();
    2.0 * radius * way * done.effect.deepest + std::f64::consts::PI * radius * radius * along
}

/// Three digits.
fn significant(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let unit = 10f64.powf(value.abs().log10().floor() - 2.0);
    let rounded = (value / unit).round() * unit;
    // Without the tail of binary numbers.
    format!("{rounded:.6}").parse().unwrap_or(rounded)
}
