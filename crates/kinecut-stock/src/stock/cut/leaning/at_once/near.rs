//! A convex part over a span, seen from a point: what it keeps away from, and what it swallows.
//!
//! Source: the gauge of a convex part is convex in the frame of the tool, and falls by no more than the distance. So the part stays
//! behind its tangent plane at any point, which moves as the point does in the frame of the tool.

use glam::DVec3;

use super::super::super::body::ConvexPart;
use super::super::chord::gauge_at;
use super::super::span::Pose;
use super::super::task::SpanTask;
use super::cells::Cell;
use crate::geom::Aabb;

/// Way by which a cell, or a line, lies within a tool that takes all of it: more than the rounding of ends [mm].
const WITHIN: f64 = 1e-4;

/// A convex part over a span.
pub(super) struct SweptPart<'a> {
    pub(super) task: &'a SpanTask<'a>,
    /// The pose in the middle, near at hand, and how fast the tool turns there [rad by the span's parameter].
    middle: Pose,
    turn: f64,
    pub(super) part: &'a ConvexPart,
    /// Index of the part in its tool.
    pub(super) index: usize,
    /// All that it sweeps.
    pub(super) bounds: Aabb,
    /// Bend of the way of the tip, seen from the tool [mm], and what each millimetre from the tip adds.
    bends: [f64; 2],
}

/// A plane that a part stays behind, near a cell: all it sweeps of the cell has `normal . (q - centre) <= reach`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangent {
    /// Outward normal of the part, no longer than 1.
    pub(super) normal: DVec3,
    /// How far beyond the centre of the cell the part reaches [mm]; negative when it ends before it.
    pub(super) reach: f64,
    /// How far it likely reaches there, no more than a guess [mm].
    pub(super) likely: f64,
}

impl<'a> SweptPart<'a> {
    pub(super) fn new(task: &'a SpanTask<'a>, part: &'a ConvexPart, index: usize) -> SweptPart<'a> {
        let pose = &task.poses.poses[1];
        let span = &task.poses.span;
        let far = part.top.max(-part.z0).hypot(part.r1);
        let ends = [part.z0, part.top].map(|z| pose.tip + pose.axis * z);
        SweptPart {
            bounds: Aabb::of_points(ends).grown(part.r1 + span.stray(far)),
            bends: [task.poses.bend_seen(span.bend(0.0)), span.bend(1.0) - span.bend(0.0)],
            middle: *pose,
            turn: pose.axis_rate.length(),
            task,
            part,
            index,
        }
    }

    /// The tangent plane of the part about a cell.
    pub(super) fn tangent(&self, cell: &Cell) -> Tangent {
        let pose = &self.middle;
        let gauge = gauge_at(self.part, pose, cell.centre);
        let rate = gauge.normal.dot(pose.velocity(cell.centre - pose.tip)).abs();
        let slack = 0.5 * (rate + cell.radius * self.turn) + 2.0 * self.bend(cell);
        Tangent { normal: gauge.normal, reach: slack - gauge.value, likely: -gauge.value }
    }

    /// The tangent plane at the middle of the time, or one that keeps closer to the part: that and the one at the end of the time to
    /// which the part comes nearer, in shares with which what both say of the centre does not change in time.
    pub(super) fn tangent_closely(&self, cell: &Cell) -> Tangent {
        let poses = &self.task.poses.poses;
        let at = |pose: &Pose| {
            let gauge = gauge_at(self.part, pose, cell.centre);
            (gauge, -gauge.normal.dot(pose.velocity(cell.centre - pose.tip)))
        };
        let (middle, rate) = at(&poses[1]);
        let (time, end) = if rate > 0.0 { (-0.5, &poses[0]) } else { (0.5, &poses[2]) };
        let (last, last_rate) = at(end);
        // Share of the plane at the middle: none if the part comes nearer up to the end.
        let share = if rate * last_rate < 0.0 { last_rate / (last_rate - rate) } else { 0.0 };
        let both = |a: f64, b: f64| share * a + (1.0 - share) * b;
        // At the end the rate lets the gauge rise from there; else both rates together come to nothing.
        let value = both(middle.value, if share > 0.0 { last.value - last_rate * time } else { last.value });
        let (turn, bend) = (self.turn, self.bend(cell));
        let slack = both(0.5, 1.0) * cell.radius * turn + 8.0 * bend * both(0.25, 1.0);
        let wide = 0.5 * (rate.abs() + cell.radius * turn) + 2.0 * bend;
        let likely = -value;
        if slack - value < wide - middle.value {
            let normal = middle.normal * share + last.normal * (1.0 - share);
            Tangent { normal, reach: slack - value, likely }
        } else {
            Tangent { normal: middle.normal, reach: wide - middle.value, likely }
        }
    }

    /// The bend of the way that a part takes past a cell, seen from the tool [mm].
    fn bend(&self, cell: &Cell) -> f64 {
        let [tip, by_reach] = self.bends;
        let reach = cell.centre.distance(self.middle.tip) + cell.radius + 2.0 * self.part.r1;
        tip + by_reach * reach
    }

    /// The tangent plane about a cell; `None` if the part stays away from the cell.
    pub(super) fn reaches(&self, cell: &Cell) -> Option<Tangent> {
        let tangent = self.tangent(cell);
        (tangent.reach >= -cell.radius).then_some(tangent)
    }

    /// True if a stretch of a line lies within the part at the start, the middle or the end.
    pub(super) fn holds(&self, ends: [DVec3; 2]) -> bool {
        let within = |pose: &Pose| ends.iter().all(|end| gauge_at(self.part, pose, *end).value < -WITHIN);
        self.task.poses.poses.iter().any(within)
    }

    /// True if the cell lies within the part at the start, the middle or the end.
    pub(super) fn swallows(&self, cell: &Cell) -> bool {
        self.task
            .poses
            .poses
            .iter()
            .any(|pose| gauge_at(self.part, pose, cell.centre).value < -cell.radius - WITHIN)
    }
}
