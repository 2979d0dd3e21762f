//! Rules on a simulated program, one a file: those that neither the control nor the lines of the stock know, for
//! programs of kinecut and of others alike.

mod air;
mod axis_speed;
mod below;
mod carried;
mod certified;
mod change;
mod coolant;
mod cutting_data;
mod cutting_data_bounds;
mod deflection;
mod descent;
mod duration;
mod dwell;
mod edge;
mod feed;
mod inclined_entry;
mod load;
mod outline;
mod reach;
mod removal;
mod rubs;
mod sideways;
mod spindle;
mod start_depth;
mod text;
mod thin;
mod thread;
mod tip_control;
mod unknown_start;
mod work;

use rayon::prelude::*;

use super::check::Job;
use super::following::line_place;
use super::setup_outcome::SetupOutcome;
use super::simulate::Simulation;
use crate::base::{Finding, Location};
use crate::stock::cut::MoveEffect;
use crate::tool::{Tool, ToolNumber};
use crate::trace::{Segment, SegmentPace};
use work::{Work, works};

/// A simulated job, as rules see it.
#[derive(Clone, Copy, Debug)]
struct Simulated<'a> {
    /// The job.
    job: &'a Job,
    /// Its programs, followed.
    setups: &'a [SetupOutcome],
    /// The cut stock, and what each segment did to it.
    simulation: &'a Simulation,
    /// All pieces of work, in the order of the programs.
    works: &'a [Work<'a>],
}

/// A segment with what it did.
#[derive(Clone, Copy, Debug)]
pub(super) struct Done<'a> {
    /// Index in the trace.
    pub(super) index: usize,
    /// The segment.
    pub(super) segment: &'a Segment,
    /// Its effect on the stock.
    pub(super) effect: &'a MoveEffect,
}

impl Done<'_> {
    /// Whether the edges met material.
    pub(super) fn met(&self) -> bool {
        self.effect.first_contact.is_some() || self.effect.removed > 0.0
    }

    /// Path speed of a feed move [mm/s].
    pub(super) fn feed(&self) -> Option<f64> {
        match self.segment.motion {
            SegmentPace::Rapid => None,
            SegmentPace::Feed(feed) => Some(feed),
        }
    }

    /// Whether it cuts at feed.
    pub(super) fn cuts(&self) -> bool {
        self.feed().is_some() && self.met()
    }
}

impl<'a> Simulated<'a> {
    /// The block of an item of a setup's program.
    pub(super) fn place(&self, setup: usize, item: u32) -> Option<Location> {
        let done = &self.setups[setup];
        self.place_of_line(setup, done.lines.get(item as usize).copied().flatten())
    }

    /// A line, 0-based, of a setup's program.
    pub(super) fn place_of_line(&self, setup: usize, line: Option<u32>) -> Option<Location> {
        let done = &self.setups[setup];
        line_place(&done.file, &done.posted.text, line)
    }

    /// A finding at the block of an item.
    pub(super) fn at(&self, setup: usize, item: u32, mut finding: Finding) -> Finding {
        finding.place = self.place(setup, item);
        finding
    }

    /// The segments of a setup's program in order, without the ways that the machine only may take.
    pub(super) fn segments(&self, setup: usize) -> impl Iterator<Item = Done<'a>> + use<'a> {
        let segments = self.setups[setup].trace.segments.iter();
        segments
            .zip(&self.simulation.effects[setup])
            .enumerate()
            .map(|(index, (segment, effect))| Done { index, segment, effect })
            .filter(|d| !d.segment.alternative)
    }

    /// A tool of the job.
    pub(super) fn tool(&self, number: Option<ToolNumber>) -> Option<&'a Tool> {
        let number = number?;
        self.job.tools.iter().find(|t| t.number == number)
    }
}

/// A rule: what it finds, in the order of the program.
type Rule = fn(&Simulated<'_>) -> Vec<Finding>;

/// All rules; each is a file of this folder.
const RULES: &[Rule] = &[
    removal::removal,
    outline::outline,
    below::below,
    air::air,
    descent::descent,
    reach::reach,
    sideways::sideways,
    spindle::spindle,
    feed::feed,
    cutting_data::cutting_data,
    load::load,
    deflection::deflection,
    rubs::rubs,
    start_depth::start_depth,
    carried::carried,
    dwell::dwell,
    change::change,
    coolant::coolant,
    duration::duration,
    thin::thin,
    thread::thread,
    edge::edge,
    unknown_start::unknown_start,
    axis_speed::axis_speed,
    inclined_entry::inclined_entry,
    tip_control::tip_control,
    certified::certified,
];

/// Findings of all rules.
pub(super) fn findings(job: &Job, setups: &[SetupOutcome], simulation: &Simulation) -> Vec<Finding> {
    let moves = Simulated { job, setups, simulation, works: &[] };
    let simulated = Simulated { works: &works(&moves), ..moves };
    // Rules need nothing of each other; their findings stand in the order of the list.
    let found: Vec<Vec<Finding>> = RULES.par_iter().map(|rule| rule(&simulated)).collect();
    found.into_iter().flatten().collect()
}
