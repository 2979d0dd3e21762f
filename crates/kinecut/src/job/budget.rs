//! Memory of a run, told before the stages that take it.

use glam::DVec3;

use super::check::{Design, Job};
use super::part_surface::{PartSurface, every};
use super::{contacts, engagement, playback, uncertain};
use crate::base::{Code, Finding, Result};
use crate::contact::Body;
use crate::geom::Aabb;
use crate::stock::TriDexel;
use crate::stock::cut::{CutAxis, Playback};
use crate::stock::surface::SurfaceOptions;
use crate::trace::{Segment, Trace};

/// Memory of a move from its text to the verdict [bytes]: block, move, path, cut, what it met. A program of a million lines takes
/// 540 for each.
const MOVE: u64 = 620;

/// The same of a move with a tool that leans or turns, which has a motion of its own [bytes].
const LEANING_MOVE: u64 = 1750;

/// Memory of a move that is cut once more, with its effect [bytes].
const MOVE_AGAIN: u64 = 300;

/// Memory of an end of a line that is compared with the wanted part [bytes]: what wants it, how far it is off, with what tolerance.
const COMPARED: u64 = 24;

/// The coarsest step that is looked for [mm].
const COARSEST: f64 = 1e4;

/// Memory that a run needs, as far as it is known before anything is cut [bytes].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Budget {
    /// Number of lines of the stock model.
    pub line_count: u64,
    /// The lines, with at most two stretches of material each.
    pub stock: u64,
    /// The surface of the cut part, however little of it there is; its vertices and triangles are counted as they are found.
    pub surface: u64,
    /// The comparison of the lines with the wanted part.
    pub comparison: u64,
    /// The lines of the pass that measures engagement, with at most two stretches of material each.
    pub engagement: u64,
    /// The stock over time: its lines, with at most two stretches of material each, and its surface.
    pub playback: u64,
    /// The lines of a stock that may be larger, where something may be off, with at most two stretches of material each; and its moves.
    pub uncertain: u64,
    /// Bodies that tools and machine are compared with in one setup at most, and its moves; more for contacts that are found.
    pub contacts: u64,
    /// Number of moves.
    pub move_count: u64,
    /// The moves, with what they do.
    pub moves: u64,
}

/// Memory of a design that is compared with, as a body that tools may meet; for distances alone it takes less.
fn of_design(design: &Design) -> u64 {
    Body::memory_of_mesh(design.mesh.triangles.len())
}

/// Memory of the pass that measures engagement, at a step that is no finer than the given one [mm].
fn of_engagement(job: &Job, step: f64) -> u64 {
    TriDexel::memory(job.stock.bounds(), engagement::step(job).max(step))
}

/// Memory of the stock over time, at a step that is no finer than the given one [mm].
fn of_playback(job: &Job, step: f64) -> u64 {
    let (bounds, step) = (job.stock.bounds(), playback::step(job).max(step));
    TriDexel::memory(bounds, step).saturating_add(Playback::memory(bounds, step))
}

/// Memory of the stock that may be larger, and of the moves that cut it, at a step.
fn of_uncertain(job: &Job, moves: u64, step: f64) -> u64 {
    match job.uncertainty {
        Some(_) => uncertain::memory(job, step).saturating_add(moves.saturating_mul(MOVE_AGAIN)),
        None => 0,
    }
}

impl Budget {
    /// Of a job whose programs make these moves.
    pub fn new(job: &Job, traces: &[&Trace]) -> Budget {
        let segments = || traces.iter().flat_map(|t| &t.segments);
        // Neighbours mostly have one axis.
        let mut last = (DVec3::NAN, false);
        let mut leans = |s: &Segment| {
            if s.axis != last.0 {
                last = (s.axis, CutAxis::of(s.axis).is_none());
            }
            s.turning.is_some() || last.1
        };
        let move_count = segments().count() as u64;
        Budget {
            move_count,
            engagement: if engagement::is_wanted(job, move_count) { of_engagement(job, 0.0) } else { 0 },
            playback: if job.playback { of_playback(job, 0.0) } else { 0 },
            uncertain: of_uncertain(job, move_count, job.step),
            contacts: contacts::memory(job, traces),
            moves: segments().map(|s| if leans(s) { LEANING_MOVE } else { MOVE }).sum(),
            ..Budget::of_stock(job, job.stock.bounds(), job.step)
        }
    }

    /// Of a job's stock at a step.
    fn of_stock(job: &Job, bounds: Aabb, step: f64) -> Budget {
        let external = job.setups.iter().all(|s| s.program.is_some());
        let compared = job.design.is_some() || !external;
        let lines = TriDexel::lines(bounds, step);
        Budget {
            line_count: lines,
            stock: TriDexel::memory(bounds, step),
            surface: match job.part_surface {
                PartSurface::None => 0,
                PartSurface::Picture if !compared => {
                    TriDexel::surface_memory(bounds, step * f64::from(every(lines)))
                }
                PartSurface::Picture | PartSurface::Full => TriDexel::surface_memory(bounds, step),
            },
            comparison: (if compared { lines.saturating_mul(4 * COMPARED) } else { 0 })
                .saturating_add(job.design.as_ref().map_or(0, of_design)),
            ..Budget::default()
        }
    }

