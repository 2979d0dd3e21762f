//! The motion of a tool at one moment.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::number::FASTEST;
use crate::base::unit::Deg;
use crate::base::{Code, Finding, Result};
use crate::machine::Twist;

/// Seconds of a minute: the border between the shop's units and those inside.
const MINUTE: f64 = 60.0;

/// A twist: the motion of a rigid body at one moment, in coordinates of the tool (origin at Z 0 of its profile, Z from the tip to
/// the holder).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GivenTwist {
    /// Velocity of the point `at`, mm/min.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Turning about X, Y, Z a minute, degrees/min in a file; the spindle's own does not matter.
    #[serde(default, with = "Deg::<[f64; 3]>")]
    pub turn: [f64; 3],
    /// The point whose velocity is given, mm; default: the origin.
    #[serde(default)]
    pub at: [f64; 3],
}

impl GivenTwist {
    /// The twist [mm/s, rad/s].
    ///
    /// # Errors
    /// `KC0103` for numbers that are not finite or out of all measure, with their keys.
    pub fn twist(&self) -> Result<Twist> {
        for (key, v) in [("velocity", self.velocity), ("turn", self.turn), ("at", self.at)] {
            if let Some(i) = v.iter().position(|c| !(c.abs() <= FASTEST)) {
                return Err(Finding::error(
                    Code::JOB_VALUE,
                    "a number of the twist is not finite or out of all measure",
                )
                .value(v[i], "")
                .bound(FASTEST, "")
                .key(format!("{key}[{i}]"))
                .into());
            }
        }
        let turn = DVec3::from(self.turn) / MINUTE;
        let velocity = DVec3::from(self.velocity) / MINUTE;
        Ok(Twist { turn, shift: velocity - turn.cross(DVec3::from(self.at)) })
    }
}
