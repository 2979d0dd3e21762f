//! Share of its front that a cutter has in the material along a planar path: the engagement angle, measured against
//! everything the cutter has cut before, and the closed formula for parallel turns.
//!
//! Measured: at each position the front half of the cutter's circle is met by the discs of all former positions
//! and by a hole that was there before; what no disc covers is engaged. The former positions are samples of the
//! exact path, and each covers an exact arc of the circle; so the only error is their spacing `s`: scallops of
//! height `s^2 / (8 a)`. Where a former turn passes close by, it is sampled more densely: there the scallops would
//! be as high as the sliver that is left.
//!
//! For whom: the report. "Uniform allowance" of a spiral is uniform radial depth, not uniform load: in the
//! paper's example the angle falls from 92 to 41 degrees between turn 1 and 20.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;
use rayon::prelude::*;

use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, PlaneCurve, Spiral};

/// Longest turn of the path between two samples [rad]: about a cusp arc length says nothing.
const SAMPLE_TURN: f64 = 0.05;
/// Spacing of the samples in cutter radii: the scallops are a/12800, 0.01 degree at usual engagement.
const SAMPLE_SHARE: f64 = 1.0 / 40.0;
/// Most samples of a path: beyond it the path is metres long for a cutter of a tenth of a millimetre.
const MOST_SAMPLES: usize = 2_000_000;
/// A last step so much longer than the others is not split: two samples an ulp apart would be the same position.
const LAST_STEP: f64 = 1.001;
/// A former turn passes close by when it comes within so many spacings: one tenth of the cutter's diameter, where
/// less than about 12 degrees are engaged.
const CLOSE: f64 = 8.0;
/// Denser samples there; scallops become 256 times lower.
const DENSER: u32 = 16;
/// Distance of two positions below which they are the same [cutter radii].
const SAME: f64 = 1e-9;

/// The load at one place of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngagementSample {
    /// Arc length from the start of the path [mm].
    pub s: f64,
    /// Position of the cutter centre [mm].
    pub point: [f64; 2],
    /// Engaged angle of the cutter's front half [rad], 0 to pi.
    pub angle: f64,
    /// Signed curvature of the path [1/mm].
    pub curvature: f64,
}

/// Engagement angle [rad] of a cutter whose centre runs on a circle of `path_radius` inside a wall, when the wall
/// before lies parallel at `step`: exact for concentric rings, within 0.7 degree for a spiral from turn 2 on.
/// An infinite path radius is a straight wall. All in mm.
///
/// ```
/// # use kinecut_plan as kinecut;
/// let a = kinecut::holes::engagement::engagement_formula(79.0, 20.0, 3.95);
/// assert!((a - 0.711416948680282).abs() < 1e-12);
/// ```
pub fn engagement_formula(path_radius: f64, cutter_radius: f64, step: f64) -> f64 {
    let cos = if path_radius.is_infinite() {
        1.0 - step / cutter_radius
    } else {
        let wall = (path_radius + cutter_radius - step).clamp(0.0, f64::INFINITY);
        (wall * wall - path_radius * path_radius - cutter_radius * cutter_radius)
            / (2.0 * path_radius * cutter_radius)
    };
    cos.clamp(-1.0, 1.0).acos()
}

/// A sampled position of the path.
#[derive(Clone, Copy)]
struct Spot {
    s: f64,
    p: DVec2,
    heading: f64,
    curvature: f64,
}

