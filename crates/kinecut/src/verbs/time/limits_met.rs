//! The limits that the motion is at: their time and way in a table, and the path in their colours.

use std::collections::BTreeMap;

use glam::DVec3;

use super::moving::MovingProgram;
use super::over::{Limits, of_kind, quantity};
use super::timed::LETTERS;
use crate::motion::{AxisBound, LimitMet};
use crate::page::{Cell, Colour, Dash, Ink, Plan, PlanLine, Row, Section, Table, Width, fixed, trimmed};

/// A limit, or a rest, in the order of the table where the time is the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Limit {
    Feed,
    Axis(usize, usize),
    Nothing,
    Rest,
}

/// Looks of the path, from the lowest to the topmost. Rapids are none of a feed's limits.
const LOOKS: [(Ink, &str); 6] = [
    (Ink::Line(Colour::Quiet, Width::Hair, Dash::Dashes), "rapid"),
    (Ink::line(Colour::Quiet, Width::Thin), "at the programmed feed"),
    (Ink::Line(Colour::Ink, Width::Thin, Dash::Dots), "at no limit"),
    (Ink::line(Colour::Series(0), Width::Bold), "at the speed of an axis"),
    (Ink::line(Colour::Series(2), Width::Wide), "at the acceleration of an axis"),
    (Ink::line(Colour::Series(1), Width::Wide), "at the jerk of an axis"),
];

/// The path of one program in stretches of one limit each.
struct Path {
    title: String,
    /// Way of a stretch [mm].
    cell: f64,
    /// Tips of the stretch at hand, its way and the time at each look [s].
    tips: Vec<DVec3>,
    way: f64,
    times: [f64; LOOKS.len()],
    /// Stretches of one look.
    runs: Vec<(usize, Vec<[f64; 2]>)>,
}

impl Path {
    fn new(title: String, program: &MovingProgram) -> Path {
        /// Stretches along the larger side of the path.
        const ACROSS: f64 = 400.0;
        /// Stretches of the whole way.
        const MOST: f64 = 50_000.0;
        let (mut low, mut high, mut way) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0);
        for segment in &program.trace.segments {
            for tip in [segment.curve.start(), segment.curve.end()] {
                (low, high) = (low.min(tip), high.max(tip));
            }
            way += segment.curve.length();
        }
        let span = (high - low).truncate().max_element().max(0.0);
        let cell = (span / ACROSS).max(way / MOST);
        Path { title, cell, tips: Vec::new(), way: 0.0, times: [0.0; LOOKS.len()], runs: Vec::new() }
    }

    fn add(&mut self, tip: DVec3, look: usize, time: f64) {
        if let Some(last) = self.tips.last() {
            self.way += (tip - last).length();
        }
        self.tips.push(tip);
        self.times[look] += time;
        if self.way >= self.cell {
            self.end();
        }
    }

    /// Ends a stretch; the next one begins where it ends.
    fn end(&mut self) {
        // A lone tip is where the stretch before has ended.
        let Some(last) = self.tips.last().copied().filter(|_| self.tips.len() > 1) else { return };
        let longest = (0..LOOKS.len()).fold(0, |a, b| if self.times[b] > self.times[a] { b } else { a });
        let points = self.tips.iter().map(|tip| [tip.x, tip.y]);
        match self.runs.last_mut() {
            Some((look, run)) if *look == longest => run.extend(points),
            _ => self.runs.push((longest, points.collect())),
        }
        (self.tips, self.way, self.times) = (vec![last], 0.0, [0.0; LOOKS.len()]);
    }

    /// The path is not followed to its next tip.
    fn interrupt(&mut self) {
        self.end();
        self.tips.clear();
        if let Some((_, run)) = self.runs.last_mut() {
            run.push([f64::NAN; 2]);
        }
    }

    fn plan(mut self) -> Plan {
        self.end();
        self.runs.sort_by_key(|(look, _)| *look);
        let lines = self.runs.into_iter().map(|(look, run)| {
            let (ink, name) = LOOKS[look];
            PlanLine::new(ink, name, run)
        });
        let cell = trimmed(self.cell, 2);
        let title =
            format!("{}, by stretches of {cell} mm in the colour of the limit it is at longest", self.title);
        Plan { lines: lines.collect(), ..Plan::new(title) }
    }
}

/// The motion at a moment.
#[derive(Clone, Copy)]
pub(super) struct Moving {
    pub(super) limit: LimitMet,
    pub(super) is_rapid: bool,
    /// The tip, if it is known [part coordinates].
    pub(super) tip: Option<DVec3>,
}

/// Time, that of rapids in it, and way [s, s, mm].
type Sums = [f64; 3];

/// The limits of programs so far.
pub(super) struct LimitsMet {
    all: BTreeMap<Limit, Sums>,
    paths: Vec<Path>,
    /// The last sample of the program at hand, if the axes move with their motion; then its time and feed [s, mm/s].
    last: Option<(Option<Moving>, [f64; 2])>,
}

impl LimitsMet {
    pub(super) fn new() -> LimitsMet {
        LimitsMet { all: BTreeMap::new(), paths: Vec::new(), last: None }
    }

