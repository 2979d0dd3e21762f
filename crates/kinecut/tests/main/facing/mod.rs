//! Faces: least burr, bounds, passes, jobs.

mod bounds;
mod burrs;
mod crossings;
mod golden;
mod golden_events;
mod golden_optimum;
mod job;
mod passes;
mod survey;
