//! What a person should know of a planned face.

use super::FacePlan;
use crate::base::{Code, Finding};

/// What is worth saying of a plan.
pub(super) fn advice(plan: &FacePlan) -> Vec<Finding> {
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
            .cure("let it search on, or accept a placement that may be worse than the best by this"),
        );
    }
    found
}
