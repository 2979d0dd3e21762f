//! The quantities of a motion over its time, or over the way of the tip.

use glam::DVec3;

use super::columns::{COLUMNS, Columns};
use super::timed::LETTERS;
use crate::motion::{AxisLimit, AxisMoment, MotionSample};
use crate::page::{Chart, Section, trimmed};

/// Axes of a program with their limits.
pub(super) type Limits = [Option<AxisLimit>; 6];

/// Quantities over the time, or over the way, of all programs.
pub(super) struct Over {
    /// Name and unit of what they are over.
    name: (&'static str, &'static str),
    width: f64,
    /// Feed: programmed, and of the tip.
    feed: [Columns; 2],
    /// Acceleration and jerk of X, Y and Z together: whole, and along the way.
    whole: [[Columns; 2]; 2],
    /// Shares of velocity, acceleration and jerk, of each axis.
    shares: [[Columns; 6]; 3],
    /// Places of blocks, with their lines.
    marks: Vec<(f64, u32)>,
}

impl Over {
    /// Over a quantity with name and unit, from 0 to its extent.
    pub(super) fn new(name: (&'static str, &'static str), extent: f64) -> Over {
        Over {
            name,
            width: (extent / COLUMNS as f64).max(f64::MIN_POSITIVE),
            feed: std::array::from_fn(|_| Columns::new()),
            whole: std::array::from_fn(|_| std::array::from_fn(|_| Columns::new())),
            shares: std::array::from_fn(|_| std::array::from_fn(|_| Columns::new())),
            marks: Vec::new(),
        }
    }

    /// Adds a sample at a place. The programmed feed [mm/s] is infinite where a move has no feed.
    pub(super) fn add(&mut self, place: f64, sample: &MotionSample, programmed: f64, limits: &Limits) {
        let column = ((place / self.width) as usize).min(COLUMNS - 1);
        if programmed.is_finite() {
            self.feed[0].add(column, programmed * 60.0);
        }
        self.feed[1].add(column, sample.feed * 60.0);
        let of = |pick: fn(&AxisMoment) -> f64| DVec3::from_array([0, 1, 2].map(|a| pick(&sample.axes[a])));
        let ahead = of(|axis| axis.velocity).normalize_or_zero();
        for (columns, rate) in self.whole.iter_mut().zip([of(|axis| axis.acceleration), of(|axis| axis.jerk)])
        {
            columns[0].add(column, 1e-3 * rate.length());
            if ahead != DVec3::ZERO {
                columns[1].add(column, 1e-3 * rate.dot(ahead));
            }
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

    /// Marks a block.
    pub(super) fn mark(&mut self, place: f64, line: u32) {
        self.marks.push((place, line));
    }

    fn chart(&self, title: &str, y: (&str, &str)) -> Chart {
        let chart = Chart::new(title, self.name, y);
        self.marks.iter().fold(chart, |chart, (at, line)| chart.mark(*at, format!("line {line}")))
    }

    /// The graphs, of samples each `cycle` [s].
    pub(super) fn section(&self, title: &str, cycle: f64, limits: &Limits) -> Section {
        let each = trimmed(cycle * 1e3, 3);
        let of = |columns: &Columns| columns.points(self.width);
        let feed = self
            .chart(&format!("Feed, least and most of samples each {each} ms"), ("feed", "mm/min"))
            .series("programmed", of(&self.feed[0]))
            .series("of the tip", of(&self.feed[1]));
        let mut section = Section::new(title).with(feed);
        let has = |kind: usize| limits.iter().flatten().any(|limit| of_kind(limit, kind).is_finite());
        let names = [("Acceleration", "m/s\u{b2}"), ("Jerk", "m/s\u{b3}")];
        for (kind, (name, unit)) in names.into_iter().enumerate() {
            if has(kind + 1) {
                let chart = self
                    .chart(&format!("{name} of X, Y and Z together"), (&name.to_lowercase(), unit))
                    .series("whole", of(&self.whole[kind][0]))
                    .series("along the way", of(&self.whole[kind][1]));
                section = section.with(chart);
            }
        }
        let kinds = ["Velocity", "Acceleration", "Jerk"];
        for ((kind, name), columns) in kinds.into_iter().enumerate().zip(&self.shares) {
            let title = format!("{name} of each axis over its limit");
            let mut chart = self.chart(&title, ("share of the limit", "%"));
            for (axis, limit) in limits.iter().enumerate() {
                let Some(value) = limit.map(|limit| of_kind(&limit, kind)).filter(|value| value.is_finite())
                else {
                    continue;
                };
                let name = format!("{}, of {}", LETTERS[axis], quantity(kind, axis > 2, value));
                chart = chart.series(name, of(&columns[axis]));
            }
            if !chart.series.is_empty() {
                section = section.with(chart.level(100.0, "limit").level(-100.0, "limit"));
            }
        }
        section
    }
}

/// The limit of velocity (0), acceleration (1) or jerk (2).
pub(super) fn of_kind(limit: &AxisLimit, kind: usize) -> f64 {
    [limit.velocity, limit.acceleration, limit.jerk][kind]
}

/// A limit in the units of the machine file: mm/min, m/s2, m/s3; rev/min, degrees/s2, degrees/s3.
pub(super) fn quantity(kind: usize, is_rotary: bool, value: f64) -> String {
    let (factor, unit) = match (is_rotary, kind) {
        (false, 0) => (60.0, "mm/min"),
        (false, 1) => (1e-3, "m/s\u{b2}"),
        (false, _) => (1e-3, "m/s\u{b3}"),
        (true, 0) => (60.0 / std::f64::consts::TAU, "rev/min"),
        (true, 1) => (1f64.to_degrees(), "degrees/s\u{b2}"),
        (true, _) => (1f64.to_degrees(), "degrees/s\u{b3}"),
    };
    format!("{} {unit}", trimmed(value * factor, 3))
}
