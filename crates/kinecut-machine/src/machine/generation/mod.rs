//! Generation of surfaces: can a machine make a surface with a tool, and how large is the deviation from the wanted
//! one.
//!
//! [`can_make`] looks for a way of a machine to move a tool as a surface demands, [`nearest_machines`] for machines
//! that could. [`residual()`] compares traced and copied surfaces with the wanted one, [`ToolEnvelope`] touched and rolled
//! ones, both by signed distances ([`Distance`]); [`coverage()`] measures the reached part of the wanted surface.

mod budget;
mod coverage;
mod distance;
mod envelope;
mod enveloped;
mod feasible;
mod machine_motion;
mod made;
mod residual;
mod sensitivity;
mod touch;

pub use budget::{ErrorBudget, ErrorGain, LinkError, error_budget, error_gain};
pub use coverage::{Coverage, Gap, coverage};
pub use distance::{
    Distance, EdgeLine, ElementaryBody, Hollow, Hyperboloid, InvoluteFlank, Meridian, MeridianPiece,
    ParametricSurface, Placed, Prism, SurfaceMap,
};
pub use envelope::{FrameMotion, Left, LeftOver, ToolEnvelope};
pub use enveloped::{Enveloped, LeftByTool, Touched, envelope_surface};
pub use feasible::{
    Alternative, FeasibleOptions, Hold, JointLaw, LinkedJoints, Nearest, Obstacle, Task, TaskMotion,
    VariableLaw, can_make, nearest_machines,
};
pub use machine_motion::MachineMotion;
pub use made::{Made, hold_of, make_split};
pub use residual::{Residual, SurfaceError, residual};
pub use sensitivity::{AxisEffect, AxisErrors, SurfaceBudget, micro, sensitivity};