/// The engagement at about `count` places along the path, evenly in arc length, the ends included.
///
/// `path` are consecutive curves; the cutter enters the material at the start of the first (a plunge) and all
/// former positions count as cut. `hole` is the radius of a round hole about the origin that was there before
/// [mm], if any.
///
/// # Errors
/// `KC0404` when the cutter radius is not positive, or the path is too long for it.
pub fn engagement<C: Copy + Into<PlaneCurve>>(
    path: &[C],
    cutter_radius: f64,
    hole: Option<f64>,
    count: usize,
) -> Result<Vec<EngagementSample>> {
    let path: Vec<PlaneCurve> = path.iter().map(|&c| c.into()).collect();
    let length: f64 = path.iter().map(PlaneCurve::length).sum();
    let (spots, former) = former(&path, cutter_radius)?;
    let spacing = SAMPLE_SHARE * cutter_radius;
    // Evenly in arc length, whatever the spacing of the samples.
    let step = length / count.clamp(2, MOST_SAMPLES).saturating_sub(1) as f64;
    let mut chosen: Vec<usize> = Vec::with_capacity(count.min(spots.len()));
    for (i, spot) in spots.iter().enumerate() {
        if spot.s >= step * chosen.len() as f64 - 0.5 * spacing || i + 1 == spots.len() {
            chosen.push(i);
        }
    }
    Ok(chosen
        .into_par_iter()
        .map(|i| {
            let spot = spots[i];
            EngagementSample {
                s: spot.s,
                point: spot.p.to_array(),
                angle: former.engaged(&spots, i, hole),
                curvature: spot.curvature,
            }
        })
        .collect())
}

/// The engagement [rad] at places of a path [mm], as [`engagement`] measures it: between two samples of the path, which are
/// a fortieth of the cutter's radius apart, in proportion.
///
/// # Errors
/// As [`engagement`].
pub fn engagement_at<C: Copy + Into<PlaneCurve>>(
    path: &[C],
    cutter_radius: f64,
    hole: Option<f64>,
    places: &[f64],
) -> Result<Vec<f64>> {
    let path: Vec<PlaneCurve> = path.iter().map(|&c| c.into()).collect();
    let (spots, former) = former(&path, cutter_radius)?;
    let beside = |s: f64| {
        let next = spots.partition_point(|spot| spot.s < s).min(spots.len() - 1);
        [next.saturating_sub(1), next]
    };
    let mut wanted: Vec<usize> = places.iter().flat_map(|s| beside(*s)).collect();
    wanted.sort_unstable();
    wanted.dedup();
    let angles: Vec<f64> = wanted.par_iter().map(|i| former.engaged(&spots, *i, hole)).collect();
    let angle = |i: usize| wanted.binary_search(&i).map_or(0.0, |k| angles[k]);
    Ok(places
        .iter()
        .map(|s| {
            let [i, j] = beside(*s);
            let way = spots[j].s - spots[i].s;
            let share = if way > 0.0 { ((s - spots[i].s) / way).clamp(0.0, 1.0) } else { 1.0 };
            angle(i) + (angle(j) - angle(i)) * share
        })
        .collect())
}

/// The samples of a path, and all of them as places at which the cutter was.
fn former(path: &[PlaneCurve], cutter_radius: f64) -> Result<(Vec<Spot>, Former)> {
    let length: f64 = path.iter().map(PlaneCurve::length).sum();
    let spacing = SAMPLE_SHARE * cutter_radius;
    let turned: f64 = path.iter().map(PlaneCurve::turn).sum();
    let samples = length / spacing + turned / SAMPLE_TURN;
    if !(cutter_radius > 0.0 && cutter_radius.is_finite()) {
        let what = "the engagement needs a positive cutter radius";
        return Err(Finding::error(Code::PLAN_VALUE, what).value_mm(cutter_radius).into());
    }
    if !(samples < MOST_SAMPLES as f64) {
        let what =
            "the path is too long, or turns too often, for its engagement to be measured with this cutter";
        return Err(Finding::error(Code::PLAN_VALUE, what)
            .value(samples, "places")
            .bound(MOST_SAMPLES as f64, "places")
            .into());
    }
    let spots = sample(path, spacing);
    let former = Former::new(&spots, cutter_radius);
    Ok((spots, former))
}

