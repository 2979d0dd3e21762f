//! A line against a convex part of a tool over a span: the stretch that the part covers at some time.
//!
//! At one time the part covers a chord. Over the times at which it meets the line the chords change steadily, so that together
//! they cover the line from the least lower to the greatest upper end. Both are found from three looks and the rate of an end,
//! `ds/dt = (n . v) / (n . d)`, by steps within a bracket. If the line is met at none of the three times, the gauge, convex
//! along the line and in time, tells the time at which they come nearest.
//!
//! Source: the gauge of a convex body that moves is jointly convex in place and time while the body does not turn; in a span it
//! turns by less than two degrees, and both its ends are looked at.

use glam::DVec3;

use super::super::body::{ConvexPart, Touch};
use super::chord::{Chord, Gauge, LineFrom};
use super::span::{Pose, PoseSpan};

/// Accuracy of an end on its line [mm]: a tenth of an end point's rounding.
const CLOSE: f64 = 1e-6;

/// Distance from a second face up to which an end lies at an edge [mm].
const EDGE: f64 = 1e-4;

/// Bend below which a motion is a straight way [mm].
const BENT: f64 = 1e-9;

/// Steps after which the best of an end is taken as it is.
const STEPS: usize = 48;

/// A line of the stock, and the material on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct StockLine {
    /// The point of the line at the coordinate 0.
    pub(super) start: DVec3,
    /// Index of the coordinate along the line.
    pub(super) along: usize,
    /// Least and greatest coordinate of its material [mm].
    pub(super) material: [f64; 2],
}

/// An end of a covered stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoverEnd {
    /// Coordinate [mm].
    pub(super) s: f64,
    /// Parameter of the span.
    pub(super) t: f64,
    /// Outward unit normal of the tool there.
    pub(super) normal: DVec3,
    pub(super) touch: Touch,
}

/// A span with its poses at the start, the middle and the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpanPoses {
    pub(super) span: PoseSpan,
    pub(super) poses: [Pose; 3],
}

/// Times of the poses.
const TIMES: [f64; 3] = [-0.5, 0.0, 0.5];

impl SpanPoses {
    pub(super) fn new(span: PoseSpan) -> SpanPoses {
        SpanPoses { span, poses: TIMES.map(|t| span.at(t)) }
    }

    /// Calls for each stretch of a line that a part covers, with its ends; `bend` as [`PoseSpan::bend`]. What lies beyond the
    /// material may be left out.
    pub(super) fn covers(
        &self,
        part: &ConvexPart,
        bend: f64,
        line: &StockLine,
        mut found: impl FnMut([CoverEnd; 2]),
    ) {
        if self.misses(part, bend, line) {
            return;
        }
        let look = Look { of: self, part, line, bend };
        let mut samples = [None; 3];
        for i in 0..3 {
            samples[i] = look.at_pose(TIMES[i], &self.poses[i]);
        }
        if samples.iter().all(Option::is_none) {
            let Some(met) = look.nearest() else { return };
            let (before, after) = if met.t < 0.0 { (-0.5, 0.0) } else { (0.0, 0.5) };
            let lo = look.furthest(met, [before, after], false);
            let hi = look.furthest(met, [before, after], true);
            return look.told(lo, hi, &mut found);
        }
        let lo = look.of_samples(&samples, false);
        let hi = look.of_samples(&samples, true);
        if let (Some(lo), Some(hi)) = (lo, hi) {
            look.told(lo, hi, &mut found);
        }
    }

    /// True if the part stays away from the material of the line: by the gauge at the middle, its rates along the
    /// line and in time, and the bend of the motion.
    fn misses(&self, part: &ConvexPart, bend: f64, line: &StockLine) -> bool {
        let pose = &self.poses[1];
        let from = LineFrom::new(line.start, line.along, pose);
        let least =
            |g: &Gauge, s: f64| g.value - 0.5 * g.normal.dot(pose.velocity(from.point(s))).abs() - bend;
        let [a, b] = line.material;
        let upper = from.gauge(part, b);
        let at_b = least(&upper, b);
        if at_b > 0.0 && upper.normal[line.along] <= 0.0 {
            return true;
        }
        let lower = from.gauge(part, a);
        let at_a = least(&lower, a);
        at_a > 0.0 && lower.normal[line.along] >= 0.0
    }
}

/// A look at a line at one time.
#[derive(Clone, Copy, Debug)]
struct Met {
    t: f64,
    chord: Chord,
    /// Rates of both ends by the time; infinite where the line touches.
    rates: [f64; 2],
    /// Sines of the angles of the line to the faces at both ends.
    slant: [f64; 2],
}

