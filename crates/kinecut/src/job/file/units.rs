//! The unit of the lengths of a file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::nc::Units;

/// Unit of lengths, and with it of feeds and speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum UnitsName {
    /// mm, mm/min, m/min, m/s2.
    #[default]
    #[serde(rename = "mm")]
    Mm,
    /// Inches, in/min, ft/min, in/s2.
    #[serde(rename = "in")]
    In,
}

impl UnitsName {
    /// The same as the writers of programs know it.
    pub fn units(self) -> Units {
        match self {
            UnitsName::Mm => Units::Millimetres,
            UnitsName::In => Units::Inches,
        }
    }
}
