//! A convex part over a span, seen from a point: what it keeps away from, and what it swallows.
//!
//! Source: the gauge of a convex part is convex in the frame of the tool, and falls by no more than the distance. So the part stays
//! behind its tangent plane at any point, which moves as the point does in the frame of the tool.

use glam::DVec3;

use super::super::super::body::ConvexPart;
use super::super::chord::gauge_at;
use super::super::task::SpanTask;
use super::cells::Cell;
use crate::geom::Aabb;

/// Way by which a cell lies within a tool that swallows it: more than the rounding of ends [mm].
const WITHIN: f64 = 1e-4;

/// A convex part over a span.
pub(super) struct SweptPart<'a> {
    pub(super) task: &'a SpanTask<'a>,
    pub(super) part: &'a ConvexPart,
    /// Index of the part in its tool.
    pub(super) index: usize,
    /// All that it sweeps.
    pub(super) bounds: Aabb,
    /// Bend of the way, seen from the tool [mm].
    bend: f64,
}

/// A plane that a part stays behind, near a cell: all it sweeps of the cell has `normal . (q - centre) <= reach`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangent {
    /// Outward unit normal of the part.
    pub(super) normal: DVec3,
    /// How far beyond the centre of the cell the part reaches [mm]; negative when it ends before it.
    pub(super) reach: f64,
}

impl<'a> SweptPart<'a> {
    pub(super) fn new(task: &'a SpanTask<'a>, part: &'a ConvexPart, index: usize) -> SweptPart<'a> {
        let pose = &task.poses.poses[1];
        let far = part.top.max(-part.z0).hypot(part.r1);
        let ends = [part.z0, part.top].map(|z| pose.tip + pose.axis * z);
        SweptPart {
            bounds: Aabb::of_points(ends).grown(part.r1 + task.poses.span.stray(far)),
            bend: task.poses.bend_seen(task.bend),
            task,
            part,
            index,
        }
    }

    /// The tangent plane of the part about a cell.
    pub(super) fn tangent(&self, cell: &Cell) -> Tangent {
        let pose = &self.task.poses.poses[1];
        let gauge = gauge_at(self.part, pose, cell.centre);
        let rate = gauge.normal.dot(pose.velocity(cell.centre - pose.tip)).abs();
        let slack = 0.5 * (rate + cell.radius * pose.axis_rate.length()) + 2.0 * self.bend;
        Tangent { normal: gauge.normal, reach: slack - gauge.value }
    }

    /// The tangent plane about a cell; `None` if the part stays away from the cell.
    pub(super) fn reaches(&self, cell: &Cell) -> Option<Tangent> {
        let tangent = self.tangent(cell);
        (tangent.reach >= -cell.radius).then_some(tangent)
    }

    /// True if the cell lies within the part at the start, the middle or the end.
    pub(super) fn swallows(&self, cell: &Cell) -> bool {
        self.task.poses.poses.iter().any(|pose| gauge_at(self.part, pose, cell.centre).value < -cell.radius - WITHIN)
    }
}
