//! The objective, fast: [`bad_length`](crate::facing::bad_length) with everything that does not depend on the placement
//! worked out once.

use std::f64::consts::{PI, TAU};

use super::arc_box::Arc;
use super::domain::{Domain, Turned};
use super::lines::{BadInterval, Line, Lines};
use crate::facing::FaceCase;
use crate::num::angle::{wrap, wrap_positive};

/// A case with its domain, ready to be evaluated.
pub(super) struct Objective<'a> {
    pub(super) case: &'a FaceCase,
    pub(super) domain: &'a Domain,
    pub(super) lines: Lines,
    pub(super) arcs: Vec<Arc>,
    /// Angles in [0, 2 pi) at which an edge that counts is parallel to the feed, ascending: the value jumps there, to
    /// what may be the least of all.
    pub(super) parallel: Vec<f64>,
}

/// A value with its angle and local offset.
pub(super) type Valued = (f64, [f64; 2]);

/// Rise per length below which an edge is parallel to the feed, and rounding of heights per size: as in the closed form.
const ZERO: f64 = 1e-12;

impl<'a> Objective<'a> {
    pub(super) fn new(case: &'a FaceCase, domain: &'a Domain) -> Objective<'a> {
        let lines = Lines::new(case, domain);
        let edges = case.outline.edges().iter().zip(&case.weights).filter(|(_, w)| **w > 0.0);
        let arcs =
            edges.filter_map(|(e, w)| Arc::new(e, domain.middle, *w, case.radius, &lines.parts)).collect();
        let headings = lines.lines.iter().flat_map(|l| [-l.heading, PI - l.heading]);
        let mut parallel: Vec<f64> = headings.map(wrap_positive).collect();
        parallel.sort_by(f64::total_cmp);
        parallel.dedup();
        Objective { case, domain, lines, arcs, parallel }
    }

    /// True if an edge that counts is circular.
    pub(super) fn circular(&self) -> bool {
        !self.arcs.is_empty()
    }

    /// The weighted bad length [mm].
    pub(super) fn at(&self, [angle, local]: [f64; 2]) -> f64 {
        let (sin, cos) = angle.sin_cos();
        let mut sum = 0.0;
        for line in &self.lines.lines {
            for part in &self.lines.parts {
                sum += line.weight
                    * part.weight
                    * share(line, part, self.lines.radius, [angle, sin, cos], local);
            }
        }
        if !self.arcs.is_empty() {
            let turned = Turned::new([angle, angle]);
            for arc in &self.arcs {
                for (k, part) in self.lines.parts.iter().enumerate() {
                    sum += arc.weight * part.weight * arc.length_at(k, &turned, local);
                }
            }
        }
        sum
    }

    /// The value at the allowed local offset nearest to the given one, if the angle is allowed and has any.
    pub(super) fn near(&self, [angle, local]: [f64; 2]) -> Option<Valued> {
        let spans = self.domain.offsets(angle).into_iter().filter(|s| s[0] <= s[1]);
        let inside = spans.map(|s| local.clamp(s[0], s[1]));
        let local = inside.min_by(|a, b| (a - local).abs().total_cmp(&(b - local).abs()))?;
        self.domain.allows(angle).then(|| (self.at([angle, local]), [angle, local]))
    }

    /// Angle at which to try a node [rad]: its middle, or one at which an edge is parallel to the feed.
    pub(super) fn probe_angle(&self, angle: [f64; 2]) -> f64 {
        let middle = 0.5 * (angle[0] + angle[1]);
        if angle[1] - angle[0] > WIDE {
            return middle;
        }
        let next = self.parallel.partition_point(|p| *p < middle);
        let near = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let inside =
            near.filter_map(|i| self.parallel.get(i).copied()).filter(|p| angle[0] <= *p && *p <= angle[1]);
        inside.min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs())).unwrap_or(middle)
    }
}

/// Nodes wider than this [rad] are tried in their middle only.
const WIDE: f64 = 0.02;

/// Share of a straight edge that is bad.
#[inline]
fn share(line: &Line, part: &BadInterval, radius: f64, [angle, sin, cos]: [f64; 3], local: f64) -> f64 {
    let height = |p: glam::DVec2| sin * p.x + cos * p.y - local;
    let (a, b) = (height(line.start), height(line.end));
    let base = wrap(line.heading + angle);
    let mut sum = 0.0;
    for turn in [-TAU, 0.0] {
        let (lo, hi) = (base + part.from + turn, base + part.to + turn);
        let (lo, hi) = (if lo > -PI { lo } else { -PI }, if hi < 0.0 { hi } else { 0.0 });
        if !(hi > lo + 1e-3 * ZERO) {
            continue;
        }
        let (low, high) = (radius * lo.cos(), radius * hi.cos());
        let rise = b - a;
        if rise.abs() <= ZERO * line.length {
            let y = 0.5 * (a + b);
            let near = ZERO * if radius > line.length { radius } else { line.length };
            sum += if low + near < y && y < high - near { 1.0 } else { 0.0 };
            continue;
        }
        let (s, t) = ((low - a) / rise, (high - a) / rise);
        let (s, t) = if s < t { (s, t) } else { (t, s) };
        let (from, to) = (if s > 0.0 { s } else { 0.0 }, if t < 1.0 { t } else { 1.0 });
        sum += if to > from { to - from } else { 0.0 };
    }
    sum
}
