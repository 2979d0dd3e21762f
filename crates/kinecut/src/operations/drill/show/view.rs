//! A planned hole as the report takes it.

use crate::base::Finding;
use crate::drilling::{DrillPlan, DrillSpec, PaperResult};

/// A drilled hole to show.
#[derive(Clone, Copy, Debug)]
pub struct DrilledHole<'a> {
    /// Heading; may come from outside.
    pub title: &'a str,
    /// Its place on the part [mm]; `None` for a case without a part.
    pub at: Option<[f64; 3]>,
    /// Hole that was asked for.
    pub spec: &'a DrillSpec,
    /// Plan of the hole.
    pub plan: &'a DrillPlan,
    /// Result of the paper's formulas, if it is to be shown.
    pub paper: Option<&'a PaperResult>,
    /// Share of the point in material as simulated: Z of the reference point [mm], falling, and share.
    pub simulated: &'a [[f64; 2]],
    /// Time of the program [s] when the drill starts at feed.
    pub starts_at: Option<f64>,
}

impl<'a> DrilledHole<'a> {
    /// A hole with nothing beyond its plan.
    pub fn new(title: &'a str, spec: &'a DrillSpec, plan: &'a DrillPlan) -> DrilledHole<'a> {
        DrilledHole { title, at: None, spec, plan, paper: None, simulated: &[], starts_at: None }
    }
}

/// A hole that could not be planned.
#[derive(Clone, Debug, PartialEq)]
pub struct RefusedHole {
    /// Heading; may come from outside.
    pub title: String,
    /// Its wanted place on the part [mm].
    pub at: Option<[f64; 3]>,
    /// Why not.
    pub finding: Finding,
}
