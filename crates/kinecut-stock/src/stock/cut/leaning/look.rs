//! A line and a convex part of a tool at single times of a span.

use super::super::body::{ConvexPart, Touch};
use super::chord::{Chord, LineFrom};
use super::span::Pose;
use super::swept::{PARTS, SpanPoses, StockLine};

/// Looks at a line whose ends run to and fro within a span.
pub(super) const MOST_LOOKS: usize = 9;

/// Room for looks: with two ends each time that a stretch is parted.
pub(super) const MOST_METS: usize = MOST_LOOKS + 2 * (PARTS as usize + 1);

/// A look at a line at one time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) t: f64,
    pub(super) chord: Chord,
    /// Rates of both ends by the time; infinite where the line touches, 0 beyond the material.
    pub(super) rates: [f64; 2],
    /// Sines of the angles of the line to the faces at both ends.
    pub(super) slant: [f64; 2],
    /// Bends of the ways of both ends: see [`SpanPoses::bend_at`], or less, as a plane comes nearer no more than
    /// [`SpanPoses::nearer`] says.
    pub(super) bends: [f64; 2],
}

impl Met {
    /// The end that is to become least: the lower end, or the upper one reversed; and its rate.
    pub(super) fn cost(&self, upper: bool) -> (f64, f64) {
        if upper { (-self.chord.hi, -self.rates[1]) } else { (self.chord.lo, self.rates[0]) }
    }
}

/// Looks at which a line is met, each time once, in the order of their times, as many as there is room for.
#[derive(Clone, Copy)]
pub(super) struct Mets<const MOST: usize> {
    list: [Met; MOST],
    count: usize,
}

impl<const MOST: usize> Mets<MOST> {
    pub(super) fn new() -> Mets<MOST> {
        let none = Chord { lo: 0.0, hi: 0.0, lo_at: Touch::Disc, hi_at: Touch::Disc };
        let met = Met { t: 0.0, chord: none, rates: [0.0; 2], slant: [0.0; 2], bends: [0.0; 2] };
        Mets { list: [met; MOST], count: 0 }
    }

    pub(super) fn add(&mut self, met: Met) {
        let at = self.list[..self.count].partition_point(|m| m.t < met.t);
        let known = self.list[..self.count].get(at).is_some_and(|m| m.t == met.t);
        if !known && self.count < self.list.len() {
            self.list[at..=self.count].rotate_right(1);
            self.list[at] = met;
            self.count += 1;
        }
    }

    pub(super) fn list(&self) -> &[Met] {
        &self.list[..self.count]
    }
}

/// A line, a part and a span.
pub(super) struct Look<'a> {
    pub(super) of: &'a SpanPoses,
    pub(super) part: &'a ConvexPart,
    pub(super) line: &'a StockLine,
    /// The part of a way, seen from the tool, that no constant velocity explains [mm].
    pub(super) bend: f64,
}

impl Look<'_> {
    /// The look at a time; `None` where the line is not met.
    pub(super) fn at(&self, t: f64) -> Option<Met> {
        self.at_pose(t, &self.of.span.at(t))
    }

    /// The look at a time whose pose is known.
    pub(super) fn at_pose(&self, t: f64, pose: &Pose) -> Option<Met> {
        let from = LineFrom::new(self.line.start, self.line.along, pose);
        let chord = from.chord(self.part)?;
        let end = |s: f64, touch: Touch, beyond: bool| {
            // Beyond the material it is far enough, and nothing more is asked.
            if beyond {
                return (0.0, 1.0, self.bend);
            }
            let n = from.outward(self.part, s, touch);
            let slant = n[self.line.along];
            let place = from.point(s);
            let [_, nearer] = self.of.nearer(pose, n, place, self.part);
            let bend = self.of.bend_at(self.part, place.length()).min(0.25 * nearer);
            (n.dot(pose.velocity(place)) / slant, slant.abs(), bend)
        };
        let [low, high] = self.line.material;
        let lo = end(chord.lo, chord.lo_at, chord.lo <= low);
        let hi = end(chord.hi, chord.hi_at, chord.hi >= high);
        Some(Met { t, chord, rates: [lo.0, hi.0], slant: [lo.1, hi.1], bends: [lo.2, hi.2] })
    }
}
