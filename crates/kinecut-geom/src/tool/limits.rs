//! Limits of a tool: the sense in which it turns, its speed and its feed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The sense in which a tool must turn to cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Hand {
    /// Clockwise, seen from the spindle: `M3`.
    #[default]
    Right,
    /// Counter-clockwise, seen from the spindle: `M4`.
    Left,
}

/// Limits of a tool: the sense in which it turns, its speed and its feed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolLimits {
    /// The sense in which it cuts.
    pub hand: Hand,
    /// Largest speed of the spindle [rad/s], if it is known.
    pub max_speed: Option<f64>,
    /// Largest feed [mm/s], if it is known.
    pub max_feed: Option<f64>,
}
