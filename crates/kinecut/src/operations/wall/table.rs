//! Words that the tables of milled walls share beside the planner's own: finishing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::WearKeys;
use crate::base::unit::{Deg, MmPerMin};
use crate::base::{Code, Finding, Result};
use crate::geom::LensOrder;
use crate::holes::{FeedAt, Finish, LeadEnd};

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
    #[schemars(example = 500)]
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
    /// Radius of curvature with which the lead-in starts; at the wall it is that of the path there.
    #[serde(default)]
    pub start_curvature_radius: Option<f64>,
    /// Direction from the bore's centre in which the lead-in touches the wall, counter-clockwise from X, degrees; default
    /// -90. Not with a `start` off the centre, which fixes it.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub touch_angle: Option<f64>,
    /// Point at which the lead-out ends, in coordinates of the work offset; default: the mirror image of the lead-in's.
    #[serde(default)]
    pub end: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-out ends.
    #[serde(default)]
    pub end_radius: Option<f64>,
    /// Length of the lead-out.
    #[serde(default)]
    pub end_length: Option<f64>,
    /// Radius of curvature with which the lead-out ends.
    #[serde(default)]
    pub end_curvature_radius: Option<f64>,
    /// Direction from the bore's centre in which the lead-out leaves the wall, degrees; default: where the lead-in touches
    /// it.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub end_touch_angle: Option<f64>,
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

impl FinishTable {
    /// The finishing in the planner's words.
    ///
    /// # Errors
    /// `KC0102` for keys that exclude each other, `KC0103` for a name that is no wear register.
    pub(crate) fn finish(&self) -> Result<Finish> {
        Ok(Finish {
            turns: self.turns.unwrap_or(2),
            lead: self.contact.order(),
            feed_at: self.feed_at,
            start: lead_end(
                "start",
                self.start,
                [self.start_radius, self.start_length, self.start_curvature_radius],
            )?,
            end: lead_end("end", self.end, [self.end_radius, self.end_length, self.end_curvature_radius])?,
            touch_angle: self.touch_angle,
            end_touch_angle: self.end_touch_angle,
            spring_passes: self.spring_passes,
            wear: self.wear_keys().wear(USUAL_WEAR)?,
            stepdown: self.stepdown,
            ..Finish::new(self.feed)
        })
    }

    /// The keys of its wear register.
    pub(crate) fn wear_keys(&self) -> WearKeys<'_> {
        WearKeys {
            register: self.wear_offset.as_deref(),
            largest: self.wear_largest,
            value: self.wear_value,
            full: false,
        }
    }
}

/// The one form that is given of a lead's free end: a point, or a radius, a length, a radius of curvature.
fn lead_end(key: &str, point: Option<[f64; 2]>, numbers: [Option<f64>; 3]) -> Result<LeadEnd> {
    let [radius, length, curvature] = numbers;
    let forms = [
        point.map(LeadEnd::Point),
        radius.map(LeadEnd::Radius),
        length.map(LeadEnd::Length),
        curvature.map(LeadEnd::CurvatureRadius),
    ];
    let mut given = forms.into_iter().flatten();
    match (given.next(), given.next()) {
        (None, _) => Ok(LeadEnd::Usual),
        (Some(one), None) => Ok(one),
        _ => Err(Finding::error(
            Code::JOB_SHAPE,
            format!(
                "`{key}`, `{key}_radius`, `{key}_length` and `{key}_curvature_radius` exclude each other"
            ),
        )
        .help("give one of them, or none")
        .key(key)
        .into()),
    }
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

/// Largest wear that a register may get when the job says nothing [mm].
const USUAL_WEAR: f64 = 0.1;
