//! Planned milled threads as `plan.json` has them.

use serde::Serialize;

use super::PlannedThreadMilling;
use crate::threading::{MillProfile, ThreadForm, ThreadSide};
use crate::tool::Hand;

/// Threads of one operation; lengths [mm], Z in the work offset.
#[derive(Debug, Serialize)]
pub(crate) struct MilledThreadsJson {
    operation: u32,
    thread: String,
    side: ThreadSide,
    form: ThreadForm,
    hand: Hand,
    diameter: f64,
    pitch: f64,
    /// Nominal, as all diameters.
    pitch_diameter: f64,
    /// Added to the diameters; deviations are from the sums.
    oversize: f64,
    minor_diameter: f64,
    /// Change of the diameter over a length along the axis.
    taper: f64,
    depth: f64,
    profile: MillProfile,
    rows: u32,
    counter_clockwise: bool,
    upwards: bool,
    /// Radius of the path as the sections say, and as it is run; at the bottom.
    nominal_radius: f64,
    centre_radius: f64,
    /// Way by which the flanks would overcut without a correction, and the same to second order.
    overcut: f64,
    overcut_second_order: f64,
    /// Slope of the helix, degrees.
    slope: f64,
    /// Z of the tool's lowest point.
    lowest: f64,
    /// mm/min, of the edge at the major diameter and of the centre at full depth.
    feed: f64,
    centre_feed: f64,
    /// Largest deviation of the pitch diameter in the text; `null` where a helix is wrong, or where the profile is the maker's.
    deviation: Option<f64>,
    helices: Vec<HelixJson>,
}

/// A helix.
#[derive(Debug, Serialize)]
struct HelixJson {
    at: [f64; 2],
    /// Share of the thread's depth.
    share: f64,
    /// Of the tool's centre, where it begins and where it ends.
    radii: [f64; 2],
    /// Z of the lowest row's middle there.
    heights: [f64; 2],
    turns: f64,
    /// mm/min, of the tool's centre along it and its leads.
    centre_feed: f64,
}

impl MilledThreadsJson {
    /// Of a plan and the number of its operation.
    pub(super) fn new(plan: &PlannedThreadMilling, operation: u32) -> MilledThreadsJson {
        let (spec, thread, mill) = (&plan.spec, &plan.of.thread, &plan.of.mill);
        let helices = plan.plan.runs.iter().map(|run| HelixJson {
            at: spec.places[run.place].to_array(),
            share: run.share,
            radii: run.radii,
            heights: run.heights,
            turns: run.turns,
            centre_feed: run.feed * 60.0,
        });
        MilledThreadsJson {
            operation,
            thread: thread.name(),
            side: spec.side,
            form: thread.form,
            hand: thread.hand,
            diameter: thread.diameter,
            pitch: thread.pitch,
            pitch_diameter: thread.pitch_diameter(),
            oversize: spec.oversize,
            minor_diameter: thread.minor_diameter(),
            taper: thread.taper,
            depth: spec.depth,
            profile: spec.cutter.profile,
            rows: mill.rows,
            counter_clockwise: plan.plan.travel.counter_clockwise,
            upwards: plan.plan.travel.upwards,
            nominal_radius: plan.plan.radii[0],
            centre_radius: plan.plan.radii[1],
            overcut: plan.plan.gain[0],
            overcut_second_order: plan.plan.gain[1],
            slope: plan.plan.slope.to_degrees(),
            lowest: plan.plan.lowest,
            feed: spec.feed * 60.0,
            centre_feed: plan.plan.feed * 60.0,
            deviation: plan.deviation,
            helices: helices.collect(),
        }
    }
}
