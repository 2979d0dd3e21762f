//! Planner of milled threads, inside a hole or outside of a boss: whole turns of a helix, joined and left on its own slope.
//!
//! The tool is square to the axis while the groove runs at the lead angle, so the flanks of a full-form tool cut more than its
//! section: [`Flank`] has by how much, exactly, and the radius of the path on which the pitch diameter comes out as wanted.
//!
//! # Signs
//! A right-hand thread rises counter-clockwise. *Climb* with a clockwise spindle runs counter-clockwise inside and clockwise
//! outside; from hand and sense follows whether the helix is run upwards ([`ThreadTravel`]).

mod check;
mod cutter;
mod flank;
mod lead;
mod neck;
mod plan;
mod room;
mod size;
mod spec;
mod thread;
mod travel;

pub use cutter::{MillProfile, ThreadCutter};
pub use flank::Flank;
pub use plan::{ThreadPlan, ThreadRun, plan_threads};
pub use size::{ThreadSize, coarse_pitch};
pub use spec::ThreadMillSpec;
pub use thread::{Thread, ThreadForm, ThreadSide};
pub use travel::ThreadTravel;
