//! The plan that is wanted of a face.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::FaceCase;
use super::optimum::Options;
use crate::base::unit::Deg;

/// The wanted place of the part under the cutter [mm, rad]; in a file degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PlacementChoice {
    /// The certified optimum of one straight pass; of rows the best direction found.
    #[default]
    LeastBurr,
    /// Not turned, the cutter over the middle.
    AsDrawn,
    /// As given.
    #[serde(untagged)]
    Given {
        /// Angle by which the part is turned under the feed, counter-clockwise; degrees in a file.
        #[serde(with = "Deg")]
        #[schemars(example = 15)]
        angle: f64,
        /// Ordinate of the line of the cutter's centre in coordinates of the work offset, the part turned about its zero;
        /// default: over the middle of the part.
        #[serde(default)]
        offset: Option<f64>,
    },
}

/// The wanted passes of a face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PassesChoice {
    /// One straight pass.
    #[default]
    One,
    /// One straight pass, or where the part is too wide for it as few rows as cover it.
    Fewest,
    /// This many parallel rows, their offsets and directions optimised.
    Rows(#[schemars(example = 3)] u32),
    /// Along the outline, the cutter's centre this far outside the edge [mm] (negative: inside), then rings inwards.
    Frames(#[schemars(example = 20)] f64),
    /// The way with the least bad length; the faster of two equal ones.
    LeastBurr,
    /// The fastest way.
    Fastest,
}

/// The specification of a face to mill.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceSpec {
    /// Outline, weights, cutter, bad exit angles without guard, as the part lies.
    pub case: FaceCase,
    /// The spindle turns counter-clockwise (M4).
    pub left_hand: bool,
    /// Exit angles this near to a bad one count as bad [rad].
    pub guard: f64,
    /// Constraints of the placement, as the part lies.
    pub options: Options,
    /// Placement of one straight pass, and direction of rows.
    pub placement: PlacementChoice,
    /// Passes.
    pub passes: PassesChoice,
    /// Feed [mm/s].
    pub feed: f64,
    /// Speed of links between passes [mm/s].
    pub rapid: f64,
    /// Distance between cutter and part where a pass begins and ends [mm].
    pub clearance: f64,
    /// Other ways than the one chosen are planned too, for their price.
    pub compare: bool,
}
