//! Drilled holes: ways, engagement, feed zones, jobs.

mod engagement;
mod golden;
mod job;
mod properties;
mod ways;
