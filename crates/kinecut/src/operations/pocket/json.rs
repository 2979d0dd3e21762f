//! Planned pockets as `plan.json` has them.

use serde::Serialize;

use super::PlannedPocket;
use crate::operations::slowed::SlowedJson;

/// A pocket; lengths [mm], areas [mm2], heights in the work offset, figures of one level.
#[derive(Debug, Serialize)]
pub(crate) struct PocketJson {
    operation: u32,
    /// Degrees.
    engagement: f64,
    /// Largest engagement of a pass, degrees.
    largest_engagement: f64,
    /// Floors of the levels, the lowest last.
    levels: Vec<f64>,
    /// mm/min.
    feed: f64,
    plunge_feed: f64,
    link_feed: f64,
    passes: usize,
    /// Ways down into the stock: helices, and the two after it.
    entries: usize,
    ramps: usize,
    plunges: usize,
    /// Engagement of these seen from above, degrees; none without any.
    entry_engagement: Option<f64>,
    /// The places that are cleared, if only those that an earlier cutter has left are.
    rest: Option<PocketRestJson>,
    retracts: usize,
    cutting_length: f64,
    link_length: f64,
    /// Length that no path of this engagement can be shorter than.
    least_length: f64,
    area: f64,
    /// Area left to the lap along the wall.
    left_to_lap: f64,
    /// Stretches of the finish whose feed is reduced, if it is to be.
    corner_feed: Option<SlowedJson>,
    /// Inside corners that the cutter does not reach.
    uncut_corners: Vec<PocketCornerJson>,
}

#[derive(Debug, Serialize)]
struct PocketRestJson {
    /// Diameter of the earlier cutter.
    earlier_diameter: f64,
    /// Places that passes clear.
    places: usize,
    /// Places that are left to the lap along the wall.
    places_to_lap: usize,
}

#[derive(Debug, Serialize)]
struct PocketCornerJson {
    at: [f64; 2],
    /// None where the cutter does not go between two loops.
    thickness: Option<f64>,
}

impl PocketJson {
    /// Of a plan and the number of its operation.
    pub(crate) fn new(plan: &PlannedPocket, operation: u32) -> PocketJson {
        let (spec, f) = (&plan.spec, &plan.clearing.figures);
        let corners = plan.wall.uncut.iter();
        PocketJson {
            operation,
            engagement: spec.engagement.to_degrees(),
            largest_engagement: f.largest.to_degrees(),
            levels: plan.clearing.levels.clone(),
            feed: spec.feed * 60.0,
            plunge_feed: spec.plunge_feed * 60.0,
            link_feed: spec.link_feed * 60.0,
            passes: f.passes,
            entries: f.entries,
            ramps: f.ramps,
            plunges: f.plunges,
            entry_engagement: (f.entries > 0).then_some(f.entry.to_degrees()),
            rest: spec.rest.zip(f.rest).map(|(earlier, rest)| PocketRestJson {
                earlier_diameter: 2.0 * earlier.radius,
                places: rest.places,
                places_to_lap: rest.to_lap,
            }),
            retracts: f.retracts,
            cutting_length: f.cutting,
            link_length: f.links,
            least_length: f.bound,
            area: f.area,
            left_to_lap: f.left,
            corner_feed: plan
                .wall
                .slowed
                .as_ref()
                .zip(plan.lap.finish)
                .map(|(slowed, finish)| SlowedJson::new(slowed, finish.feed)),
            uncut_corners: corners
                .map(|c| PocketCornerJson { at: c.at.to_array(), thickness: c.thickness })
                .collect(),
        }
    }
}
