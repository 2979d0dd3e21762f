//! Planned contours as `plan.json` has them.

use serde::Serialize;

use super::PlannedContour;
use crate::contouring::{ContourSide, PlannedLoop};
use crate::operations::slowed::SlowedJson;

/// A contour; lengths [mm], heights in the work offset.
#[derive(Debug, Serialize)]
pub(crate) struct ContourJson {
    operation: u32,
    side: ContourSide,
    /// Floors of the levels of roughing, the lowest last.
    levels: Vec<f64>,
    /// mm/min.
    feed: f64,
    plunge_feed: f64,
    loops: Vec<LoopJson>,
    /// Stretches of the finish whose feed is reduced, if it is to be.
    corner_feed: Option<SlowedJson>,
    /// Inside corners that the cutter does not reach.
    uncut_corners: Vec<CornerJson>,
}

/// A loop of the path of the cutter's centre.
#[derive(Debug, Serialize)]
struct LoopJson {
    finishing: bool,
    outer: bool,
    start: [f64; 2],
    length: f64,
    tabs: Vec<[f64; 2]>,
}

#[derive(Debug, Serialize)]
struct CornerJson {
    at: [f64; 2],
    /// None where the cutter does not go between two loops.
    thickness: Option<f64>,
}

impl ContourJson {
    /// Of a plan and the number of its operation.
    pub(super) fn new(plan: &PlannedContour, operation: u32) -> ContourJson {
        let one = |l: &PlannedLoop| LoopJson {
            finishing: l.finishing,
            outer: l.outer,
            start: l.edges.first().map_or([0.0; 2], |e| e.start.to_array()),
            length: l.length(),
            tabs: l.tabs.iter().map(|t| t.at.to_array()).collect(),
        };
        let corners = plan.plan.uncut.iter();
        ContourJson {
            operation,
            side: plan.spec.side,
            levels: plan.plan.levels.clone(),
            feed: plan.spec.feed * 60.0,
            plunge_feed: plan.spec.plunge_feed * 60.0,
            loops: plan.plan.loops.iter().map(one).collect(),
            corner_feed: plan
                .plan
                .slowed
                .as_ref()
                .zip(plan.spec.finish)
                .map(|(slowed, finish)| SlowedJson::new(slowed, finish.feed)),
            uncut_corners: corners
                .map(|c| CornerJson { at: c.at.to_array(), thickness: c.thickness })
                .collect(),
        }
    }
}
