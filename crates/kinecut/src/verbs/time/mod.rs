//! The verb `kinecut time`: the time of a program on its machine, where it is lost, and the motion at a control's cycle.

mod columns;
mod graphs;
mod in_order;
mod limits_met;
mod moving;
mod over;
mod page;
mod sample_rows;
mod samples;
mod shares;
mod sheet;
mod slow_block;
mod smoothed_block;
mod timed;
mod ways;

pub use samples::SamplesWritten;
pub use shares::TimeShares;
pub use sheet::{TimeSheet, TimedProgram};
pub use slow_block::SlowBlock;
pub use smoothed_block::SmoothedBlock;
pub use timed::{Timed, time_of_job, time_of_program};
