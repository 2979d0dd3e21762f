//! Planned chamfers as `plan.json` has them.

use serde::Serialize;

use super::PlannedChamfer;
use crate::contouring::{ContourSide, PlannedLoop};

/// A chamfer; lengths [mm], heights in the work offset.
#[derive(Debug, Serialize)]
pub(crate) struct ChamferJson {
    operation: u32,
    side: ContourSide,
    width: f64,
    /// Depth of the tip below the edge.
    depth: f64,
    /// Distance of the cutter's axis from the wall.
    offset: f64,
    /// Radius of the cutter at the edge.
    top_radius: f64,
    tip_clearance: f64,
    /// mm/min.
    feed: f64,
    plunge_feed: f64,
    loops: Vec<LoopJson>,
    /// Inside corners before which the chamfer ends.
    webs: Vec<WebJson>,
}

/// A loop of the path of the cutter's tip.
#[derive(Debug, Serialize)]
struct LoopJson {
    outer: bool,
    start: [f64; 2],
    length: f64,
}

#[derive(Debug, Serialize)]
struct WebJson {
    at: [f64; 2],
    /// Length of the edge that it keeps; none where the cutter does not go between two loops.
    length: Option<f64>,
}

impl ChamferJson {
    /// Of a plan and the number of its operation.
    pub(super) fn new(plan: &PlannedChamfer, operation: u32) -> ChamferJson {
        let chamfer = &plan.of.chamfer;
        let one = |l: &PlannedLoop| LoopJson {
            outer: l.outer,
            start: l.edges.first().map_or([0.0; 2], |e| e.start.to_array()),
            length: l.length(),
        };
        let corners = plan.plan.uncut.iter();
        ChamferJson {
            operation,
            side: plan.spec.side,
            width: chamfer.width,
            depth: chamfer.depth(),
            offset: chamfer.offset(),
            top_radius: chamfer.top_radius(),
            tip_clearance: chamfer.tip_clearance,
            feed: plan.spec.feed * 60.0,
            plunge_feed: plan.spec.plunge_feed * 60.0,
            loops: plan.plan.loops.iter().map(one).collect(),
            webs: corners.map(|c| WebJson { at: c.at.to_array(), length: c.length }).collect(),
        }
    }
}