fn sample(path: &[PlaneCurve], spacing: f64) -> Vec<Spot> {
    let mut spots = Vec::new();
    let mut before = 0.0;
    for (index, curve) in path.iter().enumerate() {
        match curve {
            PlaneCurve::Record(record) => sample_record(&mut spots, record, before, spacing),
            PlaneCurve::Spiral(spiral) => sample_spiral(&mut spots, spiral, before, spacing),
        }
        before += curve.length();
        // The end of a curve is the start of the next.
        if index + 1 < path.len() {
            spots.pop();
        }
    }
    spots
}

fn sample_record(spots: &mut Vec<Spot>, record: &InvoluteRecord, before: f64, spacing: f64) {
    let mut s = 0.0;
    loop {
        let jet = record.at(s);
        spots.push(Spot { s: before + s, p: jet.p, heading: jet.angle, curvature: jet.curvature });
        if s >= record.length() {
            break;
        }
        let turned = record.length_at_turn(record.turn(s).abs() + SAMPLE_TURN);
        let next = (s + spacing).min(if record.is_line() { f64::INFINITY } else { turned });
        s = if next >= record.length() { record.length() } else { next };
    }
}

fn sample_spiral(spots: &mut Vec<Spot>, spiral: &Spiral, before: f64, spacing: f64) {
    let [from, to] = spiral.parameters();
    let way = if to < from { -1.0 } else { 1.0 };
    let (mut u, mut s) = (from, 0.0);
    loop {
        let jet = spiral.at_parameter(u);
        spots.push(Spot { s: before + s, p: jet.p, heading: jet.angle, curvature: jet.curvature });
        if u == to {
            break;
        }
        let speed = spiral.law().speed(u);
        let along = spacing.min(SAMPLE_TURN / jet.curvature.abs());
        // Past a cusp the parameter itself steps on.
        // In a cusp both are zero, and the quotient is no number.
        let least = SAMPLE_TURN * 1e-3;
        let step = if along / speed > least { (along / speed).clamp(least, SAMPLE_TURN) } else { least };
        let next = if (to - u) * way <= step * LAST_STEP { to } else { u + way * step };
        s += spiral.law().length(u, next).abs();
        u = next;
    }
}

/// All positions in square cells of at least one cutter diameter.
struct Former {
    radius: f64,
    low: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<u32>>,
}

/// Most cells in a row or column: a path far from compact gets larger ones.
const MOST_CELLS: f64 = 1000.0;

impl Former {
    fn new(spots: &[Spot], radius: f64) -> Former {
        let (low, high) =
            spots.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), s| (l.min(s.p), h.max(s.p)));
        let size = high - low;
        let cell = (2.0 * radius).max(size.max_element() / MOST_CELLS);
        let (columns, rows) = ((size.x / cell) as usize + 1, (size.y / cell) as usize + 1);
        let mut former = Former { radius, low, cell, columns, rows, cells: vec![Vec::new(); columns * rows] };
        for (i, spot) in spots.iter().enumerate() {
            let (c, r) = former.cell(spot.p);
            // The count is near MOST_SAMPLES at most, by the check on length and turns.
            former.cells[r * columns + c].push(i as u32);
        }
        former
    }

    fn cell(&self, p: DVec2) -> (usize, usize) {
        let q = (p - self.low) / self.cell;
        ((q.x as usize).min(self.columns - 1), (q.y as usize).min(self.rows - 1))
    }

    fn engaged(&self, spots: &[Spot], i: usize, hole: Option<f64>) -> f64 {
        let (spot, a) = (spots[i], self.radius);
        let mut front = Front { radius: a, ahead: DVec2::from_angle(spot.heading), covered: Vec::new() };
        let close = CLOSE * SAMPLE_SHARE * a;
        let (c, r) = self.cell(spot.p);
        for row in r.saturating_sub(1)..=(r + 1).min(self.rows - 1) {
            for column in c.saturating_sub(1)..=(c + 1).min(self.columns - 1) {
                for &j in &self.cells[row * self.columns + column] {
                    let j = j as usize;
                    if j >= i {
                        break;
                    }
                    let to = spots[j].p - spot.p;
                    let squared = to.length_squared();
                    if squared >= 4.0 * a * a {
                        continue;
                    }
                    if squared <= (SAME * a).powi(2) {
                        return 0.0;
                    }
                    // Not the path just behind, which covers the rear only.
                    if squared < close * close && spot.s - spots[j + 1].s > 2.0 * close {
                        for k in 1..DENSER {
                            let u = f64::from(k) / f64::from(DENSER);
                            front.cover(between(&spots[j], &spots[j + 1], u) - spot.p);
                        }
                    }
                    front.cover(to);
                }
            }
        }
        if let Some(hole) = hole {
            let distance = spot.p.length();
            if distance + a <= hole {
                return 0.0;
            }
            if distance < hole + a && distance > 0.0 {
                let cos = (distance * distance + a * a - hole * hole) / (2.0 * distance * a);
                front.cover_arc(-spot.p, cos.clamp(-1.0, 1.0).acos());
            }
        }
        front.free()
    }
}

