//! The time of a program on a machine.

mod axis_limits;
mod joint;
mod joints;
mod run;
mod straight;
mod times;

pub use axis_limits::axis_limits;
pub use times::{ProgramTime, Smoothing, program_time};
