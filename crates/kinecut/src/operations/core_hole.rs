//! Core holes of threads: those that a table states, and those that are there when the operation begins.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RoundHole;

/// Distance within which two holes are about one axis [mm].
const SAME_PLACE: f64 = 0.01;
/// Heights that are the same [mm]: the rounding of posted heights is not known yet.
pub(crate) const SAME_HEIGHT: f64 = 1e-6;

/// The core hole of a thread, in coordinates of the work offset [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Core {
    /// Diameter.
    pub diameter: f64,
    /// Lowest height at which it has its diameter all round.
    pub bottom: f64,
    /// Whether it is open below.
    pub through: bool,
}

/// A core hole that is there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CoreTable {
    /// Diameter.
    #[schemars(example = 6.8)]
    pub diameter: f64,
    /// Depth below `top` to which it has its diameter; default: through.
    #[serde(default)]
    pub depth: Option<f64>,
}

impl Core {
    /// The hole that is there for a thread at a place, which begins at a height and has a pitch: the one that is stated, or the
    /// widest that reaches into the thread.
    pub(crate) fn find(
        stated: Option<CoreTable>,
        at: [f64; 2],
        [top, pitch]: [f64; 2],
        holes: &[RoundHole],
    ) -> Option<Core> {
        if let Some(core) = stated {
            let bottom = top - core.depth.unwrap_or(0.0);
            return Some(Core { diameter: core.diameter, bottom, through: core.depth.is_none() });
        }
        let here = |h: &&RoundHole| {
            h.centre.distance(DVec2::from_array(at)) <= SAME_PLACE
                && h.bottom < top - SAME_HEIGHT
                && h.top >= top - pitch
        };
        let widest = holes.iter().filter(here).max_by(|a, b| a.diameter.total_cmp(&b.diameter))?;
        Some(Core { diameter: widest.diameter, bottom: widest.bottom, through: widest.through })
    }
}
