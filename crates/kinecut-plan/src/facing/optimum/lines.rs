//! Lower bounds for outlines of straight edges: over an interval of angles, exact in the offset.
//!
//! While the angle runs over [g1, g2] an edge's heading runs over [b1, b2]; velocities in (b2 + from, b1 + to) leave it
//! badly at every one of these angles. A point of the edge at the share s is surely bad where its height exceeds
//! c + E1 and stays below c + E2 at every angle, E = R cos of the ends of that interval cut with the front half.
//! The least height over the angles is a concave function of s (a minimum of linear ones), hence above the chord of
//! the end points' least heights; the greatest height is below the chord of their greatest ones. The length between
//! the chords' cuts is piecewise linear in c with four breaks; an edge that may be parallel to the feed counts wholly
//! or not at all. [`Sweep`] minimises the sum.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::domain::{Domain, Turned};
use super::sweep::{Ramps, Sweep};
use crate::facing::FaceCase;
use crate::num::angle::wrap;

/// A straight edge in the frame of the part's middle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) start: DVec2,
    pub(super) end: DVec2,
    pub(super) start_size: f64,
    pub(super) end_size: f64,
    pub(super) heading: f64,
    pub(super) length: f64,
    /// Length times the edge's weight.
    pub(super) weight: f64,
}

/// A bad interval of exit angles with its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct BadInterval {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) weight: f64,
}

/// The straight edges of a case.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    pub(super) lines: Vec<Line>,
    pub(super) parts: Vec<BadInterval>,
    pub(super) radius: f64,
    /// Rounding of heights: zones shrink by it, so that an edge on a border counts as not bad, as in the objective.
    pub(super) near: f64,
}

/// Rounding of heights per size. Half of the rounding that the objective allows an edge that is parallel to the feed: a
/// minimum at its border is then on the border for the objective too.
pub(super) const ROUNDING: f64 = 0.5e-12;

/// Angle of a chord that replaces a piece of an arc where the search begins [rad].
const CHORD: f64 = 0.3;

/// Levels over the centre line between which a point of an edge, whose heading runs over [base, base + width], is
/// surely bad [mm].
#[inline]
pub(super) fn sure_levels(
    base: f64,
    width: f64,
    part: &BadInterval,
    radius: f64,
    mut found: impl FnMut(f64, f64),
) {
    // `base` lies within (-pi, pi] and `from` above -pi/2: a turn more never reaches the front half.
    for turn in [-TAU, 0.0] {
        let (lo, hi) = (base + width + part.from + turn, base + part.to + turn);
        let (lo, hi) = (if lo > -PI { lo } else { -PI }, if hi < 0.0 { hi } else { 0.0 });
        if hi > lo {
            let low = if lo == -PI { -1.0 } else { lo.cos() };
            let high = if hi == 0.0 { 1.0 } else { hi.cos() };
            found(radius * low, radius * high);
        }
    }
}

/// An edge over an interval of angles: where its heights lie.
#[derive(Clone, Copy, Debug)]
pub(super) struct Risen {
    /// Heights of the end that is lower, at least and at most.
    low: [f64; 2],
    /// Heights of the end that is higher.
    high: [f64; 2],
    /// The edge rises (or falls) at all angles.
    slanted: bool,
}

impl Risen {
    #[inline]
    pub(super) fn new(line: &Line, turned: &Turned, near: f64) -> Risen {
        let a = turned.heights(line.start, line.start_size);
        let b = turned.heights(line.end, line.end_size);
        let (low, high) = if a[0] + a[1] < b[0] + b[1] { (a, b) } else { (b, a) };
        let slanted = high[0] - low[0] > near && high[1] - low[1] > near;
        if slanted {
            return Risen { low, high, slanted };
        }
        let floor = if a[0] < b[0] { a[0] } else { b[0] };
        let top = if a[1] > b[1] { a[1] } else { b[1] };
        Risen { low: [floor, floor], high: [top, top], slanted }
    }

    /// Breaks of the surely bad length for the levels.
    #[inline]
    pub(super) fn ramps(&self, low: f64, high: f64) -> Option<Ramps> {
        self.slanted.then_some(Ramps {
            rise: [self.low[1] - high, self.high[1] - high],
            fall: [self.low[0] - low, self.high[0] - low],
        })
    }

    /// Offsets at which the whole edge is surely bad.
    #[inline]
    pub(super) fn window(&self, low: f64, high: f64) -> [f64; 2] {
        [self.high[1] - high, self.low[0] - low]
    }
}

impl Line {
    /// Unit vector from start to end.
    #[inline]
    pub(super) fn direction(&self) -> DVec2 {
        (self.end - self.start) / self.length
    }
}

impl Lines {
    /// The straight edges that count.
    pub(super) fn new(case: &FaceCase, domain: &Domain) -> Lines {
        Lines::from_edges(case, domain, false)
    }

    /// The same, with circular edges replaced by chords.
    pub(super) fn with_chords(case: &FaceCase, domain: &Domain) -> Lines {
        Lines::from_edges(case, domain, true)
    }

    fn from_edges(case: &FaceCase, domain: &Domain, chords: bool) -> Lines {
        let mut lines = Vec::new();
        for (edge, weight) in case.outline.edges().iter().zip(&case.weights).filter(|(_, w)| **w > 0.0) {
            let pieces = match edge.turn {
                None => 1,
                Some(turn) if chords => (turn.sweep.abs() / CHORD).ceil() as usize,
                Some(_) => continue,
            };
            for k in 0..pieces {
                let [start, end] = [k, k + 1].map(|k| edge.at(k as f64 / pieces as f64) - domain.middle);
                let chord = end - start;
                let length = chord.length();
                if length > 0.0 {
                    lines.push(Line {
                        start,
                        end,
                        start_size: start.length(),
                        end_size: end.length(),
                        heading: chord.y.atan2(chord.x),
                        length,
                        weight: length * weight,
                    });
                }
            }
        }
        let size = lines.iter().fold(case.radius, |s, l: &Line| if l.length > s { l.length } else { s });
        let parts = case
            .bad
            .layers()
            .iter()
            .map(|p| BadInterval { from: p.from, to: p.to, weight: p.weight })
            .collect();
        Lines { lines, parts, radius: case.radius, near: ROUNDING * size }
    }

    /// The least, over the offsets of the interval, of the surely bad length, and where it is taken.
    pub(super) fn least(&self, turned: &Turned, offset: [f64; 2], sweep: &mut Sweep) -> (f64, f64) {
        sweep.begin(offset[0], offset[1]);
        let width = turned.angle[1] - turned.angle[0];
        for line in &self.lines {
            let risen = Risen::new(line, turned, self.near);
            let base = wrap(line.heading + turned.angle[0]);
            for part in &self.parts {
                sure_levels(base, width, part, self.radius, |low, high| {
                    let (low, high) = (low + self.near, high - self.near);
                    let weight = line.weight * part.weight;
                    match risen.ramps(low, high) {
                        Some(ramps) => sweep.add_ramps(weight, &ramps),
                        None => sweep.add_window(weight, risen.window(low, high)),
                    }
                });
            }
        }
        sweep.least()
    }
}
