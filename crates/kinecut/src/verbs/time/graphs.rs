//! Graphs of the motion over time and over the way of the tip, and the limits that it is at.

use super::Timed;
use super::in_order::{InOrder, gaps};
use super::limits_met::{LimitsMet, Moving};
use super::over::Over;
use super::slow_block::SlowBlock;
use super::ways::Ways;
use crate::base::{Progress, Result};
use crate::motion::{LimitMet, axis_limits};
use crate::page::{self, Block, Section};
use crate::trace::SegmentPace;

/// Samples of all programs together: beyond it they lie farther apart than a millisecond.
const SAMPLES: f64 = 200_000.0;
/// Shortest time between samples [s].
const CYCLE: f64 = 1e-3;
/// Blocks that are marked.
const MARKS: usize = 5;

impl Timed {
    /// The graphs of the motion, with the starts of the slowest blocks, and the limits that it is at.
    ///
    /// # Errors
    /// `KC0009` when it was cancelled.
    pub(super) fn graphs(&self, slowest: &[SlowBlock], progress: &dyn Progress) -> Result<Vec<Section>> {
        let total = self.total();
        let cycle = CYCLE.max(total / SAMPLES);
        let mut limits = axis_limits(&self.machine);
        if self.accelerations_jump() {
            limits.iter_mut().flatten().for_each(|limit| limit.jerk = f64::INFINITY);
        }
        let mut ways: Vec<Ways> = self.programs.iter().map(|(program, _)| Ways::new(program)).collect();
        let mut way_before = vec![0.0];
        for ways in &ways {
            way_before.push(way_before[way_before.len() - 1] + ways.total());
        }
        let way_of_all = way_before[ways.len()];
        let mut over = [Over::new(("time", "s"), total), Over::new(("way of the tip", "mm"), way_of_all)];
        let mut met = LimitsMet::new();
        let mut begun = 0;
        let mut marked: Vec<(usize, u32)> = Vec::new();
        let is_slow = |one: &InOrder, line: u32| {
            slowest.iter().take(MARKS).any(|block| block.line == line && block.file == one.program.file)
        };
        let sampled = self.in_order(cycle, "graphs", progress, &mut |one| {
            let trace = &one.program.trace;
            let segment = one.sample.segment.map(|segment| &trace.segments[segment as usize]);
            let programmed = match segment.map(|segment| segment.motion) {
                Some(SegmentPace::Feed(feed)) => feed,
                _ => f64::INFINITY,
            };
            let way = way_before[one.number - 1] + ways[one.number - 1].at(one.sample);
            let places = [one.before + one.sample.time, way];
            for (over, place) in over.iter_mut().zip(places) {
                over.add(place, one.sample, programmed, &limits);
            }
            if let Some(line) = one.line.filter(|line| is_slow(one, *line))
                && !marked.contains(&(one.number, line))
            {
                marked.push((one.number, line));
                over.iter_mut().zip(places).for_each(|(over, place)| over.mark(place, line));
            }
            if begun < one.number {
                begun = one.number;
                met.begin(one.program, self.programs.len() > 1);
            }
            let moving = segment.map(|segment| Moving {
                limit: LimitMet::of(one.sample, programmed, &limits),
                is_rapid: segment.motion == SegmentPace::Rapid,
                tip: segment.tip_at(one.sample.axes.map(|axis| axis.position)),
            });
            met.at([one.sample.time, one.sample.feed], cycle, moving);
            Ok(())
        })?;
        let mut notes = gaps(sampled.left_out, sampled.left_out_time, sampled.jumps);
        if cycle > CYCLE {
            let each = page::trimmed(cycle * 1e3, 1);
            notes.push(format!("the samples are {each} ms apart: what is shorter does not show"));
        }
        if self.accelerations_jump() {
            notes.push("jerk is not limited on all moves, and not drawn".to_owned());
        }
        let [time, way] = over;
        let mut sections = vec![
            met.section(&limits),
            time.section("Motion over time", cycle, &limits),
            way.section("Motion over the way", cycle, &limits),
        ];
        if !notes.is_empty() {
            sections[0].blocks.push(Block::List(notes));
        }
        Ok(sections)
    }
}
