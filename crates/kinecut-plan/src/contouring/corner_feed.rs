//! The feed of a finishing cutter in inside corners, where it meets thicker chips than along a straight wall.
//!
//! A cutter that takes a strip of the width `h` off a straight wall has a largest chip of `fz sin A`, `cos A = 1 - h / a`. Before an
//! inside corner it meets the strip along the other wall from ahead, and its largest chip becomes as thick as its feed per tooth; in
//! an inside arc the strip reaches farther around it. The stock that roughing has left is known exactly
//! ([`Clearing`]), so that the largest chip is too, and the feed is reduced by the ratio of both, in steps: the text stays short.

use super::spec::ContourFinish;
use super::track::Track;
use crate::base::{Code, CountBound, Result};
use crate::clearing::Clearing;
use crate::geom::OutlineEdge;

/// Least share of the feed.
const LEAST: f64 = 0.3;
/// Share of the feed from one step to the next.
const STEP: f64 = 0.8;
/// Part by which a chip may be thicker than along the straight wall before the feed changes.
const THICKER: f64 = 0.01;
/// Distance of the places that are looked at, in radii of the cutter.
const EVERY: f64 = 0.05;
/// Rise of a chord over the arc that it replaces, in widths of the strip.
const CHORD: f64 = 0.005;

const CELLS: CountBound = CountBound {
    what: "cells of the stock in the corners of the finish",
    most: 2e7,
    bytes: 32,
    code: Code::PLAN_VALUE,
    help: "leave out `corner_feed`, or take a larger cutter",
};
const PLACES: CountBound =
    CountBound { what: "places of the feed in corners", most: 2e6, bytes: 16, ..CELLS };

/// Stretches of a finish with a feed below the one given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlowedFeed {
    /// Length of them [mm].
    pub length: f64,
    /// Smallest share of the feed on them; 1 without any.
    pub least: f64,
    /// Largest chip at the places that were looked at, over that along a straight wall.
    pub thickest: f64,
}

impl SlowedFeed {
    /// Of a path without any.
    pub(super) const NONE: SlowedFeed = SlowedFeed { length: 0.0, least: 1.0, thickest: 0.0 };

    /// Of a path whose chip is as thick as the feed per tooth everywhere.
    pub(super) const AHEAD: SlowedFeed = SlowedFeed { thickest: 1.0, ..SlowedFeed::NONE };

    /// Of this and another path.
    #[must_use]
    pub(super) fn and(self, other: SlowedFeed) -> SlowedFeed {
        let less = other.least < self.least;
        let thicker = other.thickest > self.thickest;
        SlowedFeed {
            length: self.length + other.length,
            least: if less { other.least } else { self.least },
            thickest: if thicker { other.thickest } else { self.thickest },
        }
    }
}

/// Shares of the feed along a track.
#[derive(Clone, Debug)]
pub(super) struct CornerFeed {
    /// Place along the track from which a share holds [mm], and the share; the first at 0.
    steps: Vec<(f64, f64)>,
    whole: f64,
    /// Place up to which there is stock [mm]: laps beyond it cut nothing.
    pub(super) until: f64,
}

impl CornerFeed {
    /// Along a track that finishes what a cutter of a radius `a` [mm] has left along others; `None` where a straight wall has the
    /// thickest chip already.
    ///
    /// # Errors
    /// `KC0404` where there is more to look at than fits into memory.
    pub(super) fn of<'t>(
        track: &Track,
        rough: impl Iterator<Item = &'t Track>,
        finish: &ContourFinish,
        a: f64,
    ) -> Result<Option<(CornerFeed, SlowedFeed)>> {
        let h = finish.allowance;
        if !(h > 0.0 && h < a) {
            return Ok(None);
        }
        // sin A of cos A = 1 - h / a.
        let straight = (h * (2.0 * a - h)).sqrt() / a;
        let area = track.bounds();
        CELLS.check(Clearing::cells(area, a))?;
        PLACES.check(track.length() / (EVERY * a))?;
        let mut stock = Clearing::new(area, a);
        for edge in rough.flat_map(Track::edges) {
            let count = chords(edge, CHORD * h);
            let at = |i: u32| edge.at(f64::from(i) / f64::from(count));
            (0..count).for_each(|i| stock.sweep(at(i), at(i + 1), a));
        }
        let mut found = SlowedFeed::NONE;
        let mut steps: Vec<(f64, f64)> = Vec::new();
        for (i, edge) in track.edges().iter().enumerate() {
            let [from, to] = track.stretch(i);
            let count = ((to - from) / (EVERY * a)).ceil().max(1.0) as u32;
            let chip = |k: u32| {
                let share = f64::from(k) / f64::from(count);
                let cut = stock.engagement(edge.at(share), edge.heading(share));
                if cut.total > 0.0 { cut.ahead.cos() } else { 0.0 }
            };
            let mut before = chip(0);
            for k in 0..count {
                let behind = chip(k + 1);
                let thickest = if before > behind { before } else { behind };
                let share = share_of(straight / thickest);
                let place = from + (to - from) * f64::from(k) / f64::from(count);
                if steps.last().is_none_or(|(_, last)| *last != share) {
                    steps.push((place, share));
                }
                if share < 1.0 {
                    found.length += (to - from) / f64::from(count);
                }
                found = found.and(SlowedFeed {
                    length: 0.0,
                    least: share,
                    thickest: share * thickest / straight,
                });
                before = behind;
            }
        }
        Ok(Some((CornerFeed { steps, whole: track.length(), until: f64::INFINITY }, found)))
    }

    /// The share of the feed on each part of a stretch along the track: where it ends, and the share.
    pub(super) fn along(&self, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
        /// Length that is rounding [mm].
        const NOTHING: f64 = 1e-9;
        let mut parts: Vec<(f64, f64)> = Vec::new();
        let mut add = |end: f64, share: f64| match parts.last_mut() {
            Some(last) if last.1 == share => last.0 = end,
            _ => parts.push((end, share)),
        };
        let turn = (from / self.whole).floor() * self.whole;
        let place = |i: usize| {
            let (lap, k) = (i / self.steps.len(), i % self.steps.len());
            turn + lap as f64 * self.whole + self.steps[k].0
        };
        let mut i = self.steps.partition_point(|(s, _)| turn + s <= from + NOTHING).saturating_sub(1);
        let mut begin = from;
        while begin < to {
            let end = if place(i + 1) < to - NOTHING { place(i + 1) } else { to };
            if end - begin > NOTHING || end == to {
                let stock = if end < self.until { end } else { self.until };
                if stock > begin + NOTHING {
                    add(stock, self.steps[i % self.steps.len()].1);
                }
                if end > stock + NOTHING {
                    add(end, 1.0);
                }
            }
            (begin, i) = (end, i + 1);
        }
        if let Some(last) = parts.last_mut() {
            last.0 = to;
        }
        parts
    }
}

/// The step at or below a share of the feed, within the part by which a chip may be thicker.
fn share_of(share: f64) -> f64 {
    let steps = std::iter::successors(Some(1.0), |s| Some(s * STEP)).take_while(|s| *s > LEAST);
    steps.chain([LEAST]).find(|s| *s <= share * (1.0 + THICKER)).unwrap_or(LEAST)
}

/// Number of chords of an edge that rise no more than a height over it [mm].
fn chords(edge: &OutlineEdge, rise: f64) -> u32 {
    let Some(t) = edge.turn else { return 1 };
    let half = (1.0 - rise / t.radius).clamp(-1.0, 1.0).acos();
    (0.5 * t.sweep.abs() / half).ceil().clamp(1.0, 1e5) as u32
}