/// The front half of the cutter's circle and the arcs of it that are in the air, as angles from the heading [rad].
struct Front {
    radius: f64,
    ahead: DVec2,
    covered: Vec<(f64, f64)>,
}

impl Front {
    /// By an equal disc whose centre lies at `to`, nearer than two radii.
    fn cover(&mut self, to: DVec2) {
        let (x, y) = (to.dot(self.ahead), self.ahead.perp_dot(to));
        let squared = to.length_squared();
        let share = squared / (4.0 * self.radius * self.radius);
        // Half the covered angle is acos(sqrt(share)) < pi/2: a disc behind covers the rear only.
        if share >= 1.0 || x < 0.0 && x * x >= squared * (1.0 - share) {
            return;
        }
        let (middle, half) = (y.atan2(x), share.sqrt().acos());
        self.push(middle - half, middle + half);
    }

    /// By any arc about a direction; one that passes the rear comes in again on the other side.
    fn cover_arc(&mut self, to: DVec2, half: f64) {
        let middle = self.ahead.perp_dot(to).atan2(to.dot(self.ahead));
        for shift in [0.0, -2.0 * PI, 2.0 * PI] {
            self.push(middle - half + shift, middle + half + shift);
        }
    }

    fn push(&mut self, lo: f64, hi: f64) {
        if !(hi > -FRAC_PI_2 && lo < FRAC_PI_2) {
            return;
        }
        // Neighbours of a path cover nearly the same: one arc for the run keeps the sorting short.
        match self.covered.last_mut() {
            Some(last) if lo <= last.1 && hi >= last.0 => *last = (last.0.min(lo), last.1.max(hi)),
            _ => self.covered.push((lo, hi)),
        }
    }

    fn free(mut self) -> f64 {
        self.covered.sort_by(|x, y| x.0.total_cmp(&y.0));
        let (mut reach, mut free) = (-FRAC_PI_2, 0.0);
        for (lo, hi) in self.covered {
            if lo > reach {
                free += lo - reach;
            }
            reach = if hi > reach { hi } else { reach };
        }
        if reach < FRAC_PI_2 { free + (FRAC_PI_2 - reach) } else { free }
    }
}

