//! Engagement over the time of a program.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::super::outcome::Outcome;
use super::super::setup_outcome::SetupOutcome;
use super::load::Loads;
use crate::stock::cut::MoveEngagement;
use crate::tool::{Cutter, Tool};
use crate::trace::{Segment, SegmentPace};

/// A stretch of time in which a tool takes material at feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Course {
    /// Its beginning and its end [s].
    pub(crate) time: [f64; 2],
    /// Arc of contact [degrees].
    pub(crate) arc: f64,
    /// Removal rate [mm^3/s]; nothing where the feed is not known.
    pub(crate) rate: Option<f64>,
    /// Greatest thickness of a chip [mm]; nothing where spindle or feed is not known, and of taps.
    pub(crate) chip: Option<f64>,
    /// Power at the edges (kW); nothing where the force of the material, spindle or feed is not known.
    pub(crate) power: Option<f64>,
}

/// The thickest chip of a tool by its way into the material, which is given in mm by fraction of a segment.
pub(crate) struct Chips<'a> {
    tool: &'a Tool,
    /// Turns of the spindle in the segment at the programmed feed.
    turns: f64,
}

impl Chips<'_> {
    /// Of a segment; `None` where spindle or feed is not known, and of taps.
    pub(crate) fn of<'a>(done: &SetupOutcome, segment: &Segment, tools: &'a [Tool]) -> Option<Chips<'a>> {
        let tool = tools.iter().find(|t| Some(t.number) == segment.tool)?;
        let rate = done.program.state(segment.item as usize).spindle.rate() / TAU;
        let turns = segment.duration? * rate;
        (turns > 0.0 && !matches!(tool.cutter, Cutter::Tap(_))).then_some(Chips { tool, turns })
    }

    /// The thickest [mm].
    pub(crate) fn thickest(&self, advance: f64) -> f64 {
        if advance > 0.0 {
            self.tool.spacing.thickest_chip(self.tool.teeth, advance / self.turns)
        } else {
            0.0
        }
    }
}

/// Stretches of a move on either side over which a removal rate is a mean: how many lines cross a single one is left to chance.
const AROUND: usize = 4;

/// Removal rates on the stretches of a move [mm^3 by fraction of the move].
pub(super) fn rates(moved: &MoveEngagement) -> Vec<f64> {
    let all = &moved.stretches;
    let one = |i: usize| {
        let around = &all[i.saturating_sub(AROUND)..all.len().min(i + AROUND + 1)];
        let removed: f64 = around.iter().map(|s| s.removed).sum();
        removed / (around[around.len() - 1].to - around[0].from)
    };
    (0..all.len()).map(one).collect()
}

/// The greatest arcs of contact about the stretches of a move [rad]: how much of one its lines show is left to chance, too.
pub(super) fn arcs(moved: &MoveEngagement) -> Vec<f64> {
    let all = &moved.stretches;
    let one = |i: usize| {
        let around = &all[i.saturating_sub(AROUND)..all.len().min(i + AROUND + 1)];
        around.iter().map(|s| s.arc).fold(0.0, f64::max)
    };
    (0..all.len()).map(one).collect()
}

/// The course along the program of a setup, in order of time; `begins`: for each line of all programs the time at which it begins [s];
/// `first_line`: where those of the setup begin.
pub(crate) fn course(outcome: &Outcome, setup: usize, begins: &[f64], first_line: u32) -> Vec<Course> {
    let done = &outcome.setups[setup];
    let Some(all) = &outcome.simulation.engagement else { return Vec::new() };
    let mut spent: BTreeMap<u32, f64> = BTreeMap::new();
    let mut course = Vec::new();
    for ((segment, moved), time) in
        done.trace.segments.iter().zip(&all.moves[setup]).zip(done.segment_times())
    {
        let line = done.lines.get(segment.item as usize).copied().flatten();
        let (Some(line), false) = (line, segment.alternative) else { continue };
        let before = spent.entry(line).or_insert(0.0);
        let begin = begins.get((line + first_line) as usize).copied().unwrap_or(0.0) + *before;
        *before += time;
        if !matches!(segment.motion, SegmentPace::Feed(_)) {
            continue;
        }
        let programmed = segment.duration.filter(|t| *t > 0.0);
        let chips = Chips::of(done, segment, &outcome.job.tools);
        let loads = Loads::of(outcome, done, segment);
        course.extend(moved.stretches.iter().zip(rates(moved)).map(|(s, rate)| Course {
            time: [s.from, s.to].map(|t| begin + t * time),
            arc: s.arc.to_degrees(),
            rate: programmed.map(|time| rate / time),
            chip: chips.as_ref().map(|chips| chips.thickest(s.advance)),
            power: loads.as_ref().map(|loads| loads.on(s, rate).power / 1000.0),
        }));
    }
    course.sort_by(|a, b| a.time[0].total_cmp(&b.time[0]));
    course
}
