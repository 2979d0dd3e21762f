//! A line against a convex part of a tool over a span: the stretch that the part covers at some time.
//!
//! At one time the part covers a chord (`look.rs`). Over the times at which it meets the line the chords change steadily, so that
//! together they cover the line from the least lower to the greatest upper end (`furthest.rs`). If the line is met at none of three
//! times, the time of touch is sought (`nearest.rs`). Where the chords part, each part of the time has a stretch of its own.

use glam::DVec3;

use super::super::body::{ConvexPart, RevolvedParts, Touch};
use super::chord::LineFrom;
use super::look::{Look, MOST_LOOKS, MOST_METS, Met, Mets};
use super::span::{Pose, PoseSpan};

/// More than the rounding of an end point [mm].
const ROUNDING: f64 = 2e-5;

/// Distance from a second face up to which an end lies at an edge [mm].
const EDGE: f64 = 1e-4;

/// Most times at which the looks of a span are parted in two.
pub(super) const PARTS: u32 = 6;

/// Halvings in which a time at which the line is not met is sought between two looks.
const HALVINGS: u32 = 20;

/// Multiple of the turn of a span below which the angle of a line to a flat end, or to the side, counts as small.
const QUICK: f64 = 4.0;

/// A line of the stock, and the material on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct StockLine {
    /// The point of the line at the coordinate 0.
    pub(super) start: DVec3,
    /// Index of the coordinate along the line.
    pub(super) along: usize,
    /// Least and greatest coordinate of its material [mm].
    pub(super) material: [f64; 2],
    /// The stretches of its material [mm]; those for which there is no room are one with the last.
    pub(super) stretches: [[f64; 2]; MOST_STRETCHES],
}

/// Stretches of material that are kept of a line.
pub(super) const MOST_STRETCHES: usize = 4;

/// No stretch.
pub(super) const NO_STRETCH: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl StockLine {
    /// True if no material lies between two coordinates, and a little on either side for their rounding.
    fn is_free(&self, lo: f64, hi: f64) -> bool {
        self.stretches.iter().all(|[from, to]| *to < lo - ROUNDING || *from > hi + ROUNDING)
    }
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
    /// Bend of the way of the tip, seen from the tool [mm], and what each millimetre from the tip adds.
    bends: [f64; 2],
    /// See [`PoseSpan::unsteady`].
    pub(super) unsteady: [f64; 2],
    /// Most that the tip moves, and the tool turns, by the parameter [mm, rad].
    pub(super) rates: [f64; 2],
}

/// Times of the poses.
const TIMES: [f64; 3] = [-0.5, 0.0, 0.5];

impl SpanPoses {
    pub(super) fn new(span: PoseSpan) -> SpanPoses {
        let bends = [span.bend(0.0), span.bend(1.0) - span.bend(0.0)];
        let poses = TIMES.map(|t| span.at(t));
        let most = |rate: fn(&Pose) -> DVec3| poses.iter().map(|p| rate(p).length()).fold(0.0, f64::max);
        let rates = [most(|p| p.tip_rate), most(|p| p.axis_rate)];
        let mut poses = SpanPoses { span, poses, bends, unsteady: span.unsteady(), rates };
        poses.bends[0] = poses.bend_seen(bends[0]);
        poses
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
        let bend = self.bend_seen(bend);
        let look = Look { of: self, part, line: &self.near(part, bend, line, 0.0), bend };
        if look.misses() {
            return;
        }
        if self.is_quick(part, line) {
            look.by_looks::<MOST_LOOKS>(&mut found);
        } else {
            look.by_looks::<{ TIMES.len() }>(&mut found);
        }
    }

    /// True if the ends of a line may run to and fro within the span: where the turn of the tool is no small part of the angle of the
    /// line to a flat end or to the side.
    fn is_quick(&self, part: &ConvexPart, line: &StockLine) -> bool {
        let pose = &self.poses[1];
        let turn = QUICK * pose.axis_rate.length();
        let rise = pose.axis[line.along].abs();
        let flat = part.r0 > 0.0 || part.top.is_finite();
        turn > 0.0 && (flat && rise < turn || (1.0 - rise * rise).max(0.0).sqrt() < turn)
    }

    /// True if all parts of a body stay away from the material of a line, and from all that is no farther than `by` from it [mm].
    pub(super) fn keep_off(&self, body: &RevolvedParts, bend: f64, line: &StockLine, by: f64) -> bool {
        let bend = self.bend_seen(bend);
        body.parts.iter().all(|part| {
            let line = &self.near(part, bend, line, by);
            Look { of: self, part, line, bend }.keeps_off(by)
        })
    }

    /// The bend of the way seen from the tool: if that turns, a straight way is bent too [mm].
    pub(super) fn bend_seen(&self, bend: f64) -> f64 {
        let pose = &self.poses[1];
        bend + 0.25 * pose.axis_rate.length() * pose.tip_rate.length()
    }

    /// The bend of the way of what is so far from the tip at some time, seen from the tool [mm]: in a span it goes no farther off than
    /// the part is wide.
    pub(super) fn bend_at(&self, part: &ConvexPart, far: f64) -> f64 {
        self.bends[0] + self.bends[1] * (far + 2.0 * part.r1)
    }

    /// The second derivative of the height of a place above a plane that is carried along, while the tool turns steadily [mm by the
    /// span's parameter squared].
    pub(super) fn curved(pose: &Pose, normal: DVec3, from_tip: DVec3) -> f64 {
        let turn = pose.axis.cross(pose.axis_rate);
        let turned = turn.cross(normal);
        turn.cross(turned).dot(from_tip) - 2.0 * turned.dot(pose.tip_rate)
    }