    /// All of it [bytes].
    pub fn total(&self) -> u64 {
        [
            self.surface,
            self.comparison,
            self.engagement,
            self.uncertain,
            self.playback,
            self.contacts,
            self.moves,
        ]
        .into_iter()
        .fold(self.stock, u64::saturating_add)
    }

    /// The distance of the lines in words, and whether it was chosen.
    pub fn step(&self, job: &Job) -> String {
        let chosen = if job.default_step { ", as no step is given" } else { "" };
        format!("{} mm between lines{chosen}", crate::page::trimmed(job.step, 6))
    }

    /// The number of the lines in words.
    pub fn lines(&self) -> String {
        match self.line_count {
            few @ 0..100_000 => format!("{few} lines"),
            many => format!("{:.1} million lines", many as f64 / 1e6),
        }
    }

    /// All that is known beforehand in words.
    pub(super) fn told(&self, job: &Job) -> String {
        let triangles = if self.surface > 0 { ", more for the triangles of the surface" } else { "" };
        let gb = (self.total() as f64 / 1e7).ceil() / 100.0;
        format!("stock model: {}, {}, up to {gb:.2} GB of memory{triangles}", self.step(job), self.lines())
    }

    /// The fineness of the surface of a job's stock, with the memory that is left for its vertices and triangles.
    pub(super) fn surface_options(&self, job: &Job, stock: &TriDexel) -> SurfaceOptions {
        // Lines that are cut more than once have more stretches.
        let more = stock.memory_held().saturating_sub(self.stock);
        let left = job.memory.saturating_sub(self.total()).saturating_sub(more);
        SurfaceOptions { memory: Some(left), ..job.surface }
    }

    /// An error when it is more than the job allows, with the step at which it would not be.
    ///
    /// # Errors
    /// `KC0105` at `simulate.step`, or at `simulate.memory` when the moves alone need more.
    pub(super) fn check(&self, job: &Job) -> Result<()> {
        if self.total() <= job.memory {
            return Ok(());
        }
        let mb = |bytes: u64| (bytes as f64 / 1e6).ceil();
        let at = |step: f64| Budget {
            moves: self.moves,
            contacts: self.contacts,
            engagement: if self.engagement > 0 { of_engagement(job, step) } else { 0 },
            uncertain: of_uncertain(job, self.move_count, step),
            playback: if self.playback > 0 { of_playback(job, step) } else { 0 },
            ..Budget::of_stock(job, job.stock.bounds(), step)
        };
        let fits = coarsened(job.step, |step| at(step).total() <= job.memory);
        let (help, key) = match fits {
            Some(step) => {
                (format!("set simulate.step to {step} or more, or raise simulate.memory"), "simulate.step")
            }
            None => {
                let needed = mb(at(COARSEST).total());
                (
                    format!("set simulate.memory to {needed} or more, and take a coarser step"),
                    "simulate.memory",
                )
            }
        };
        let parts = [
            (self.stock, format!("lines of the stock {} mm apart", job.step)),
            (self.surface, "surface".to_owned()),
            (self.comparison, "comparison".to_owned()),
            (self.engagement, "engagement".to_owned()),
            (self.uncertain, "uncertainty".to_owned()),
            (self.playback, "playback".to_owned()),
            (self.contacts, "bodies for contacts".to_owned()),
            (self.moves, format!("{} moves", self.move_count)),
        ];
        let parts = parts.into_iter().filter(|(bytes, _)| *bytes > 0);
        let parts: Vec<String> = parts.map(|(bytes, what)| format!("{what}: {} MB", mb(bytes))).collect();
        let message = format!("the run needs more memory than allowed ({})", parts.join(", "));
        Err(Finding::error(Code::JOB_BUDGET, message)
            .value(mb(self.total()), "MB")
            .bound((job.memory as f64 / 1e6).floor(), "MB")
            .help(help)
            .key(key)
            .into())
    }
}

/// The least step above one, of three digits, at which something fits that needs the less the coarser the step.
fn coarsened(step: f64, fits: impl Fn(f64) -> bool) -> Option<f64> {
    if !fits(COARSEST) {
        return None;
    }
    let (mut no, mut yes) = (step, COARSEST);
    while yes > no * 1.0001 {
        let middle = (no * yes).sqrt();
        if fits(middle) { yes = middle } else { no = middle }
    }
    let digit = 10f64.powf(yes.log10().floor() - 2.0);
    let up = |n: f64| if digit < 1.0 { n / (1.0 / digit).round() } else { n * digit };
    let first = (yes / digit).ceil();
    // A coarser step may have one point more along an axis than the sum of its parts.
    (0..100).map(|n| up(first + f64::from(n))).find(|step| fits(*step))
}
