//! Spans of moves with their tools, and moves made ready.

use std::ops::Range;

use glam::DVec3;

use super::super::body::bounds;
use super::super::list::CutList;
use super::super::task::{Tool, beside};
use super::super::{CutMove, Stance};
use super::hollow::Plunge;
use super::span::spans;
use super::swept::SpanPoses;
use crate::geom::{Aabb, Rigid};
use crate::stock::{Axis, CutId, Lattice};

/// Spans that are made ready at once: bounds the memory of the lists.
const MOST: usize = 20_000;

/// Least travel of a tool in a span [mm].
const LEAST_TRAVEL: f64 = 0.02;

/// Distance below which two tips are one, and two axes [mm].
const SAME: f64 = 1e-6;

/// A span of a move with its tool.
pub(super) struct SpanTask<'a> {
    pub(super) poses: SpanPoses,
    /// Index of the move in the batch.
    pub(super) index: u32,
    pub(super) cut: CutId,
    pub(super) one: &'a CutMove,
    pub(super) tool: &'a Tool,
    /// See [`super::span::PoseSpan::bend`].
    pub(super) bend: f64,
    /// Most that a point of the tool moves in the span [mm].
    pub(super) travel: f64,
    /// All that the tool sweeps.
    pub(super) bounds: Aabb,
    /// The tool draws back along its axis: its shank comes by before its edges cut there.
    pub(super) before: bool,
    /// The tool as its edge is, where that leaves a core and moves along its axis.
    pub(super) plunge: Option<Plunge<'a>>,
    pub(super) clearance: f64,
}

impl SpanTask<'_> {
    /// True if it begins with the tool as another ends.
    pub(super) fn goes_on(&self, before: &SpanTask) -> bool {
        let ([start, ..], [.., end]) = (&self.poses.poses, &before.poses.poses);
        let near = |a: DVec3, b: DVec3| a.distance_squared(b) < SAME * SAME;
        std::ptr::eq(self.tool, before.tool) && near(start.tip, end.tip) && near(start.axis, end.axis)
    }
}

/// Moves made ready.
pub(super) struct Batch<'a> {
    pub(super) moves: &'a [CutMove],
    /// The cut of the first of them.
    pub(super) first: CutId,
    /// Spans in their order.
    pub(super) tasks: Vec<SpanTask<'a>>,
    /// By move: how far its path was replaced [mm].
    pub(super) errors: Vec<f64>,
    /// By move: a hollow tool is cut as if it were none.
    pub(super) filled: Vec<bool>,
    /// By move: the coordinate of the stock along which the axis of the tool runs most in the middle.
    pub(super) main: Vec<usize>,
}

impl<'a> Batch<'a> {
    /// Of a range of moves, as many as there is room for, for a stock with a lattice over a box.
    pub(super) fn new(
        (lattice, bounds_of_stock): (&Lattice, Aabb),
        list: &'a CutList,
        range: Range<usize>,
    ) -> Batch<'a> {
        let (first, moves) = (list.cut(range.start), &list.moves[range]);
        let margin = beside(lattice.step).unwrap_or(0.0);
        let within = bounds_of_stock.grown(lattice.step);
        let mut batch =
            Batch { moves: &[], first, tasks: vec![], errors: vec![], filled: vec![], main: vec![] };
        for (i, one) in moves.iter().enumerate() {
            if batch.tasks.len() >= MOST {
                break;
            }
            let Stance::Leaning(motion) = &one.stance else { break };
            let tool = &list.tools[one.body as usize];
            let all = [&tool.cutting, &tool.shank, &tool.holder];
            let reach: f64 = all.iter().map(|b| b.top.max(-b.bottom).max(0.0) + b.radius).fold(0.0, f64::max);
            let thinnest = tool.cutting.parts.iter().map(|p| p.r1).fold(f64::INFINITY, f64::min);
            let is_far = |ends: [Rigid; 2], off: f64| {
                let swept = ends.map(|pose| bounds(pose.translation, pose.rotation.z_axis, &all));
                !swept[0].union(swept[1]).grown(off + margin).meets(within)
            };
            let (spans, mut error) = spans(motion, reach, thinnest.max(LEAST_TRAVEL), is_far);
            let mut filled = false;
            for span in spans {
                let poses = SpanPoses::new(span);
                let middle = &poses.poses[1];
                let bounds = bounds(middle.tip, middle.axis, &all).grown(span.stray(reach) + margin);
                if !bounds.meets(within) {
                    continue;
                }
                let plunge = tool.hollow.as_ref().and_then(|hollow| Plunge::of(hollow, &span));
                error = plunge.iter().map(|p| p.across).fold(error, f64::max);
                filled |= tool.hollow.is_some() && plunge.is_none();
                batch.tasks.push(SpanTask {
                    plunge,
                    clearance: list.options.clearance,
                    before: middle.tip_rate.dot(middle.axis) > 0.0,
                    bend: span.bend(reach),
                    travel: 2.0 * span.stray(reach),
                    bounds,
                    poses,
                    index: i as u32,
                    cut: first.wrapping_add(i as u32),
                    one,
                    tool,
                });
            }
            batch.errors.push(error);
            batch.filled.push(filled);
            batch.main.push(Axis::nearest(motion.pose(0.5).rotation.z_axis).index());
            batch.moves = &moves[..=i];
        }
        batch
    }

    /// The spans of a range of moves.
    pub(super) fn tasks_of(&self, moves: Range<usize>) -> &[SpanTask<'a>] {
        let at = |index: usize| self.tasks.partition_point(|t| (t.index as usize) < index);
        &self.tasks[at(moves.start)..at(moves.end)]
    }
}
