//! Feeds that ask an axis for more speed than its drive has: mostly a rotary axis that goes the long way round.

use std::f64::consts::TAU;

use super::Simulated;
use crate::base::{Code, Finding};
use crate::job::setup_outcome::SetupOutcome;
use crate::machine::Machine;
use crate::trace::{Segment, SegmentPace};

/// Addresses of the axes in the order of a segment's joints.
const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Intervals of a segment between which the mean speed of an axis is taken.
const INTERVALS: u32 = 16;
/// Ratio explained by rounding feeds and positions to the digits of a program.
const SLACK: f64 = 1.005;

/// The segment on which an axis needs most of its speed.
struct Worst {
    item: u32,
    speed: f64,
    items: Vec<u32>,
}

/// Axes that a feed asks for more than their rapid speed: one error for each setup and axis, at the worst block.
pub(super) fn axis_speed(simulated: &Simulated<'_>) -> Vec<Finding> {
    let Some(machine) = &simulated.job.machine else { return Vec::new() };
    let most = LETTERS.map(|letter| rapid(machine, letter));
    let one = |(setup, done): (usize, &SetupOutcome)| -> Vec<Finding> {
        let mut worst: [Option<Worst>; 6] = [const { None }; 6];
        for segment in done.trace.segments.iter().filter(|s| s.motion != SegmentPace::Rapid && !s.alternative)
        {
            let speeds = needed(segment);
            for i in 0..6 {
                let (Some(most), speed) = (most[i], speeds[i]) else { continue };
                if speed > most * SLACK {
                    let entry = &mut worst[i];
                    let before = entry.get_or_insert(Worst { item: segment.item, speed, items: Vec::new() });
                    before.items.push(segment.item);
                    if speed > before.speed {
                        (before.item, before.speed) = (segment.item, speed);
                    }
                }
            }
        }
        let said = |(i, worst): (usize, Option<Worst>)| {
            let mut worst = worst?;
            worst.items.dedup();
            let (unit, factor) = if i > 2 { ("rev/min", 60.0 / TAU) } else { ("mm/min", 60.0) };
            let further = match worst.items.len() {
                1 => String::new(),
                more => format!(", in {more} blocks; here it needs most"),
            };
            let what = format!("{} must move faster than its drive can{further}", LETTERS[i]);
            let finding = Finding::error(Code::AXIS_TOO_FAST, what)
                .value((worst.speed * factor * 10.0).round() / 10.0, unit)
                .bound(most[i]? * factor, unit)
                .help(if i > 2 {
                    "lower the feed there, or let the axis go the short way"
                } else {
                    "lower the feed below the rapid speed of the axis"
                });
            Some(Finding { place: simulated.place(setup, worst.item), ..finding })
        };
        worst.into_iter().enumerate().filter_map(said).collect()
    };
    simulated.setups.iter().enumerate().flat_map(one).collect()
}

/// Rapid speed of an axis [mm/s, rad/s], if it is known.
fn rapid(machine: &Machine, letter: char) -> Option<f64> {
    let (_, joint) = machine.joint(letter)?;
    joint.dynamics.rapid.or(machine.dynamics.rapid.filter(|_| !joint.motion.is_rotation()))
}

/// The greatest mean speed of each axis between neighbouring places of a segment [mm/s, rad/s]; zero where its time is not
/// known.
fn needed(segment: &Segment) -> [f64; 6] {
    let mut most = [0.0f64; 6];
    let Some(seconds) = segment.duration.filter(|s| *s > 0.0) else { return most };
    let each = seconds / f64::from(INTERVALS);
    let mut before: Option<[f64; 6]> = None;
    for k in 0..=INTERVALS {
        let Some(now) = segment.joints(f64::from(k) / f64::from(INTERVALS)) else { return [0.0; 6] };
        if let Some(before) = before {
            for i in 0..6 {
                most[i] = most[i].max((now[i] - before[i]).abs() / each);
            }
        }
        before = Some(now);
    }
    most
}