/// The path between two samples at the fraction `u`: the cubic that has their positions and tangents.
fn between(a: &Spot, b: &Spot, u: f64) -> DVec2 {
    let reach = b.s - a.s;
    let (ta, tb) = (DVec2::from_angle(a.heading) * reach, DVec2::from_angle(b.heading) * reach);
    let w = 1.0 - u;
    a.p * (w * w * (1.0 + 2.0 * u)) + ta * (u * w * w) + b.p * (u * u * (3.0 - 2.0 * u)) - tb * (u * u * w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::holes::spiral;
    use std::f64::consts::TAU;

    /// At the end of the path, in degrees.
    fn at_end(path: &[InvoluteRecord]) -> f64 {
        engagement(path, 20.0, None, 2).unwrap().last().unwrap().angle.to_degrees()
    }

    fn at_turns(turns: &[f64]) -> Vec<f64> {
        let path = spiral::from_centre(79.0, 20, 0.0).unwrap();
        turns.iter().map(|t| at_end(&[path.split(path.length_at_turn(TAU * t)).0])).collect()
    }

    #[test]
    fn the_papers_spiral_loads_the_cutter_as_the_reference_says() {
        // Brute force of 4000 points of the front against 4000 former positions, elsewhere. (A coarser one gives
        // 150.9, 125.1 and 91.7 for the first three.)
        let turns = [0.25, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0];
        let expected = [151.34, 125.82, 91.89, 68.7, 59.6, 51.5, 44.6, 40.8];
        for ((found, expected), turn) in at_turns(&turns).iter().zip(expected).zip(turns) {
            assert!((found - expected).abs() < 0.1, "turn {turn}: {found}, expected {expected}");
        }
    }

    #[test]
    fn the_closed_formula_holds_from_the_second_turn() {
        let turns = [2.0, 3.0, 5.0, 10.0, 20.0];
        for (found, turn) in at_turns(&turns).iter().zip(turns) {
            let formula = engagement_formula(3.95 * turn, 20.0, 3.95).to_degrees();
            let allowed = if turn < 10.0 { 0.75 } else { 0.1 };
            assert!((found - formula).abs() < allowed, "turn {turn}: {found} {formula}");
        }
        assert!((engagement_formula(f64::INFINITY, 20.0, 3.95) - 0.639322791093279).abs() < 1e-12);
        assert_eq!(engagement_formula(1.0, 20.0, 50.0), PI);
    }

    #[test]
    fn the_closing_circle_tapers_to_nothing() {
        let (spiral, circle) =
            (spiral::from_centre(79.0, 20, 0.0).unwrap(), InvoluteRecord::circle(79.0, 0.0).unwrap());
        // The last one from the depth r (e - sin e) = 0.00323 mm at e = 0.05 turns: cutter 20 and wall 99 part by
        // A^2/2 * 20 * 79 / 99.
        for (share, expected) in [(0.0, 40.8), (0.25, 38.4), (0.5, 27.8), (0.75, 11.8), (0.95, 1.13)] {
            let found = at_end(&[spiral, circle.split(share * circle.length()).0]);
            assert!((found - expected).abs() < 0.1, "{share}: {found}, expected {expected}");
        }
        assert_eq!(at_end(&[spiral, circle]), 0.0);
    }

    #[test]
    fn a_slot_is_full_and_a_hole_is_air() {
        let line = InvoluteRecord::new(100.0, [0.0, 0.0], 0.3, f64::INFINITY, f64::INFINITY).unwrap();
        let samples = engagement(&[line], 5.0, None, 20).unwrap();
        assert!(samples.iter().all(|s| (s.angle - PI).abs() < 1e-12), "{samples:?}");
        let samples = engagement(&[line], 5.0, Some(20.0), 2000).unwrap();
        for s in samples {
            // By the cosine rule: the front of a circle of radius 5 that leaves a hole of radius 20.
            let beta = if s.s < 15.0 {
                PI
            } else if s.s > 25.0 {
                0.0
            } else {
                ((s.s * s.s + 25.0 - 400.0) / (10.0 * s.s)).acos()
            };
            let expected = PI - 2.0 * (beta - FRAC_PI_2).max(0.0);
            assert!((s.angle - expected).abs() < 1e-9, "{s:?} {expected}");
        }
        assert_eq!(engagement(&[line], 0.0, None, 5).unwrap_err().code(), Code::PLAN_VALUE);
    }
}
