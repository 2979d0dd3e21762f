//! The time of a program on a machine.

mod axis_limits;
mod joint;
mod joints;
mod junction;
mod law;
mod level;
mod passing;
mod program_time;
mod ramp;
mod run;
mod straight;
mod times;

pub use axis_limits::axis_limits;
pub use program_time::{ProgramTime, Smoothing};
pub use times::program_time;