    /// Most by which a plane that is carried along comes nearer to a place than its rate says: half of the time before and after, and
    /// all of it before or after [mm]. The tool turns steadily but for `unsteady`, so that the way of the place has a second
    /// derivative that is known, and a third one that is small.
    pub(super) fn nearer(&self, pose: &Pose, normal: DVec3, from_tip: DVec3, part: &ConvexPart) -> [f64; 2] {
        let second = SpanPoses::curved(pose, normal, from_tip);
        let far = from_tip.length() + 2.0 * part.r1;
        let [tip, by_reach] = self.unsteady;
        let [way, turns] = self.rates;
        let bend = tip + by_reach * far;
        let third = turns * turns * (3.0 * way + turns * far) + 24.0 * by_reach * (way + turns * far);
        let closes = if second < 0.0 { -second } else { 0.0 };
        [0.125 * closes + 2.0 * bend + third / 48.0, 0.5 * closes + 8.0 * bend + third / 6.0]
    }

    /// What [`SpanPoses::nearer`] says grows by so much for each millimetre to another place.
    pub(super) fn nearer_by_way(&self) -> f64 {
        let ([_, by_reach], [_, turns]) = (self.unsteady, self.rates);
        0.5 * turns * turns + 8.0 * by_reach + turns * (turns * turns + 24.0 * by_reach) / 6.0
    }

    /// The line with its material that is no farther from the tip than the part and `by` reach.
    fn near(&self, part: &ConvexPart, bend: f64, line: &StockLine, by: f64) -> StockLine {
        let pose = &self.poses[1];
        let high = if part.top > -part.z0 { part.top } else { -part.z0 };
        let reach = high.hypot(part.r1);
        let stray = 0.5 * (pose.tip_rate.length() + reach * pose.axis_rate.length()) + 2.0 * bend + by;
        let tip = pose.tip[line.along];
        let [a, b] = line.material;
        let (low, high) = (tip - reach - stray, tip + reach + stray);
        // Outside of both the nearest end alone is left.
        StockLine { material: [a.max(low).min(b), b.min(high).max(a)], ..*line }
    }
}

impl Look<'_> {
    /// Tells what the line loses, from so many looks.
    fn by_looks<const COUNT: usize>(&self, found: &mut dyn FnMut([CoverEnd; 2])) {
        let time = |i: usize| i as f64 / (COUNT - 1) as f64 - 0.5;
        let looks: [Option<Met>; COUNT] = std::array::from_fn(|i| match COUNT {
            3 => self.at_pose(TIMES[i], &self.of.poses[i]),
            _ => self.at(time(i)),
        });
        if looks.iter().all(Option::is_none) {
            let Some(met) = self.nearest() else { return };
            let around = if met.t < 0.0 { [-0.5, 0.0] } else { [0.0, 0.5] };
            return self.told(&[met], around, PARTS, found);
        }
        // Looks that are parted by one at which the line is not met have stretches of their own.
        let mut next = 0;
        for run in looks.chunk_by(|a, b| a.is_some() == b.is_some()) {
            let around = [next.max(1) - 1, (next + run.len()).min(COUNT - 1)].map(time);
            next += run.len();
            let mut mets = Mets::<COUNT>::new();
            run.iter().flatten().for_each(|met| mets.add(*met));
            if !mets.list().is_empty() {
                self.told(mets.list(), around, PARTS, found);
            }
        }
    }

    /// Tells what the line loses at the times around looks at which it is met: one stretch, or one for each of the times between which
    /// it is not met.
    fn told(&self, mets: &[Met], around: [f64; 2], parts: u32, found: &mut dyn FnMut([CoverEnd; 2])) {
        if mets.iter().all(|met| self.line.is_free(met.chord.lo, met.chord.hi)) {
            let [low, high] = [false, true].map(|upper| self.least_of(mets, around, upper));
            if self.line.is_free(low, -high) {
                return;
            }
        }
        let (Some(lo), Some(hi)) = (self.furthest(mets, around, false), self.furthest(mets, around, true))
        else {
            return;
        };
        let Some(gap) = self.parted(&lo, &hi, HALVINGS) else {
            return found([self.end(&lo, false), self.end(&hi, true)]);
        };
        let all = || mets.iter().chain([&lo, &hi]);
        if parts == 0 {
            return all().for_each(|met| found([self.end(met, false), self.end(met, true)]));
        }
        for (side, around) in [(true, [around[0], gap]), (false, [gap, around[1]])] {
            let mut some = Mets::<MOST_METS>::new();
            all().filter(|met| (met.t < gap) == side).for_each(|met| some.add(*met));
            self.told(some.list(), around, parts - 1, found);
        }
    }

    /// A time between two looks at which the line is not met, or may not be; none where their chords overlap, or are joined by
    /// chords at times between them.
    fn parted(&self, a: &Met, b: &Met, depth: u32) -> Option<f64> {
        if a.chord.lo <= b.chord.hi && b.chord.lo <= a.chord.hi {
            return None;
        }
        let middle = 0.5 * (a.t + b.t);
        match self.at(middle) {
            Some(_) if depth == 0 => None,
            Some(met) => self.parted(a, &met, depth - 1).or_else(|| self.parted(&met, b, depth - 1)),
            None => Some(middle),
        }
    }

    fn end(&self, met: &Met, upper: bool) -> CoverEnd {
        let (s, touch) =
            if upper { (met.chord.hi, met.chord.hi_at) } else { (met.chord.lo, met.chord.lo_at) };
        let [low, high] = self.line.material;
        if s < low - ROUNDING || s > high + ROUNDING {
            // It does not stay.
            return CoverEnd { s, t: met.t, normal: DVec3::Z, touch };
        }
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
