//! A constant twist from a pose.

use glam::{DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::number::{angle, place};
use super::pose::rows;
use crate::base::Result;
use crate::base::unit::Deg;
use crate::geom::Rigid;
use crate::machine::Twist;
use crate::sweep::{ToolMotion, twist_of};

/// A constant twist in coordinates of the tool, from a pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScrewMove {
    /// The pose at the start, tool to workpiece: rows of the matrix [R p], or of [R p; 0 1]; default: the tip at the zero,
    /// the tool upright.
    #[serde(default)]
    pub pose: Option<Vec<Vec<f64>>>,
    /// Velocity of the point `at` in coordinates of the tool, mm over the whole move.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Turning about X, Y, Z of the tool over the whole move, degrees in a file.
    #[serde(default, with = "Deg::<[f64; 3]>")]
    pub turn: [f64; 3],
    /// The point whose velocity is given, mm; default: the origin.
    #[serde(default)]
    pub at: [f64; 3],
}

impl ScrewMove {
    /// The pose at the start, and the twist over the whole move [mm, rad].
    ///
    /// # Errors
    /// `KC0103` for numbers out of all measure, `KC0102` and `KC1202` for a pose that is not rigid, with their keys.
    pub fn start_and_twist(&self) -> Result<(Rigid, Twist)> {
        let start = match &self.pose {
            None => Rigid::IDENTITY,
            Some(given) => {
                let (rotation, translation) = rows("pose", given, 1.0)?;
                place("pose", translation.to_array())?;
                let pose = Rigid { rotation, translation };
                // A rate of nothing leaves the check of the matrix.
                twist_of(&pose, DMat3::ZERO, DVec3::ZERO).map_err(|e| e.under("pose"))?;
                pose
            }
        };
        for (i, &turn) in self.turn.iter().enumerate() {
            angle(&format!("turn[{i}]"), turn)?;
        }
        let (turn, velocity) = (DVec3::from(self.turn), place("velocity", self.velocity)?);
        Ok((start, Twist { turn, shift: velocity - turn.cross(place("at", self.at)?) }))
    }

    /// The motion.
    ///
    /// # Errors
    /// As [`ScrewMove::start_and_twist`] and [`ToolMotion::screw`].
    pub fn motion(&self) -> Result<ToolMotion> {
        let (start, twist) = self.start_and_twist()?;
        ToolMotion::screw(start, twist)
    }
}
