//! The time of a program on a machine.

mod axis_limits;
mod changes;
mod facets;
mod gathering;
mod held;
mod joint;
mod joints;
mod junction;
mod law;
mod leg;
mod level;
mod limit_met;
mod linuxcnc;
mod motion;
mod passing;
mod program_time;
mod ramp;
mod run;
mod sampler;
mod samples;
mod setting;
mod smoothed_joint;
mod straight;
mod stretch;
mod swing;
mod times;
mod waits;

pub use axis_limits::axis_limits;
pub use facets::{Facets, facets};
pub use held::{AxisBound, FeedBeyond, feeds_beyond};
pub use limit_met::LimitMet;
pub use motion::AxisMoment;
pub use program_time::{Changes, ProgramTime, Smoothing};
pub use samples::{
    FinerSamples, MotionSample, SampledMotion, program_samples, program_samples_finer, sample_count,
};
pub use smoothed_joint::SmoothedJoint;
pub use times::program_time;
