//! The helices of a posted program: points of the way of the tool about the axis of each thread.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::PlannedThreadMilling;
use crate::operations::PostedPlan;
use crate::program::Role;
use crate::trace::SegmentPace;

/// Angle between points of a curve, at most [rad].
const STEP: f64 = TAU / 64.0;

/// A helix as the control reads it, about the axis of its thread.
#[derive(Clone, Debug)]
pub(super) struct PostedHelix {
    /// The first item of the text.
    pub(super) item: u32,
    /// Whether the control runs it as one of the last passes.
    pub(super) finishing: bool,
    /// Points in the coordinates of the operation.
    pub(super) points: Vec<DVec3>,
}

/// A point of a helix: distance from the axis, angle turned since its start, height of the tool's tip [mm, rad].
#[derive(Clone, Copy, Debug)]
pub(super) struct About {
    pub(super) radius: f64,
    pub(super) turned: f64,
    pub(super) z: f64,
}

impl PostedHelix {
    /// The helices of an operation in the order of the text: moves that cut, between the ways in and out.
    pub(super) fn all(plan: &PlannedThreadMilling, posted: &PostedPlan<'_>) -> Vec<PostedHelix> {
        let to_operation = posted.to_part(&plan.of.milling).inverse();
        let step = STEP * plan.plan.radii[1];
        let mut found: Vec<PostedHelix> = Vec::new();
        let mut open = false;
        for segment in posted.trace.segments.iter().filter(|s| !s.alternative) {
            let Some(planned) = posted.planned_item(segment.item).filter(|i| plan.items.contains(i)) else {
                open = false;
                continue;
            };
            let role = posted.planned.origin(planned as usize).role;
            let feeds = matches!(segment.motion, SegmentPace::Feed(_));
            if !feeds || !matches!(role, Role::Rough | Role::Finish) {
                open = false;
                continue;
            }
            if !open {
                let finishing = role == Role::Finish;
                found.push(PostedHelix { item: segment.item, finishing, points: Vec::new() });
            }
            open = true;
            let Some(helix) = found.last_mut() else { continue };
            let (curve, length) = (&segment.curve, segment.curve.length());
            let count = (length / step).ceil().clamp(2.0, 1e6) as u32;
            let from = u32::from(!helix.points.is_empty());
            helix.points.extend(
                (from..=count)
                    .map(|i| to_operation.point(curve.at(length * f64::from(i) / f64::from(count)).p)),
            );
        }
        found
    }

    /// Its points about an axis.
    pub(super) fn about(&self, axis: DVec2) -> Vec<About> {
        let mut turned = 0.0;
        let mut before: Option<DVec2> = None;
        self.points
            .iter()
            .map(|p| {
                let arm = p.truncate() - axis;
                if let Some(before) = before {
                    let step = before.perp_dot(arm).atan2(before.dot(arm));
                    turned += if step == -PI { PI } else { step };
                }
                before = Some(arm);
                About { radius: arm.length(), turned, z: p.z }
            })
            .collect()
    }

    /// Angle from X in which it begins about an axis [rad].
    pub(super) fn begins(&self, axis: DVec2) -> f64 {
        self.points.first().map_or(0.0, |p| (p.truncate() - axis).to_angle())
    }
}
