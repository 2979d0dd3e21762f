//! A face planned: the certified placement of one straight pass, all other ways with their price, and the way chosen.

use super::optimum::{Optimum, Options, least_burr};
use super::ways::{Ways, fits, middle};
use super::{FaceCase, FaceSpec, MillingWay, Placement};
use crate::base::{Code, Finding, Progress, Result};

/// A planned face. Cases, ways and placements are as an M3 spindle sees them: for M4 the part in the mirror.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePlan {
    /// The spindle turns counter-clockwise (M4).
    pub left_hand: bool,
    /// Outline, weights, cutter and bad exit angles.
    pub case: FaceCase,
    /// The same with the guard in its bad exit angles: what was optimised.
    pub guarded: FaceCase,
    /// The certified optimum of one straight pass, or the reason why none exists.
    pub optimum: std::result::Result<Optimum, Finding>,
    /// One straight pass as drawn, the cutter over the middle, if the part is not too wide for it.
    pub as_drawn: Option<Placement>,
    /// All ways, by time.
    pub ways: Vec<MillingWay>,
    /// Index of the chosen way.
    pub chosen: usize,
}

/// Plans a face; warnings and notes come with it.
///
/// # Errors
/// `KC1001` for numbers that make no sense, `KC1002` when one straight pass is asked for and the part is too wide,
/// `KC1004` when the passes asked for do not reach the whole face.
pub fn plan_face(spec: &FaceSpec, progress: &dyn Progress) -> Result<(FacePlan, Vec<Finding>)> {
    let case = if spec.left_hand { spec.case.mirrored() } else { spec.case.clone() };
    let guarded = FaceCase { bad: case.bad.guarded(spec.guard), ..case.clone() };
    let options = if spec.left_hand { spec.options.mirrored() } else { spec.options.clone() };
    let optimum = match least_burr(&guarded, &options, progress) {
        Ok(optimum) => Ok(optimum),
        Err(e) if e.code() == Code::FACE_TOO_WIDE => Err(*e.0),
        Err(e) => return Err(e),
    };
    let as_drawn = fits(&case, middle(&case, 0.0), spec.options.margin);
    let all = Ways { spec, options: &options, case: &case, guarded: &guarded, optimum: &optimum };
    let (ways, chosen) = all.all(progress)?;
    let plan = FacePlan { left_hand: spec.left_hand, case, guarded, optimum, as_drawn, ways, chosen };
    let findings = advice(&plan, &options);
    Ok((plan, findings))
}

/// Warnings and notes on a plan.
fn advice(plan: &FacePlan, options: &Options) -> Vec<Finding> {
    let mut found = Vec::new();
    if let Ok(optimum) = &plan.optimum
        && !optimum.complete
    {
        found.push(
            Finding::warning(
                Code::FACE_ADVICE,
                "the search for the best placement was stopped before it was proven best",
            )
            .value_mm(optimum.gap())
            .bound_mm(0.0)
            .help("let it search on, or accept a placement that may be worse than the best by this"),
        );
    }
    if let Ok(optimum) = &plan.optimum
        && plan.ways[plan.chosen].placement() == Some(optimum.placement)
        && optimum.sensitivity.worst > FRAGILE * optimum.value
        && optimum.sensitivity.worst - optimum.value > NOTICEABLE * plan.case.weighted_perimeter()
    {
        found.push(
            Finding::warning(
                Code::FACE_ADVICE,
                format!(
                    "the placement is sensitive: errors of set-up of {} degrees and {} mm can undo much of it",
                    options.set_up_error[0].to_degrees(),
                    options.set_up_error[1]
                ),
            )
            .value_mm(optimum.sensitivity.worst)
            .bound_mm(optimum.value)
            .help("plan with a guard for the angle, or take an alternative that is not on a border"),
        );
    }
    found
}

/// A placement whose bad length grows by more than this factor within the errors of set-up is sensitive.
const FRAGILE: f64 = 1.1;
/// and by more than this share of all edges: parts that keep nearly no burr are not worth the word.
const NOTICEABLE: f64 = 0.02;
