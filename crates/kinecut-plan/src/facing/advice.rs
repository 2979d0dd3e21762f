//! What a person should know of a planned face.

use super::FacePlan;
use super::optimum::Options;
use crate::base::{Code, Finding};

/// What is worth saying of a plan.
pub(super) fn advice(plan: &FacePlan, options: &Options) -> Vec<Finding> {
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