impl Met {
    /// The end that is to become least: the lower end, or the upper one reversed; and its rate.
    fn cost(&self, upper: bool) -> (f64, f64) {
        if upper { (-self.chord.hi, -self.rates[1]) } else { (self.chord.lo, self.rates[0]) }
    }
}

struct Look<'a> {
    of: &'a SpanPoses,
    part: &'a ConvexPart,
    line: &'a StockLine,
    /// See [`PoseSpan::bend`].
    bend: f64,
}

impl Look<'_> {
    fn at(&self, t: f64) -> Option<Met> {
        self.at_pose(t, &self.of.span.at(t))
    }

    fn at_pose(&self, t: f64, pose: &Pose) -> Option<Met> {
        let from = LineFrom::new(self.line.start, self.line.along, pose);
        let chord = from.chord(self.part)?;
        let end = |s: f64, touch: Touch| {
            let n = from.outward(self.part, s, touch);
            let slant = n[self.line.along];
            (n.dot(pose.velocity(from.point(s))) / slant, slant.abs())
        };
        let (lo, hi) = (end(chord.lo, chord.lo_at), end(chord.hi, chord.hi_at));
        Some(Met { t, chord, rates: [lo.0, hi.0], slant: [lo.1, hi.1] })
    }

    /// The furthest end of the chords of a span, from three looks.
    fn of_samples(&self, samples: &[Option<Met>; 3], upper: bool) -> Option<Met> {
        let best = samples.iter().flatten().min_by(|a, b| a.cost(upper).0.total_cmp(&b.cost(upper).0))?;
        Some(self.furthest(*best, [best.t - 0.5, best.t + 0.5].map(|t| t.clamp(-0.5, 0.5)), upper))
    }

    /// The furthest end of the chords between two times, from a look between them.
    fn furthest(&self, start: Met, [mut from, mut to]: [f64; 2], upper: bool) -> Met {
        let [low, high] = self.line.material;
        let enough = if upper { -high } else { low };
        let mut best = start;
        // Looks at either side of the least, where they met the line.
        let (mut left, mut right): (Option<Met>, Option<Met>) = (None, None);
        if start.cost(upper).1 > 0.0 {
            (right, to) = (Some(start), start.t);
        } else {
            (left, from) = (Some(start), start.t);
        }
        for step in 0..STEPS {
            if best.cost(upper).0 <= enough || to - from < 1e-9 {
                break;
            }
            let next = match (&left, &right) {
                (Some(a), Some(b)) => {
                    let ((ca, ga), (cb, gb)) = (a.cost(upper), b.cost(upper));
                    // No lower than where the tangents meet, if the chords change as they do on a straight way.
                    let meet = ((cb - ca) + ga * a.t - gb * b.t) / (ga - gb);
                    let least = ca + ga * (meet - a.t);
                    // What the bend of the motion may add goes with the square of the time between the looks,
                    // and is the longer along the line the less that slants through the face: a part that turns is
                    // looked at until its looks are close.
                    let end = usize::from(upper);
                    let slack = 4.0 * self.bend * (to - from) * (to - from) / a.slant[end].min(b.slant[end]);
                    let near = self.bend < BENT || to - from < 0.02;
                    if near && best.cost(upper).0 - least + slack < CLOSE {
                        break;
                    }
                    // A cubic where the chords change smoothly, the tangents at an edge; then from the far side next to the
                    // best, or the middle in case.
                    match step % 8 {
                        7 => 0.5 * (from + to),
                        3 if best.t - from > to - best.t => best.t - 0.1 * (best.t - from),
                        3 => best.t + 0.1 * (to - best.t),
                        k if k % 2 == 1 => meet,
                        _ => hermite([a.t, b.t], [ca, cb], [ga, gb]).unwrap_or(meet),
                    }
                }
                // The end of the time first, then the middle.
                (Some(_), None) if step == 0 => to,
                (None, Some(_)) if step == 0 => from,
                _ => 0.5 * (from + to),
            };
            let margin = if step == 0 { 0.0 } else { 1e-3 * (to - from) };
            let next = if next.is_finite() { next } else { 0.5 * (from + to) };
            let next = next.clamp(from + margin, to - margin);
            let met = self.at(next);
            if let Some(m) = &met
                && m.cost(upper).0 < best.cost(upper).0
            {
                best = *m;
            }
            match met {
                Some(m) if m.cost(upper).1 > 0.0 => {
                    (right, to) = (Some(m), next);
                    if next == from {
                        break;
                    }
                }
                Some(m) => {
                    (left, from) = (Some(m), next);
                    if next == to {
                        break;
                    }
                }
                None if right.is_some() => from = next,
                None => to = next,
            }
        }
        best
    }

    /// A look at a time at which the line is met, where it is at none of the three.
    fn nearest(&self) -> Option<Met> {
        let (mut from, mut to) = (-0.5, 0.5);
        let mut t = 0.0;
        for _ in 0..STEPS {
            let (least, rate) = self.gap(&self.of.span.at(t));
            if let Some(met) = self.at(t) {
                return Some(met);
            }
            let room = if rate > 0.0 { t - from } else { to - t };
            if least - rate.abs() * room - self.bend > 0.0 || room < 1e-9 {
                return None;
            }
            // To where the gap would close, but not to the end of the bracket, which was looked at.
            let close = least / rate.abs();
            let by = if close > 0.02 * room && close < 0.98 * room { close } else { 0.5 * room };
            if rate > 0.0 {
                to = t;
                t -= by;
            } else {
                from = t;
                t += by;
            }
        }
        None
    }

    /// The least gauge on the line at one time, and its rate in time: by tangents, which lie below a convex function.
    fn gap(&self, pose: &Pose) -> (f64, f64) {
        let from = LineFrom::new(self.line.start, self.line.along, pose);
        let [mut a, mut b] = self.line.material;
        let (mut ga, mut gb) = (from.gauge(self.part, a), from.gauge(self.part, b));
        let along = self.line.along;
        let told = |s: f64, g: &Gauge| (g.value, -g.normal.dot(pose.velocity(from.point(s))));
        if ga.normal[along] >= 0.0 {
            return told(a, &ga);
        }
        if gb.normal[along] <= 0.0 {
            return told(b, &gb);
        }
        let mut best = if ga.value < gb.value { (a, ga) } else { (b, gb) };
        for step in 0..STEPS {
            let (sa, sb) = (ga.normal[along], gb.normal[along]);
            let meet = ((gb.value - ga.value + sa * a - sb * b) / (sa - sb)).clamp(a, b);
            // The function lies above its tangents.
            let least = ga.value + sa * (meet - a);
            if best.1.value - least < 1e-9 {
                break;
            }
            let s = match step % 3 {
                0 => meet,
                1 => a + (b - a) * (sa / (sa - sb)),
                _ => 0.5 * (a + b),
            };
            let g = from.gauge(self.part, s);
            if g.value < best.1.value {
                best = (s, g);
            }
            if g.normal[along] < 0.0 {
                (a, ga) = (s, g);
            } else {
                (b, gb) = (s, g);
            }
        }
        told(best.0, &best.1)
    }

    /// Tells the stretch between two looks: one, or two where the line is not met between them.
    fn told(&self, lo: Met, hi: Met, found: &mut impl FnMut([CoverEnd; 2])) {
        let joined = lo.t == hi.t || self.at(0.5 * (lo.t + hi.t)).is_some();
        if joined {
            found([self.end(&lo, false), self.end(&hi, true)]);
        } else {
            for met in [lo, hi] {
                found([self.end(&met, false), self.end(&met, true)]);
            }
        }
    }

    fn end(&self, met: &Met, upper: bool) -> CoverEnd {
        let (s, touch) =
            if upper { (met.chord.hi, met.chord.hi_at) } else { (met.chord.lo, met.chord.lo_at) };
        let pose = self.of.span.at(met.t);
        let from = LineFrom::new(self.line.start, self.line.along, &pose);
        let mut normal = from.outward(self.part, s, touch);
        // At an edge of the part the surface left is that of the edge: square to its velocity.
        let velocity = pose.velocity(from.point(s));
        let other = from.gauge_but(self.part, s, Some(touch));
        let (v, w) = (normal.dot(velocity), other.normal.dot(velocity));
        if other.value > -EDGE && v * w < 0.0 {
            normal = (normal * w.abs() + other.normal * v.abs()).normalize_or(normal);
        }
        CoverEnd { s, t: met.t, normal, touch }
    }
}

/// The least place, between two places, of the cubic that has their values and slopes: it falls at the first and rises at the second.
fn hermite([a, b]: [f64; 2], [ca, cb]: [f64; 2], [ga, gb]: [f64; 2]) -> Option<f64> {
    let d = ga + gb - 3.0 * (ca - cb) / (a - b);
    let root = (d * d - ga * gb).sqrt();
    let t = b - (b - a) * (gb + root - d) / (gb - ga + 2.0 * root);
    t.is_finite().then_some(t)
}
