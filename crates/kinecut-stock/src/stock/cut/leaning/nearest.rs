//! Lines that a part does not meet in a span, and the time of touch where three looks miss it.
//!
//! Source: the gauge of a convex body is convex in the frame of the body, whatever its motion; a plane of that frame is linear on
//! a line at each time.

use glam::DVec3;

use super::chord::{Gauge, LineFrom};
use super::look::{Look, Met};
use super::span::Pose;

/// Part of a span's time below which a touch between two looks is not sought: what it covers is thinner than the tool moves in it.
const LEAST_ROOM: f64 = 1e-4;

/// Looks after which a touch counts as none, and tangents after which a gap is taken as it is.
const STEPS: usize = 48;

/// The part stays outside of the half space behind a plane that is carried along: a bound on its gauge.
#[derive(Clone, Copy, Debug)]
struct Plane {
    /// Place on the line, and the gauge there, or less.
    s: f64,
    value: f64,
    normal: DVec3,
}

/// The nearest a part comes to a line at one time.
#[derive(Clone, Copy, Debug)]
enum Gap {
    /// It keeps away at all times that were asked about.
    Clear,
    /// The rate of the gap by the time.
    Open(f64),
}

impl Look<'_> {
    /// True if the part stays away from the material of the line: by the gauge at its ends in the middle of the time,
    /// or by that and the gauge at the end of the time to which the part comes nearer.
    pub(super) fn misses(&self) -> bool {
        let pose = &self.of.poses[1];
        let from = LineFrom::new(self.line.start, self.line.along, pose);
        let plane = |from: &LineFrom, s: f64| {
            let gauge = from.gauge(self.part, s);
            Plane { s, value: gauge.value, normal: gauge.normal }
        };
        let [mut near, mut far] = self.line.material.map(|s| plane(&from, s));
        if far.value < near.value {
            (near, far) = (far, near);
        }
        if !(near.value > 0.0) {
            return false;
        }
        let reach = self.line.material.iter().map(|s| from.point(*s).length()).fold(0.0, f64::max);
        let bend = self.of.bend_at(self.part, reach);
        if [&near, &far].iter().any(|plane| self.least(plane, pose, &from, 0.5, bend) > 0.0) {
            return true;
        }
        let rate = -near.normal.dot(pose.velocity(from.point(near.s)));
        let (time, pose_then) = if rate > 0.0 { (-0.5, &self.of.poses[0]) } else { (0.5, &self.of.poses[2]) };
        let then = LineFrom::new(self.line.start, self.line.along, pose_then);
        let last = plane(&then, near.s);
        let last_rate = -last.normal.dot(pose_then.velocity(then.point(near.s)));
        // The planes in shares with which what both say of that end does not change in time; else the last alone.
        let share = if (rate > 0.0) != (last_rate > 0.0) { last_rate / (last_rate - rate) } else { 0.0 };
        self.line.material.iter().all(|s| {
            let says = |plane: &Plane, from: &LineFrom, pose: &Pose| {
                let place = from.point(*s);
                let rate = -plane.normal.dot(pose.velocity(place));
                let nearer = self.of.nearer(pose, plane.normal, place, self.part);
                (plane.value + plane.normal[self.line.along] * (s - plane.s), rate, nearer)
            };
            let ((v, r, [nearer, _]), (w, q, [_, then_nearer])) =
                (says(&near, &from, pose), says(&last, &then, pose_then));
            let slack = share * nearer + (1.0 - share) * then_nearer;
            let at = |t: f64| share * (v + r * t) + (1.0 - share) * (w + q * (t - time));
            at(-0.5) > slack && at(0.5) > slack
        })
    }

    /// True if the part stays away from the material of the line, and from all that is no farther than `by` from it [mm].
    pub(super) fn keeps_off(&self, by: f64) -> bool {
        matches!(self.gap(&self.of.poses[1], 0.5, by), Gap::Clear)
    }

    /// The least gauge that a plane allows on the material of the line, at most `room` of the time before and after.
    ///
    /// The gauge is convex in the frame of the tool, so that it lies above its tangent plane there. Carried along, the plane is
    /// linear on the line at each time: its least is at an end of the material. How it changes in time is its rate, and the bend.
    fn least(&self, plane: &Plane, pose: &Pose, from: &LineFrom, room: f64, bend: f64) -> f64 {
        let slope = plane.normal[self.line.along];
        let at = |s: f64| {
            let rate = plane.normal.dot(pose.velocity(from.point(s))).abs();
            plane.value + slope * (s - plane.s) - rate * room
        };
        let [a, b] = self.line.material.map(at);
        (if a < b { a } else { b }) - 8.0 * bend * room * room
    }

    /// A look at a time at which the line is met, where it is at none of the three: halves of the time, the one in which the gap
    /// closes first, without those in which it cannot.
    pub(super) fn nearest(&self) -> Option<Met> {
        let mut open = [(0.0, 0.0); 2 * STEPS];
        open[0] = (-0.5, 0.5);
        let mut count = 1;
        for _ in 0..STEPS {
            if count == 0 {
                return None;
            }
            count -= 1;
            let (from, to) = open[count];
            let t = 0.5 * (from + to);
            let pose = self.of.span.at(t);
            let Gap::Open(rate) = self.gap(&pose, t - from, 0.0) else { continue };
            if let Some(met) = self.at_pose(t, &pose) {
                return Some(met);
            }
            if t - from < LEAST_ROOM {
                continue;
            }
            // The last one is looked at first.
            let halves = [(from, t), (t, to)];
            (open[count], open[count + 1]) =
                if rate > 0.0 { (halves[1], halves[0]) } else { (halves[0], halves[1]) };
            count += 2;
        }
        None
    }

    /// The gap on the line, and on all that is no farther than `by` from it, at one time and at most `room` of the time before and
    /// after: by tangents, which lie below a convex function.
    fn gap(&self, pose: &Pose, room: f64, by: f64) -> Gap {
        let from = LineFrom::new(self.line.start, self.line.along, pose);
        let [mut a, mut b] = self.line.material;
        let (mut ga, mut gb) = (from.gauge(self.part, a), from.gauge(self.part, b));
        let along = self.line.along;
        // The gauge falls by no more than the distance from the line, and its rate by no more than the turn over that.
        let off = by * (1.0 + pose.axis_rate.length() * room);
        let told = |plane: Plane| {
            if plane.value > by && self.least(&plane, pose, &from, room, self.bend) > off {
                Gap::Clear
            } else {
                Gap::Open(-plane.normal.dot(pose.velocity(from.point(plane.s))))
            }
        };
        let plane = |s: f64, g: &Gauge| Plane { s, value: g.value, normal: g.normal };
        if ga.normal[along] >= 0.0 {
            return told(plane(a, &ga));
        }
        if gb.normal[along] <= 0.0 {
            return told(plane(b, &gb));
        }
        let mut best = if ga.value < gb.value { ga.value } else { gb.value };
        let mut last = Gap::Open(0.0);
        for step in 0..STEPS {
            let (sa, sb) = (ga.normal[along], gb.normal[along]);
            let meet = ((gb.value - ga.value + sa * a - sb * b) / (sa - sb)).clamp(a, b);
            // The function lies above its tangents, and above their mean that is level on the line.
            let least = ga.value + sa * (meet - a);
            let level = (ga.normal * sb - gb.normal * sa) / (sb - sa);
            last = told(Plane { s: meet, value: least, normal: level });
            if matches!(last, Gap::Clear) || best - least < 1e-9 {
                break;
            }
            let s = match step % 3 {
                0 => meet,
                1 => a + (b - a) * (sa / (sa - sb)),
                _ => 0.5 * (a + b),
            };
            let g = from.gauge(self.part, s);
            best = if g.value < best { g.value } else { best };
            if best <= by {
                return Gap::Open(-g.normal.dot(pose.velocity(from.point(s))));
            }
            if g.normal[along] < 0.0 {
                (a, ga) = (s, g);
            } else {
                (b, gb) = (s, g);
            }
        }
        last
    }
}
