//! Graphs of the motion over time: the feed, and what each axis uses of its limits.

use super::Timed;
use super::in_order::{InOrder, gaps};
use super::moving::MovingProgram;
use super::slow_block::SlowBlock;
use super::timed::LETTERS;
use crate::base::{Progress, Result};
use crate::motion::{AxisLimit, MotionSample, axis_limits};
use crate::page::{self, Block, Chart, Section};
use crate::program::Speed;

/// Columns of a graph.
const COLUMNS: usize = 800;
/// Samples of all programs together: beyond it they lie farther apart than a millisecond.
const SAMPLES: f64 = 200_000.0;
/// Shortest time between samples [s].
const CYCLE: f64 = 1e-3;
/// Blocks that are marked.
const MARKS: usize = 5;

/// Extremes of a quantity in each column.
struct Columns(Vec<[f64; 2]>);

impl Columns {
    fn new() -> Columns {
        Columns(vec![[f64::INFINITY, f64::NEG_INFINITY]; COLUMNS])
    }

    fn add(&mut self, column: usize, value: f64) {
        let [least, most] = &mut self.0[column];
        *least = least.min(value);
        *most = most.max(value);
    }

    /// Through the extremes of the columns, `width` [s] wide; columns without samples are gaps.
    fn points(&self, width: f64) -> Vec<[f64; 2]> {
        let mut points = Vec::with_capacity(2 * COLUMNS);
        for (i, [least, most]) in self.0.iter().enumerate() {
            let at = (i as f64 + 0.5) * width;
            if least > most {
                points.push([at, f64::NAN]);
                continue;
            }
            points.push([at, *least]);
            if most > least {
                points.push([at, *most]);
            }
        }
        points
    }
}

/// Quantities over the time of all programs.
struct Gathered {
    width: f64,
    feed: Columns,
    programmed: Columns,
    /// Shares of velocity, acceleration and jerk, of each axis.
    shares: [[Columns; 6]; 3],
}

impl Gathered {
    fn add(&mut self, time: f64, sample: &MotionSample, programmed: f64, limits: &[Option<AxisLimit>; 6]) {
        let column = ((time / self.width) as usize).min(COLUMNS - 1);
        self.feed.add(column, sample.feed * 60.0);
        if programmed.is_finite() {
            self.programmed.add(column, programmed * 60.0);
        }
        for (axis, limit) in limits.iter().enumerate() {
            let Some(limit) = limit else { continue };
            let at = &sample.axes[axis];
            let used =
                [at.velocity / limit.velocity, at.acceleration / limit.acceleration, at.jerk / limit.jerk];
            for (columns, used) in self.shares.iter_mut().zip(used) {
                columns[axis].add(column, 100.0 * used);
            }
        }
    }
}

impl Timed {
    /// The graphs of the motion, with the starts of the slowest blocks.
    ///
    /// # Errors
    /// `KC0009` when it was cancelled.
    pub(super) fn graphs(&self, slowest: &[SlowBlock], progress: &dyn Progress) -> Result<Section> {
        let total = self.total();
        let cycle = CYCLE.max(total / SAMPLES);
        let mut limits = axis_limits(&self.machine);
        let mut gathered = Gathered {
            width: (total / COLUMNS as f64).max(f64::MIN_POSITIVE),
            feed: Columns::new(),
            programmed: Columns::new(),
            shares: std::array::from_fn(|_| std::array::from_fn(|_| Columns::new())),
        };
        let mut marks: Vec<(f64, usize, u32)> = Vec::new();
        let marked = |one: &InOrder, line: u32| {
            slowest.iter().take(MARKS).any(|block| block.line == line && block.file == one.program.file)
        };
        let sampled = self.in_order(cycle, "graphs", progress, &mut |one| {
            let time = one.before + one.sample.time;
            gathered.add(time, one.sample, programmed(one.program, one.sample), &limits);
            if let Some(line) = one.line.filter(|line| marked(one, *line))
                && marks.iter().all(|(_, number, other)| (*number, *other) != (one.number, line))
            {
                marks.push((time, one.number, line));
            }
            Ok(())
        })?;
        let mut notes = gaps(sampled.left_out, sampled.left_out_time, sampled.jumps);
        if cycle > CYCLE {
            let each = page::trimmed(cycle * 1e3, 1);
            notes.push(format!("the samples are {each} ms apart: what is shorter does not show"));
        }
        if self.accelerations_jump() {
            notes.push("jerk is not limited on all moves, and not drawn".to_owned());
            for limit in limits.iter_mut().flatten() {
                limit.jerk = f64::INFINITY;
            }
        }
        let section = section(&gathered, &marks, cycle, &limits);
        Ok(if notes.is_empty() { section } else { section.with(Block::List(notes)) })
    }
}

/// The feed of the block of a sample [mm/s]; infinite where it has none of its own.
fn programmed(program: &MovingProgram, sample: &MotionSample) -> f64 {
    match program.program.state(sample.item as usize).speed {
        Speed::PerMinute(feed) => feed,
        _ => f64::INFINITY,
    }
}

fn section(
    gathered: &Gathered,
    marks: &[(f64, usize, u32)],
    cycle: f64,
    limits: &[Option<AxisLimit>; 6],
) -> Section {
    let each = page::trimmed(cycle * 1e3, 3);
    let with_marks = |chart: Chart| {
        marks.iter().fold(chart, |chart, (time, _, line)| chart.mark(*time, format!("line {line}")))
    };
    let time = ("time", "s");
    let feed =
        Chart::new(&format!("Feed, least and most of samples each {each} ms"), time, ("feed", "mm/min"))
            .series("programmed", gathered.programmed.points(gathered.width))
            .series("of the tip", gathered.feed.points(gathered.width));
    let mut section = Section::new("Motion").with(with_marks(feed));
    let kinds = ["Velocity", "Acceleration", "Jerk"];
    for ((kind, name), columns) in kinds.into_iter().enumerate().zip(&gathered.shares) {
        let title = format!("{name} of each axis over its limit");
        let mut chart = Chart::new(&title, time, ("share of the limit", "%"));
        for (axis, limit) in limits.iter().enumerate() {
            let Some(limit) = limit else { continue };
            let value = [limit.velocity, limit.acceleration, limit.jerk][kind];
            if value.is_finite() {
                let name = format!("{}, of {}", LETTERS[axis], quantity(kind, axis > 2, value));
                chart = chart.series(name, columns[axis].points(gathered.width));
            }
        }
        if !chart.series.is_empty() {
            section = section.with(with_marks(chart.level(100.0, "limit").level(-100.0, "limit")));
        }
    }
    section
}

/// A limit in the units of the machine file: mm/min, m/s2, m/s3; rev/min, degrees/s2, degrees/s3.
fn quantity(kind: usize, is_rotary: bool, value: f64) -> String {
    let (factor, unit) = match (is_rotary, kind) {
        (false, 0) => (60.0, "mm/min"),
        (false, 1) => (1e-3, "m/s\u{b2}"),
        (false, _) => (1e-3, "m/s\u{b3}"),
        (true, 0) => (60.0 / std::f64::consts::TAU, "rev/min"),
        (true, 1) => (1f64.to_degrees(), "degrees/s\u{b2}"),
        (true, _) => (1f64.to_degrees(), "degrees/s\u{b3}"),
    };
    format!("{} {unit}", page::trimmed(value * factor, 3))
}
