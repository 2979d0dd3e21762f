//! Methods of drilling: the method decides which points, pre-holes and ends make sense.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::{Code, Finding, Result};
use crate::tool::DrillPoint;

/// Method by which a hole is made.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum DrillMethod {
    /// Into the solid, or opening out a smaller hole.
    #[default]
    Drilling,
    /// A centre hole or a spot for the drill that follows.
    Centring,
    /// Opening out a cast or drilled hole with a core drill.
    CoreDrilling,
    /// A conical recess at the mouth of a hole.
    Countersinking,
    /// A flat recess at the mouth of a hole.
    Counterboring,
    /// Bringing a hole to size.
    Reaming,
    /// Several diameters in one go.
    StepDrilling,
}

impl DrillMethod {
    /// The word shown.
    pub fn word(self) -> &'static str {
        match self {
            DrillMethod::Drilling => "drilling",
            DrillMethod::Centring => "centring",
            DrillMethod::CoreDrilling => "core drilling",
            DrillMethod::Countersinking => "countersinking",
            DrillMethod::Counterboring => "counterboring",
            DrillMethod::Reaming => "reaming",
            DrillMethod::StepDrilling => "step drilling",
        }
    }

    /// True if a hole must be there already.
    pub fn needs_hole(self) -> bool {
        matches!(self, DrillMethod::CoreDrilling | DrillMethod::Reaming)
    }

    /// Checks that point and hole go with the method: `hole` is the diameter of a hole that is there [mm].
    ///
    /// # Errors
    /// `KC0901` with the key of what does not.
    pub fn check(self, point: &DrillPoint, diameter: f64, hole: Option<f64>) -> Result<()> {
        let word = self.word();
        let fail = |key: &str, what: String, help: &str| -> Result<()> {
            Err(Finding::error(Code::DRILL_CASE, what).help(help).key(key).into())
        };
        if let Some(hole) = hole
            && !(hole > 0.0 && hole < diameter)
        {
            return Err(Finding::error(
                Code::DRILL_CASE,
                "the hole that is there must be positive and smaller than the tool",
            )
            .value_mm(hole)
            .bound_mm(if hole > 0.0 { diameter } else { 0.0 })
            .key("pre_hole.diameter")
            .into());
        }
        if self.needs_hole() && hole.is_none() {
            let help = "give pre_hole = { diameter = .. }";
            return fail("pre_hole", format!("{word} needs a hole that is there"), help);
        }
        let fits = match self {
            DrillMethod::Countersinking => matches!(point, DrillPoint::Cone { .. }),
            DrillMethod::Counterboring => matches!(point, DrillPoint::Flat | DrillPoint::Annular { .. }),
            DrillMethod::StepDrilling => point.is_stepped(),
            DrillMethod::CoreDrilling | DrillMethod::Reaming => !matches!(
                point,
                DrillPoint::Annular { .. } | DrillPoint::Cannon { .. } | DrillPoint::Gun { .. }
            ),
            DrillMethod::Drilling => {
                !matches!(point, DrillPoint::Cone { nose, .. } if hole.is_none() && *nose > 0.0)
            }
            DrillMethod::Centring => true,
        };
        if !fits {
            let what = format!("a {} is no tool for {word}", point.name());
            return fail("method", what, "choose another point or another method");
        }
        // The nose does not cut: it must find its hole.
        if let (DrillPoint::Cone { nose, .. }, Some(hole)) = (point, hole)
            && *nose > hole
        {
            return Err(Finding::error(
                Code::DRILL_CASE,
                "the nose of the tool does not fit into the hole that is there",
            )
            .value_mm(*nose)
            .bound_mm(hole)
            .key("pre_hole.diameter")
            .into());
        }
        Ok(())
    }
}
