//! Engagement by block of a program, and `engagement.json`.

use serde::Serialize;

use super::super::json_text;
use super::super::outcome::Outcome;
use super::super::setup_outcome::SetupOutcome;
use super::course::{Chips, rates};
use super::load::{Deflection, Loads, force_of};
use super::tapping::tapped;
use crate::stock::cut::{EngagedStretch, MoveEngagement};
use crate::tool::ToolNumber;
use crate::trace::{Segment, SegmentPace};

/// Engagement of a tool in a block at feed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Block {
    /// Line of the program, from 1.
    pub(crate) line: u32,
    /// Tool in the spindle.
    pub(crate) tool: Option<ToolNumber>,
    /// Time at the programmed feed [s]; nothing where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) time: Option<f64>,
    /// Length of the way [mm].
    pub(crate) length: f64,
    /// Length of the way on which the tool takes nothing from any line [mm].
    pub(crate) air: f64,
    /// Volume [mm^3].
    pub(crate) removed: f64,
    /// Greatest arc of contact [degrees].
    pub(crate) arc: f64,
    /// Greatest height of contact along the axis of the tool [mm].
    pub(crate) depth: f64,
    /// Greatest width of contact across the feed [mm].
    pub(crate) width: f64,
    /// Greatest removal rate [mm^3/s], a mean over nine stretches of the way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) rate: Option<f64>,
    /// Greatest thickness of a chip [mm]; nothing where spindle or feed is not known, and of taps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) chip: Option<f64>,
    /// Greatest power at the edges (kW) after Kienzle with sharp edges, of a tap within 50 %; nothing where the force of the material,
    /// spindle or feed is not known, and of taps that form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) power: Option<f64>,
    /// Greatest torque (N m), as the power.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) torque: Option<f64>,
    /// Greatest deflection of the tip away from the wall [mm], by half of the cutting force; nothing where the power or the give of
    /// the tool is not known, and where a part of the block is cut with more than a quarter of the circle.
    #[serde(skip_serializing_if = "is_not_known", serialize_with = "known")]
    pub(crate) deflection: Deflection,
}

impl Block {
    /// A segment at feed by itself, in the block of a line.
    fn of(
        outcome: &Outcome,
        done: &SetupOutcome,
        line: u32,
        segment: &Segment,
        moved: &MoveEngagement,
    ) -> Block {
        let time = segment.duration.filter(|t| *t > 0.0);
        let greatest = |of: fn(&EngagedStretch) -> f64| moved.stretches.iter().map(of).fold(0.0, f64::max);
        let chips = Chips::of(done, segment, &outcome.job.tools);
        let loads = Loads::of(outcome, done, segment);
        let force = force_of(outcome.job.material.as_deref());
        let tap = || tapped(&outcome.job.tools, force?, done, segment);
        let load = loads.as_ref().map(|loads| loads.greatest(moved)).or_else(tap);
        let length = segment.curve.length();
        Block {
            line,
            tool: segment.tool,
            time,
            length,
            air: length * (1.0 - moved.share()),
            removed: moved.removed(),
            arc: greatest(|s| s.arc).to_degrees(),
            depth: greatest(|s| s.depth),
            width: greatest(|s| s.width),
            rate: time.map(|time| rates(moved).into_iter().fold(0.0, f64::max) / time),
            chip: chips.map(|chips| chips.thickest(greatest(|s| s.advance))),
            power: load.map(|load| load.power / 1000.0),
            torque: load.map(|load| load.torque),
            deflection: loads.map_or(Deflection::Unknown, |loads| loads.deflection(moved)),
        }
    }

    /// The two as one block.
    fn join(&mut self, other: &Block) {
        let greater = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a.max(b)).or(a).or(b);
        self.time = self.time.zip(other.time).map(|(a, b)| a + b);
        self.length += other.length;
        self.air += other.air;
        self.removed += other.removed;
        self.arc = self.arc.max(other.arc);
        self.depth = self.depth.max(other.depth);
        self.width = self.width.max(other.width);
        self.rate = greater(self.rate, other.rate);
        self.chip = greater(self.chip, other.chip);
        self.power = greater(self.power, other.power);
        self.torque = greater(self.torque, other.torque);
        self.deflection = self.deflection.join(other.deflection);
    }
}

fn is_not_known(deflection: &Deflection) -> bool {
    deflection.known().is_none()
}

fn known<S: serde::Serializer>(deflection: &Deflection, s: S) -> Result<S::Ok, S::Error> {
    deflection.known().serialize(s)
}

/// The blocks at feed of a setup's program in the order in which they are run; nothing where engagement was not measured.
pub(crate) fn blocks(outcome: &Outcome, setup: usize) -> Vec<Block> {
    let done = &outcome.setups[setup];
    let moves = outcome.simulation.engagement.iter().flat_map(|all| &all.moves[setup]);
    let mut blocks: Vec<Block> = Vec::new();
    let mut last_item = None;
    for (segment, moved) in done.trace.segments.iter().zip(moves) {
        let line = done.lines.get(segment.item as usize).copied().flatten();
        let (Some(line), SegmentPace::Feed(_), false) = (line, segment.motion, segment.alternative) else {
            continue;
        };
        let block = Block::of(outcome, done, line + 1, segment, moved);
        match blocks.last_mut() {
            Some(known) if last_item == Some(segment.item) && known.line == block.line => known.join(&block),
            _ => blocks.push(block),
        }
        last_item = Some(segment.item);
    }
    blocks
}

#[derive(Serialize)]
struct Json<'a> {
    /// Version of this form.
    format: u32,
    kinecut: &'static str,
    job: &'a str,
    /// Distance of the lines of the pass [mm].
    step: f64,
    /// Volume that the program removes from the stock model: that of its blocks, and of moves at rapid, is adjusted to it [mm^3].
    removed: f64,
    /// Sum of those volumes before that [mm^3].
    removed_as_measured: f64,
    setups: Vec<SetupJson<'a>>,
}

#[derive(Serialize)]
struct SetupJson<'a> {
    program: &'a str,
    blocks: Vec<Block>,
}

/// `engagement.json`: the engagement of the tools by block (mm, s, degrees); `None` where it was not measured.
pub fn engagement_json(outcome: &Outcome) -> Option<String> {
    let all = outcome.simulation.engagement.as_ref()?;
    let setups = (0..).zip(&outcome.setups);
    let setups = setups.map(|(i, done)| SetupJson { program: &done.file, blocks: blocks(outcome, i) });
    Some(json_text(&Json {
        format: 1,
        kinecut: crate::VERSION,
        job: &outcome.job_file,
        step: all.step,
        removed: all.taken,
        removed_as_measured: all.told,
        setups: setups.collect(),
    }))
}
