//! Tools: cutters, shanks and holders as stacked profiles of revolution.

mod contour;
mod cutter;
mod dimension;
mod drill_body;
mod drill_point;
mod holder;
mod limits;
mod spacing;
mod tap;
mod thread_mill;

pub use contour::turn;
pub use contour::{
    Apt, Assembly, Contour, ContourElement, ContourFile, ContourRead, ContourShape, DOWN, ElementEntry,
    ElementRole, SectionDrawing, ToolForm, UP,
};
pub use cutter::Cutter;
pub use drill_body::filled;
pub use drill_point::{DrillPoint, StepStage};
pub use holder::{Holder, HolderSegment};
pub use limits::{Hand, ToolLimits};
pub use spacing::ToothSpacing;
pub use tap::{ChamferForm, Tap};
pub use thread_mill::{Neck, ThreadMill};

use crate::base::{Code, CountBound, Finding, Result};
use crate::geom::{Profile, ProfileElement};
use serde::{Deserialize, Serialize};

/// Teeth of a tool: the largest face mills have a hundred; a limit of many teeth needs thousands.
pub const TEETH: CountBound = CountBound {
    what: "teeth",
    most: 9999.0,
    bytes: 100,
    code: Code::TOOL_VALUE,
    help: "write the number of its teeth or inserts around the axis",
};

/// The number under which a control knows a tool (`T1`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ToolNumber(pub u32);

impl std::fmt::Display for ToolNumber {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "T{}", self.0)
    }
}

/// A tool as clamped in the spindle; lengths [mm] from the tip upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Number on the control.
    pub number: ToolNumber,
    /// Name in findings and reports.
    pub name: String,
    /// Shape of the cutting part.
    pub cutter: Cutter,
    /// Number of teeth.
    pub teeth: u32,
    /// Places of its teeth about the axis.
    pub spacing: ToothSpacing,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
    /// Height of the holder's face above the tip.
    pub stickout: f64,
    /// Diameter between flutes and holder.
    pub shank_diameter: f64,
    /// The holder, if it is known.
    pub holder: Option<Holder>,
    /// The cutter cuts at its centre, so that it may plunge.
    pub centre_cutting: bool,
    /// Steepest ramp it may follow [rad], if it is known.
    pub max_ramp_angle: Option<f64>,
    /// Length from the gauge point of the spindle to the tip, if it is known.
    pub gauge_length: Option<f64>,
    /// Limits of its rotation, speed and feed.
    pub limits: ToolLimits,
    /// Modulus of elasticity of flutes and shank (N/mm2), if their material is known.
    pub elasticity: Option<f64>,
}

impl Tool {
    /// Checks that the numbers make a tool.
    ///
    /// # Errors
    /// `KC0701` with the key of the dimension that is not finite, not positive or contradicts another.
    pub fn check(&self) -> Result<()> {
        let fail = |key: &str, what: &str, value: f64, bound: f64| {
            Err(Finding::error(Code::TOOL_VALUE, format!("{}: {what}", self.number))
                .value_mm(value)
                .bound_mm(bound)
                .key(key)
                .into())
        };
        self.cutter.check().map_err(|e| {
            let mut f = *e.0;
            f.message = format!("{}: {}", self.number, f.message);
            f
        })?;
        let positive = |v: f64| v.is_finite() && v > 0.0;
        if !positive(self.flute_length) || self.flute_length < self.cutter.tip_height() {
            return fail(
                "flute_length",
                "the flutes must cover the tip",
                self.flute_length,
                self.cutter.tip_height(),
            );
        }
        if !(self.stickout.is_finite() && self.stickout >= self.flute_length) {
            return fail("stickout", "the stickout must cover the flutes", self.stickout, self.flute_length);
        }
        TEETH.check(f64::from(self.teeth)).map_err(|e| e.under("teeth"))?;
        self.spacing.check(self.teeth, 0.5 * self.cutter.diameter(self.flute_length))?;
        if !positive(self.shank_diameter) {
            return fail("shank_diameter", "the shank needs a positive diameter", self.shank_diameter, 0.0);
        }
        if let Cutter::ThreadMill(mill) = self.cutter {
            mill.check_lengths(self.flute_length, self.stickout, self.shank_diameter).map_err(|mut e| {
                e.0.message = format!("{}: {}", self.number, e.0.message);
                e
            })?;
        }
        if let Some(angle) = self.max_ramp_angle
            && !(angle.is_finite() && angle > 0.0 && angle <= std::f64::consts::FRAC_PI_2)
        {
            return Err(Finding::error(
                Code::TOOL_VALUE,
                format!("{}: the ramp angle is out of range", self.number),
            )
            .value(angle.to_degrees(), "deg")
            .bound(90.0, "deg")
            .key("max_ramp_angle")
            .into());
        }
        if let Some(length) = self.gauge_length
            && !(length.is_finite() && length >= self.stickout)
        {
            return fail("gauge_length", "the gauge length must cover the stickout", length, self.stickout);
        }
        Ok(())
    }

    /// The cutting part, its tip at height 0.
    ///
    /// # Errors
    /// `KC0701` and `KC0801` when the numbers make no body.
    pub fn cutting_profile(&self) -> Result<Profile> {
        self.check()?;
        self.cutter.profile(self.flute_length)
    }

    /// The neck of a thread mill, if it has one.
    fn neck(&self) -> Option<Neck> {
        match self.cutter {
            Cutter::ThreadMill(mill) => mill.neck,
            _ => None,
        }
    }

    /// The shank between flutes and holder with the neck below it, and its height above the tip; `None` when there is no room
    /// for it.
    ///
    /// # Errors
    /// `KC0701` when the numbers make no tool.
    pub fn shank_profile(&self) -> Result<Option<(Profile, f64)>> {
        self.check()?;
        let height = self.stickout - self.flute_length;
        if height <= 0.0 {
            return Ok(None);
        }
        let cylinder = |r: f64, z0: f64, z1: f64| ProfileElement::Cone { z0, r0: r, z1, r1: r };
        let r = self.shank_diameter / 2.0;
        let elements = match self.neck().map(|n| (n.diameter / 2.0, n.top - self.flute_length)) {
            Some((neck, top)) if top >= height => vec![cylinder(neck, 0.0, height)],
            Some((neck, top)) if top > 0.0 => vec![cylinder(neck, 0.0, top), cylinder(r, top, height)],
            _ => vec![cylinder(r, 0.0, height)],
        };
        Ok(Some((Profile::new(elements)?, self.flute_length)))
    }

    /// All parts with their heights above the tip: flutes, shank, holder.
    ///
    /// # Errors
    /// `KC0701` when the numbers make no tool.
    pub fn profiles(&self) -> Result<Vec<(Profile, f64)>> {
        let mut all = vec![(self.cutting_profile()?, 0.0)];
        all.extend(self.shank_profile()?);
        all.extend(self.holder_profiles()?);
        Ok(all)
    }

    /// The holder's segments and their heights above the tip.
    ///
    /// # Errors
    /// `KC0701` when a segment has no positive size.
    pub fn holder_profiles(&self) -> Result<Vec<(Profile, f64)>> {
        match &self.holder {
            Some(holder) => holder.profiles(self.stickout),
            None => Ok(Vec::new()),
        }
    }
}
