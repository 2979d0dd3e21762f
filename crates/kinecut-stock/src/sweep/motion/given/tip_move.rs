//! A move of the tip with the direction of the tool along it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::TipPath;
use super::number::direction;
use crate::base::Result;
use crate::base::unit::Deg;
use crate::sweep::ToolMotion;

/// A move of the tip: a curve as of `tip`, and the direction of the tool along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TipMove {
    /// Start of the tip, mm.
    #[schemars(example = vec![0, 0, 0])]
    pub from: [f64; 3],
    /// End of a straight line, mm.
    #[serde(default)]
    pub to: Option<[f64; 3]>,
    /// A point of the axis of an arc, mm.
    #[serde(default)]
    pub centre: Option<[f64; 3]>,
    /// Angle of an arc, degrees in a file, right-handed about `about`; two turns of a helix are 720.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub turn: Option<f64>,
    /// Movement along the axis of an arc over the whole of it, mm; default 0.
    #[serde(default)]
    pub rise: Option<f64>,
    /// Direction of the axis of an arc; default [0, 0, 1].
    #[serde(default)]
    pub about: Option<[f64; 3]>,
    /// Direction from the tip to the holder; of any length but zero; default [0, 0, 1].
    #[serde(default)]
    pub axis: Option<[f64; 3]>,
    /// Direction at the end: the tool turns from one to the other in their plane, at a constant rate. Default: it does not
    /// turn.
    #[serde(default)]
    pub axis_to: Option<[f64; 3]>,
}

impl TipMove {
    /// The path of the tip.
    pub fn path(&self) -> TipPath {
        let TipMove { from, to, centre, turn, rise, about, .. } = *self;
        TipPath { from, to, centre, turn, rise, about }
    }

    /// The motion.
    ///
    /// # Errors
    /// As [`TipPath::curve`]; `KC1203` for a direction without length, and for opposite directions; each with its key.
    pub fn motion(&self) -> Result<ToolMotion> {
        let curve = self.path().curve()?;
        let from = direction("axis", self.axis.unwrap_or([0.0, 0.0, 1.0]))?;
        match self.axis_to.map(|to| direction("axis_to", to)).transpose()? {
            None => ToolMotion::fixed(curve, from),
            Some(to) => ToolMotion::between(curve, from, to).map_err(|e| e.under("axis_to")),
        }
    }
}
