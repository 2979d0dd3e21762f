//! The planned operations of a kind.

use kinecut::job::SetupPlan;
use kinecut::operations::OperationPlan;
use kinecut::operations::drill::PlannedDrilling;
use kinecut::operations::face::PlannedFace;

/// The drillings of a setup, in order.
pub(crate) fn drillings(planned: &SetupPlan) -> Vec<&PlannedDrilling> {
    let plans = planned.operations.iter().map(|o| &o.plan);
    plans
        .filter_map(|plan| if let OperationPlan::Drill(drilling) = plan { Some(&**drilling) } else { None })
        .collect()
}

/// The milled faces of a setup, in order.
pub(crate) fn faces(planned: &SetupPlan) -> Vec<&PlannedFace> {
    let plans = planned.operations.iter().map(|o| &o.plan);
    plans.filter_map(|plan| if let OperationPlan::Face(face) = plan { Some(&**face) } else { None }).collect()
}
