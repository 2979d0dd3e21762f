//! Strategies of a bore, by their names in job files.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::clearing::Clearing;
use crate::base::unit::variant_key;
use crate::geom::LensOrder;

/// Path of the cutter in a bore.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Strategy {
    /// Circle involutes: smooth in velocity and acceleration, a small step of jerk at the wall. After a helix or in a
    /// pre-drilled hole from that circle, else from the centre.
    Involute,
    /// Circle involutes between two circles: as `involute`, but never from the centre.
    Annular,
    /// Lens involutes of order 1: the same length, smooth to the second derivative of jerk (contact G4).
    #[serde(rename = "lens-1")]
    Lens1,
    /// Lens involutes of order 2: contact G6.
    #[serde(rename = "lens-2")]
    Lens2,
    /// Spiral that keeps the engagement angle `rough.engagement`, with `rough.stepover` as a cap if it is given; contact G4.
    ConstantEngagement,
    /// Semicircles about two poles: a step of acceleration in every joint.
    #[serde(rename = "arcs-2")]
    Arcs2,
    /// Quarter circles about four poles.
    #[serde(rename = "arcs-4")]
    Arcs4,
    /// Archimedean spiral: meets the wall with a kink.
    Archimedean,
    /// Concentric rings joined by radial lines: the machine stops at each corner.
    Rings,
    /// Concentric rings joined by tangent arcs.
    RingsTangent,
    /// Trochoidal loops along a ring.
    Trochoidal,
    /// Down along a spiral to the wall and back in its plane, level by level: no plunge.
    Ramping,
    /// One helix at the wall with a level foot, for bores smaller than two cutter diameters.
    Helix,
    /// One helix at the wall of a through bore of any size: the core falls out.
    OutlineHelix,
}

impl Strategy {
    /// Name in job files.
    pub fn name(self) -> String {
        variant_key(&self)
    }

    /// The way in which each level is cleared in its plane; `None` for a strategy that comes down along its path.
    pub fn clearing(self) -> Option<Clearing> {
        Some(match self {
            Strategy::Involute | Strategy::Annular => Clearing::Involute,
            Strategy::Lens1 => Clearing::Lens(LensOrder::One),
            Strategy::Lens2 => Clearing::Lens(LensOrder::Two),
            Strategy::ConstantEngagement => Clearing::ConstantEngagement(LensOrder::One),
            Strategy::Arcs2 => Clearing::Poles(2),
            Strategy::Arcs4 => Clearing::Poles(4),
            Strategy::Archimedean => Clearing::Archimedes,
            Strategy::Rings => Clearing::RingsRadial,
            Strategy::RingsTangent => Clearing::RingsTangent,
            Strategy::Trochoidal => Clearing::Trochoid,
            Strategy::Ramping | Strategy::Helix | Strategy::OutlineHelix => return None,
        })
    }
}
