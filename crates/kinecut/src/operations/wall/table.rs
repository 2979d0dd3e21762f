//! Words that the tables of milled walls share beside the planner's own: finishing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::unit::MmPerMin;
use crate::geom::LensOrder;
use crate::holes::FeedAt;

/// Finishing of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FinishTable {
    /// Turns that the lead-in's involute would have from the centre; default 2.
    #[serde(default)]
    pub turns: Option<u32>,
    /// Contact of the lead-in with the wall; default G2, with the shortest sliver.
    #[serde(default)]
    pub contact: ContactName,
    /// Feed; mm/min in a file.
    #[serde(with = "MmPerMin")]
    pub feed: f64,
    /// Whether the feed is that of the cutter's centre or that of its edge at the wall; default centre.
    #[serde(default)]
    pub feed_at: FeedAt,
    /// Point at which the lead-in starts, in coordinates of the work offset; default: half a turn before the wall.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-in starts.
    #[serde(default)]
    pub start_radius: Option<f64>,
    /// Length of the lead-in.
    #[serde(default)]
    pub start_length: Option<f64>,
    /// Point at which the lead-out ends, in coordinates of the work offset; default: the mirror image of the lead-in's.
    #[serde(default)]
    pub end: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-out ends.
    #[serde(default)]
    pub end_radius: Option<f64>,
    /// Length of the lead-out.
    #[serde(default)]
    pub end_length: Option<f64>,
    /// Further circles at the wall without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Register of the control by whose value the wall is moved at the machine: "D2".
    #[serde(default)]
    pub wear_offset: Option<String>,
    /// Largest value, of either sign, that the register may get; default 0.1.
    #[serde(default)]
    pub wear_largest: Option<f64>,
    /// Value of the register with which the program is simulated; default 0.
    #[serde(default)]
    pub wear_value: Option<f64>,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
}

/// Contact of a lead with the wall: how many derivatives agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactName {
    /// Curvature: a circle involute.
    #[default]
    G2,
    /// To the fourth derivative: a lens involute of order 1.
    G4,
    /// To the sixth: order 2.
    G6,
}

impl ContactName {
    /// The order of a lens with this contact.
    pub(crate) fn order(self) -> LensOrder {
        match self {
            ContactName::G2 => LensOrder::Zero,
            ContactName::G4 => LensOrder::One,
            ContactName::G6 => LensOrder::Two,
        }
    }
}
