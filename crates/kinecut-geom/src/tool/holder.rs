//! Tool holders as stacked segments.

use crate::base::{Code, Finding, Result};
use crate::geom::{Element, Profile};

/// One segment of a holder, from below [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HolderSegment {
    /// Height.
    pub height: f64,
    /// Diameter at the lower end.
    pub lower_diameter: f64,
    /// Diameter at the upper end.
    pub upper_diameter: f64,
}

/// A holder: segments from its face upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Holder {
    /// Name.
    pub name: String,
    /// Segments, from below.
    pub segments: Vec<HolderSegment>,
}

impl Holder {
    /// The segments as bodies, with their heights above the tip when the face stands at `stickout` [mm].
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
                if !(ok(s.height) && ok(s.lower_diameter) && ok(s.upper_diameter)) {
                    let name = &self.name;
                    return Err(Finding::error(
                        Code::TOOL_VALUE,
                        format!("a segment of holder `{name}` has no positive size"),
                    )
                    .value_mm(s.height.min(s.lower_diameter).min(s.upper_diameter))
                    .bound_mm(0.0)
                    .into());
                }
                let (r0, r1) = (s.lower_diameter / 2.0, s.upper_diameter.max(s.lower_diameter) / 2.0);
                let body = Profile::new(vec![Element::Cone { z0: 0.0, r0, z1: s.height, r1 }])?;
                z += s.height;
                Ok((body, z - s.height))
            })
            .collect()
    }
}
