//! Feeds that ask an axis for more speed than its drive has: mostly a rotary axis that goes the long way round.

use std::f64::consts::TAU;

use super::Simulated;
use crate::base::{Code, Finding};
use crate::job::setup_outcome::SetupOutcome;
use crate::machine::Machine;
use crate::trace::{JointWay, Segment, SegmentPace};

/// Addresses of the axes in the order of a segment's joints.
const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// A part of a segment over which a mean speed is taken where there is no bound.
const LEAST_STRETCH: f64 = 1.0 / 4096.0;
/// Ratio of a bound on a speed to a speed that is reached at which both count as one.
const CLOSE: f64 = 1.002;
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
            let speeds = needed(segment, &most);
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

/// The greatest speed of each axis on a segment [mm/s, rad/s], where it is more than an axis has; else a bound or zero, and zero where
/// its time or its axes are not known. Next to a pole it is a mean over a small part of the move.
fn needed(segment: &Segment, most: &[Option<f64>; 6]) -> [f64; 6] {
    let (Some(seconds), Some(way)) = (segment.duration.filter(|s| *s > 0.0), JointWay::new(segment)) else {
        return [0.0; 6];
    };
    let mut fastest = Fastest {
        way: &way,
        allowed: most.map(|m| m.map_or(f64::INFINITY, |m| m * seconds)),
        found: [0.0; 6],
    };
    fastest.look(0.0, 1.0, [way.at(0.0), way.at(1.0)]);
    fastest.found.map(|speed| speed / seconds)
}

/// The greatest speeds of a way, by `t`, as far as they are more than what is allowed.
struct Fastest<'a> {
    way: &'a JointWay<'a>,
    allowed: [f64; 6],
    found: [f64; 6],
}

impl Fastest<'_> {
    fn look(&mut self, from: f64, to: f64, ends: [[f64; 6]; 2]) {
        let step = to - from;
        let rates = self.way.rates(from, to);
        for i in 0..6 {
            self.found[i] = self.found[i].max((ends[1][i] - ends[0][i]).abs() / step);
        }
        let within = |i: usize| rates[i].0 <= self.allowed[i].max(self.found[i] * CLOSE);
        if step <= LEAST_STRETCH || (0..6).all(within) {
            return;
        }
        let middle = 0.5 * (from + to);
        let at = self.way.at(middle);
        self.look(from, middle, [ends[0], at]);
        self.look(middle, to, [at, ends[1]]);
    }
}
