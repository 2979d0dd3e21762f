//! Tool holders as stacked segments.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::{Code, Finding, Result};
use crate::geom::{Profile, ProfileElement};

/// A segment of a holder [mm].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HolderSegment {
    /// Height.
    #[schemars(example = 30)]
    pub height: f64,
    /// Diameter at the lower end.
    #[schemars(example = 50)]
    pub lower_diameter: f64,
    /// Diameter at the upper end; default: as below.
    #[serde(default)]
    pub upper_diameter: Option<f64>,
}

impl HolderSegment {
    /// Diameter at the upper end [mm].
    pub fn upper(&self) -> f64 {
        self.upper_diameter.unwrap_or(self.lower_diameter)
    }
}

/// A tool holder: segments from its face upwards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Holder {
    /// Name by which tools call it.
    #[schemars(example = &"ER32")]
    pub name: String,
    /// Segments, from the face upwards.
    pub segments: Vec<HolderSegment>,
}

impl Holder {
    /// The segments as bodies, with their heights above the tip when the face is `stickout` above it [mm].
    ///
    /// A segment that narrows upwards is taken as wide as its lower end: seen from the part, from below, both
    /// are the same.
    ///
    /// # Errors
    /// `KC0701` when a segment has no positive size.
    pub fn profiles(&self, stickout: f64) -> Result<Vec<(Profile, f64)>> {
        let mut z = stickout;
        self.segments
            .iter()
            .map(|s| {
                let ok = |v: f64| v.is_finite() && v > 0.0;
                if !(ok(s.height) && ok(s.lower_diameter) && ok(s.upper())) {
                    let name = &self.name;
                    return Err(Finding::error(
                        Code::TOOL_VALUE,
                        format!("a segment of holder `{name}` has no positive size"),
                    )
                    .value_mm(s.height.min(s.lower_diameter).min(s.upper()))
                    .bound_mm(0.0)
                    .into());
                }
                let (r0, r1) = (s.lower_diameter / 2.0, s.upper().max(s.lower_diameter) / 2.0);
                let body = Profile::new(vec![ProfileElement::Cone { z0: 0.0, r0, z1: s.height, r1 }])?;
                z += s.height;
                Ok((body, z - s.height))
            })
            .collect()
    }
}
