//! A pocket in the planner's words.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geom::Outline;
use crate::holes::{CutterData, Sense};

/// The way down into a pocket where no side is open and no hole is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PocketEntry {
    /// The first of the others that has room.
    #[default]
    Fitting,
    /// On a helix.
    Helix,
    /// To and fro along the line in the middle of the walls.
    Ramp,
    /// Straight down, with a cutter that cuts at its centre.
    Plunge,
}

/// A larger cutter that has cleared the same face, at least as deep [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarlierCutter {
    /// Its radius.
    pub radius: f64,
    /// Radius of its corner: at the floor it has cut that much less.
    pub corner: f64,
    /// Stock that it has left on the wall.
    pub allowance: f64,
}

/// A pocket to be cleared [mm, mm/s, rad].
#[derive(Clone, Debug, PartialEq)]
pub struct PocketSpec {
    /// The face that is cleared, in coordinates of the work offset; its holes are islands that stay.
    pub outline: Outline,
    /// Outline of the stock; `None`: stock everywhere. A pocket that reaches over it is open there.
    pub stock: Option<Outline>,
    /// Round holes that are open down to the lowest level already: centre and radius.
    pub holes: Vec<(DVec2, f64)>,
    /// The cutter that has cleared it before: only what that one has left is cleared. `None`: all of it.
    pub rest: Option<EarlierCutter>,
    /// The cutter.
    pub cutter: CutterData,
    /// Whether the spindle turns counter-clockwise: climb and conventional change sides.
    pub left_hand: bool,
    /// Climb or conventional.
    pub sense: Sense,
    /// Largest engagement.
    pub engagement: f64,
    /// Height of the material's upper face.
    pub top: f64,
    /// Depth below it.
    pub depth: f64,
    /// Depth that the cutter goes below `depth`, for a pocket that goes through.
    pub breakthrough: f64,
    /// Largest depth of a level; `None`: the length of the flutes.
    pub stepdown: Option<f64>,
    /// Stock left on the wall.
    pub allowance: f64,
    /// Feed of the cutter's centre.
    pub feed: f64,
    /// Feed down along helices and ramps, and straight down to cleared places.
    pub plunge_feed: f64,
    /// Feed through what is cleared.
    pub link_feed: f64,
    /// The way down.
    pub entry: PocketEntry,
    /// Angle of the helix or ramp by which the cutter enters.
    pub ramp: f64,
    /// Radius of the way of the cutter's centre on that helix; `None`: 0.8 of the cutter's radius.
    pub helix_radius: Option<f64>,
    /// Height of links over the floor of a level.
    pub lift: f64,
    /// Height of the moves over the part.
    pub retract_z: f64,
    /// Height at which rapids down end.
    pub approach_z: f64,
}

impl PocketSpec {
    /// A pocket with usual values at a feed [mm/s]: an engagement of 60 degrees, a helix of 3 degrees, nothing left.
    pub fn new(outline: Outline, depth: f64, cutter: CutterData, feed: f64) -> PocketSpec {
        PocketSpec {
            outline,
            stock: None,
            holes: Vec::new(),
            rest: None,
            cutter,
            left_hand: false,
            sense: Sense::Climb,
            engagement: 60.0_f64.to_radians(),
            top: 0.0,
            depth,
            breakthrough: 0.0,
            stepdown: None,
            allowance: 0.0,
            feed,
            plunge_feed: 0.5 * feed,
            link_feed: 2.0 * feed,
            entry: PocketEntry::default(),
            ramp: 3.0_f64.to_radians(),
            helix_radius: None,
            lift: 0.2,
            retract_z: 20.0,
            approach_z: 2.0,
        }
    }

    /// Radius of the cutter [mm].
    pub fn radius(&self) -> f64 {
        0.5 * self.cutter.diameter
    }

    /// Height of the lowest level [mm].
    pub fn bottom(&self) -> f64 {
        self.top - self.depth - self.breakthrough
    }

    /// Whether passes leave the stock on the right of the travel.
    pub fn keeps_right(&self) -> bool {
        (self.sense == Sense::Climb) != self.left_hand
    }
}
