//! Planner of face milling: where the teeth leave the edges of a face, at which exit angle, and the placement and
//! passes that leave the least burr.
//!
//! Source: Kryzhanivskyi and Kryzhanivska 2011, corrected and taken further: the limit of many teeth in closed form,
//! exact arcs, a global optimum with its certificate, passes of any form.
//!
//! # Frames and signs
//! *Machine frame*: the part is at rest, the cutter centre moves along +x at the ordinate `c`, the spindle turns
//! clockwise seen from +z (M3). *Placement*: the part is turned counter-clockwise by `angle`; `offset` is the
//! ordinate of the centre line in the turned part's frame. *Outline*: material on the right of the direction of
//! travel. *Exit angle*: from the edge's direction to the tooth's velocity, counter-clockwise; a tooth leaves where it
//! lies between 0 and pi. An M4 spindle is the mirror image ([`FaceCase::mirrored`]).

mod bad_set;
pub mod burrs;
mod case;
mod exit_order;
mod exits;
mod level;
mod limit;
mod nelder_mead;
mod objective;
pub mod optimum;
pub mod passes;
mod plan;
mod spec;
mod survey;
mod teeth;
mod threshold;
mod way;
mod ways;

pub use bad_set::{BadPart, BadSet};
pub use case::{FaceCase, Placement};
pub use exit_order::{CornerExit, InsertCorner, exit_order};
pub use exits::{ExitStretch, exit_stretches, largest_exit_angle};
pub use limit::{BadStretch, Sweep, bad_length, bad_stretches, either_bad_length};
pub use nelder_mead::{
    DescentStatistics, NelderMead, SimplexCorner, SimplexDescent, SimplexStep, descend, descend_steps,
    descents, random_placements,
};
pub use objective::Objective;
pub use plan::{FacePlan, plan_face};
pub use spec::{FaceSpec, PassesChoice, PlacementChoice};
pub use survey::{
    CutterPosition, OffsetRule, PictureCrossing, PlacementPicture, SurveyPoint, pictures, survey,
};
pub use teeth::{Tooth, ToothCrossing, ToothedLengths, ToothedPass, toothed_lengths};
pub use threshold::Thresholds;
pub use way::MillingWay;
