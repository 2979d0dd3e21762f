//! A face planned: the certified placement of one straight pass, all other ways with their price, and the way chosen.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::advice::advice;
use super::optimum::{Optimum, Options, least_burr};
use super::ways::{Ways, fits, middle};
use super::{FaceCase, Placement, Way};
use crate::base::unit::Deg;
use crate::base::{Code, Finding, Progress, Result};

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
        /// By how much the part is turned under the feed, counter-clockwise; degrees in a file.
        #[serde(with = "Deg")]
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
    /// This many parallel rows, their offsets and directions optimised.
    Rows(u32),
    /// Along the outline, the cutter's centre this far outside the edge [mm] (negative: inside), then rings inwards.
    Frames(f64),
    /// Of all ways the one with the least bad length; the faster of two equal ones.
    LeastBurr,
    /// Of all ways the fastest.
    Fastest,
}

/// What is to be planned.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceSpec {
    /// Outline, weights, cutter, bad exit angles without guard, as the part lies.
    pub case: FaceCase,
    /// Whether the spindle turns counter-clockwise (M4).
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
    /// Whether other ways than the one chosen are planned too, for their price.
    pub compare: bool,
}

/// A planned face. Cases, ways and placements are as an M3 spindle sees them: for M4 the part in the mirror.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePlan {
    /// Whether the spindle turns counter-clockwise.
    pub left_hand: bool,
    /// Outline, weights, cutter and bad exit angles.
    pub case: FaceCase,
    /// The same with the guard in its bad exit angles: what was optimised.
    pub guarded: FaceCase,
    /// The certified optimum of one straight pass; why there is none where there is none.
    pub optimum: std::result::Result<Optimum, Finding>,
    /// One straight pass as drawn, the cutter over the middle, if the part is not too wide for it.
    pub as_drawn: Option<Placement>,
    /// All ways, by time.
    pub ways: Vec<Way>,
    /// Which of them is chosen.
    pub chosen: usize,
}

/// Plans a face; what a person should know of it comes with it.
///
/// # Errors
/// `KC1001` for numbers that make no sense, `KC1002` when one straight pass is asked for and the part is too wide,
/// `KC1004` when the passes asked for do not reach the whole face.
pub fn plan_face(spec: &FaceSpec, progress: &dyn Progress) -> Result<(FacePlan, Vec<Finding>)> {
    let case = if spec.left_hand { spec.case.mirrored() } else { spec.case.clone() };
    let guarded = FaceCase { bad: case.bad.guarded(spec.guard), ..case.clone() };
    let options = if spec.left_hand { spec.options.mirrored() } else { spec.options.clone() };
    let optimum = match least_burr(&guarded, &options, progress) {
        Ok(optimum) => Ok(optimum),
        Err(e) if e.code() == Code::FACE_TOO_WIDE => Err(*e.0),
        Err(e) => return Err(e),
    };
    let as_drawn = fits(&case, middle(&case, 0.0), spec.options.margin);
    let all = Ways { spec, options: &options, case: &case, guarded: &guarded, optimum: &optimum };
    let (ways, chosen) = all.all(progress)?;
    let plan = FacePlan { left_hand: spec.left_hand, case, guarded, optimum, as_drawn, ways, chosen };
    let findings = advice(&plan, &options);
    Ok((plan, findings))
}
