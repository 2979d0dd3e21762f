//! Stretches of a finish whose feed is reduced in inside corners, as report and plan have them.

use serde::Serialize;

use crate::contouring::SlowedFeed;
use crate::page::{Fact, fixed, trimmed};

/// The stretches, over one lap of all loops; lengths [mm].
#[derive(Debug, Serialize)]
pub(crate) struct SlowedJson {
    length: f64,
    /// Smallest feed on them, mm/min; none without any.
    least_feed: Option<f64>,
    /// Largest chip at the planned places, over that along a straight wall.
    thickest_chip: f64,
}

impl SlowedJson {
    /// Of a finish at a feed [mm/s].
    pub(crate) fn new(slowed: &SlowedFeed, feed: f64) -> SlowedJson {
        let least_feed = (slowed.length > 0.0).then_some(slowed.least * feed * 60.0);
        SlowedJson { length: slowed.length, least_feed, thickest_chip: slowed.thickest }
    }
}

/// The fact of a report; `feed`: that of the finish [mm/s].
pub(crate) fn fact(slowed: &SlowedFeed, feed: f64) -> Fact {
    const TITLE: &str = "Feed in inside corners";
    if slowed.length == 0.0 {
        return Fact::new(TITLE, "as given")
            .note("the chip is at most 1 % thicker than along a straight wall");
    }
    let chip = format!("the largest chip is {} of that along a straight wall", fixed(slowed.thickest, 2));
    let value = format!("{} mm/min at least", trimmed(slowed.least * feed * 60.0, 1));
    Fact::new(TITLE, value).note(format!("over {} mm of a lap; {chip}", trimmed(slowed.length, 1)))
}
