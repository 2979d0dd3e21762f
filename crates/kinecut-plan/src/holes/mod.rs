//! Planning of milled bores: entry, clearing by spirals and other strategies, lead-in and lead-out, levels, engagement.
//!
//! For the process engineer (a job's `bore` operation) and the CAM developer (each step is callable alone).
//! Method: Sorokin, But, Kombarov 2013, with the misprints of the paper corrected; every path is a chain of
//! exact curves, none is ever turned into chords here.

mod check;
pub mod clearing;
pub mod compare;
mod ellipse;
pub mod engagement;
pub mod entry;
mod figures;
mod finish;
mod finish_lead;
mod helix;
pub mod lead;
pub mod lead_in;
pub mod lens_lead;
pub mod levels;
mod plan;
mod ramp;
pub mod roll;
mod rough;
pub(crate) mod route;
mod spec;
pub mod spiral;
mod strategy;
#[cfg(test)]
mod tests;
mod toolpath;
mod wear;

pub use ellipse::{EllipsePlan, EllipseSpec, plan_ellipse};
pub use engagement::{EngagementSample, engagement, engagement_formula};
pub use entry::{EntryMethod, EntryRow};
pub use figures::{PassFigures, Slug};
pub use lens_lead::{LensLead, lens_lead_in};
pub use levels::path_radius;
pub use plan::{BorePlan, plan_bore};
pub use spec::{BoreSpec, CutterData, Entry, FeedAt, Finish, LeadEnd, Rough, Sense, Wear};
pub use strategy::Strategy;
pub use toolpath::{PlannedMove, ToolpathPace, ToolpathRole};
