//! The specification of a hole to drill.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{BoundarySurface, Ceiling, CrossBore, DrillMethod, Mouth, Passage, PreHole};
use crate::tool::DrillPoint;

/// A hole to drill; Z in the frame of the entry (W_h), mm, rad, s.
#[derive(Clone, Debug, PartialEq)]
pub struct DrillSpec {
    /// Method by which the hole is made.
    pub method: DrillMethod,
    /// Largest diameter of the tool.
    pub diameter: f64,
    /// Its point.
    pub point: DrillPoint,
    /// The surface it enters.
    pub entry: BoundarySurface,
    /// Distance of the exit's frame W_k below the entry's W_h (L of the paper).
    pub length: f64,
    /// End of the hole.
    pub end: End,
    /// A hole that is there.
    pub pre_hole: Option<PreHole>,
    /// A recess about the axis in the face that it enters; only where that is level.
    pub mouth: Option<Mouth>,
    /// The floor of a hole from the other side, about the same axis, into which it comes out.
    pub ceiling: Option<Ceiling>,
    /// Bores that cross the way.
    pub bores: Vec<CrossBore>,
    /// Angle of the exit's u from the entry's; see [`DrillWay`](super::DrillWay).
    pub exit_turn: f64,
    /// Passages of the hole where they were found in a body; the surfaces above then only serve for advice. `None`:
    /// worked out from those surfaces.
    pub passages: Option<Vec<Passage>>,
    /// Way at feed before the first contact.
    pub approach: f64,
    /// Largest distance of the surfaces from where they are drawn, to either side.
    pub tolerance: f64,
    /// Speed of the spindle.
    pub turning: SpindleSpeed,
    /// Feeds; what is left out is recommended.
    pub feed: FeedChoice,
    /// A bush or pilot hole guides the drill, so that its corner may touch first.
    pub guided: bool,
}

/// End of a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// Through a surface, and on.
    Through {
        /// The surface, in the frame of the entry.
        exit: BoundarySurface,
        /// Way beyond the last of the edge (L_per of the paper).
        overrun: f64,
    },
    /// Blind: the full diameter reaches this depth below the entry's frame everywhere.
    FullDiameter(f64),
    /// A recess: cut to this diameter all round.
    Reached(f64),
    /// The tip goes to this Z.
    Tip(f64),
}

/// Speed of the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleSpeed {
    /// At the largest diameter that cuts [mm/s].
    CuttingSpeed(f64),
    /// Of the spindle [rad/s].
    Spindle(f64),
}

/// Feeds, mm per revolution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FeedChoice {
    /// Going in, mm/rev; default: recommended for the surface.
    #[serde(default)]
    pub entry: Option<f64>,
    /// In full material, mm/rev.
    #[schemars(example = 0.2)]
    pub steady: f64,
    /// Coming out, mm/rev; default: recommended for the surface.
    #[serde(default)]
    pub exit: Option<f64>,
}

impl DrillSpec {
    /// A hole drilled through from one surface to another, with the usual approach and overrun of 2 mm.
    pub fn new(diameter: f64, point: DrillPoint, entry: BoundarySurface, exit: BoundarySurface) -> DrillSpec {
        DrillSpec {
            method: DrillMethod::Drilling,
            diameter,
            point,
            entry,
            length: 0.0,
            end: End::Through { exit, overrun: 2.0 },
            pre_hole: None,
            mouth: None,
            ceiling: None,
            bores: Vec::new(),
            exit_turn: 0.0,
            passages: None,
            approach: 2.0,
            tolerance: 0.0,
            turning: SpindleSpeed::CuttingSpeed(25e3 / 60.0),
            feed: FeedChoice { entry: None, steady: 0.01 * diameter, exit: None },
            guided: false,
        }
    }
}
