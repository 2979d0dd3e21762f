//! SetupPlan threads as `plan.json` has them.

use serde::Serialize;

use super::PlannedTapping;
use crate::tool::Hand;

/// Threads of one operation; Z in the work offset [mm].
#[derive(Debug, Serialize)]
pub(crate) struct ThreadsJson {
    operation: u32,
    thread: String,
    hand: Hand,
    pitch: f64,
    forming: bool,
    /// Full thread, lead and point of the tap [mm].
    depth: f64,
    lead: f64,
    tip: f64,
    /// Z from which feed and spindle run together, and Z of the tap's lowest point.
    reference: f64,
    bottom: f64,
    /// rev/min, mm/min.
    speed: f64,
    feed: f64,
    /// Of one thread, in and out [s].
    time: f64,
    holes: Vec<HoleJson>,
}

/// One thread.
#[derive(Debug, Serialize)]
struct HoleJson {
    at: [f64; 2],
    core_diameter: f64,
    /// Z down to which the core hole has its diameter; `null` where it is open below.
    core_bottom: Option<f64>,
    /// Share of the height of the ISO profile.
    thread_share: f64,
}

impl ThreadsJson {
    /// Of a plan and the number of its operation.
    pub(super) fn new(plan: &PlannedTapping, operation: u32) -> ThreadsJson {
        let (of, tap) = (&plan.of, &plan.of.tap);
        let holes = plan.threads.iter().map(|thread| HoleJson {
            at: thread.at,
            core_diameter: thread.core.diameter,
            core_bottom: Some(thread.core.bottom).filter(|_| !thread.core.through),
            thread_share: tap.thread_share(thread.core.diameter),
        });
        ThreadsJson {
            operation,
            thread: tap.name(),
            hand: of.hand(),
            pitch: tap.pitch,
            forming: tap.forming,
            depth: of.depth,
            lead: tap.lead * tap.pitch,
            tip: tap.tip,
            reference: of.reference(),
            bottom: of.bottom(),
            speed: of.milling.spindle * 60.0 / std::f64::consts::TAU,
            feed: plan.feed() * 60.0,
            time: plan.time(),
            holes: holes.collect(),
        }
    }
}
