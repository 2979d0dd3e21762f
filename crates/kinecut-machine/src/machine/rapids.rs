//! Rapid moves of a machine.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Path of a rapid move of several axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rapids {
    /// On the straight line: all axes arrive together (FANUC parameter 1401 bit 1 set, SINUMERIK RTLION).
    Straight,
    /// Each axis at its own speed until it has arrived: first across, then along the axis with the longest way.
    AxisByAxis,
}