    /// Another program begins.
    pub(super) fn begin(&mut self, program: &MovingProgram, several: bool) {
        let title = if several {
            format!("Path of {} from above", program.file)
        } else {
            "Path from above".to_owned()
        };
        self.paths.push(Path::new(title, program));
        self.last = None;
    }

    /// The motion at a time [s], with its feed [mm/s], if the axes move. It holds until the next sample, a cycle [s] at most.
    pub(super) fn at(&mut self, [time, feed]: [f64; 2], cycle: f64, moving: Option<Moving>) {
        if let Some((moving, [last, feed])) = self.last.replace((moving, [time, feed])) {
            let passed = (time - last).min(cycle);
            match moving {
                Some(moving) => self.add(moving, passed, feed),
                None => self.count(Limit::Rest, [passed, 0.0, 0.0]),
            }
        }
    }

    fn add(&mut self, Moving { limit, is_rapid, tip }: Moving, time: f64, feed: f64) {
        let (limit, look) = match limit {
            LimitMet::Feed => (Limit::Feed, 1),
            LimitMet::Nothing => (Limit::Nothing, 2),
            LimitMet::Axis(axis, bound) => {
                let kind = match bound {
                    AxisBound::Velocity => 0,
                    AxisBound::Acceleration => 1,
                    AxisBound::Jerk => 2,
                };
                (Limit::Axis(kind, axis), 3 + kind)
            }
        };
        let way = time * feed;
        self.count(limit, [time, if is_rapid { time } else { 0.0 }, way]);
        if let Some(path) = self.paths.last_mut() {
            match tip {
                Some(tip) => path.add(tip, if is_rapid { 0 } else { look }, time),
                None => path.interrupt(),
            }
        }
    }

    fn count(&mut self, limit: Limit, by: Sums) {
        let all = self.all.entry(limit).or_default();
        *all = std::array::from_fn(|i| all[i] + by[i]);
    }

    /// The table, and the paths in colours.
    pub(super) fn section(self, limits: &Limits) -> Section {
        let total: f64 = self.all.values().map(|[time, ..]| time).sum();
        let mut all: Vec<(Limit, Sums)> =
            self.all.into_iter().filter(|(_, [time, ..])| *time > 0.0).collect();
        all.sort_by(|a, b| b.1[0].total_cmp(&a.1[0]));
        let rows = all.into_iter().map(|(limit, [time, rapids, way])| {
            let [share, way] = [100.0 * time / total, way].map(|value| fixed(value, 1));
            let cells = [limit.words(limits), fixed(time, 3), fixed(rapids, 3), share, way];
            Row::new(cells.map(Cell::new).to_vec())
        });
        let share = trimmed(100.0 * LimitMet::SHARE, 0);
        let note =
            format!("At a limit: at least {share} % of it are used, and of no other limit a larger share.");
        let table = Table::new(
            "Limits that the motion is at",
            "Limit; Time [s]; Rapids [s]; Share of the time [%]; Way [mm]",
        );
        let section = Section::new("Limits").with(table.rows(rows).note(note));
        self.paths.into_iter().fold(section, |section, path| section.with(path.plan()))
    }
}

impl Limit {
    fn words(self, limits: &Limits) -> String {
        match self {
            Limit::Feed => "programmed feed".to_owned(),
            Limit::Nothing => "none of them".to_owned(),
            Limit::Rest => "rest".to_owned(),
            Limit::Axis(kind, axis) => {
                let name = ["speed", "acceleration", "jerk"][kind];
                let value = limits[axis].map(|limit| quantity(kind, axis > 2, of_kind(&limit, kind)));
                format!("{name} of {}, {}", LETTERS[axis], value.unwrap_or_default())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_has_the_look_that_it_has_longest_and_the_next_one_begins_where_it_ends() {
        let mut path = Path {
            title: String::new(),
            cell: 1.0,
            tips: Vec::new(),
            way: 0.0,
            times: [0.0; 6],
            runs: Vec::new(),
        };
        // Stretches up to 1, 2, 3 and 4 mm: at the jerk, twice at the feed, longest at the acceleration.
        let steps =
            [(5, 1.0), (5, 1.0), (5, 1.0), (5, 1.0), (1, 1.0), (1, 1.0), (1, 0.4), (4, 0.9), (1, 0.1)];
        for (i, (look, time)) in steps.into_iter().enumerate() {
            path.add(DVec3::new(0.5 * i as f64, 0.0, 0.0), look, time);
        }
        path.interrupt();
        let looks: Vec<usize> = path.runs.iter().map(|(look, _)| *look).collect();
        let ends: Vec<[f64; 2]> =
            path.runs.iter().map(|(_, run)| [run[0][0], run[run.len() - 1][0]]).collect();
        assert_eq!(looks, [5, 1, 4]);
        assert_eq!(ends[..2], [[0.0, 1.0], [1.0, 3.0]]);
        // The last one is interrupted: its end is a gap.
        assert!(ends[2][0] == 3.0 && ends[2][1].is_nan(), "{ends:?}");
    }
}
