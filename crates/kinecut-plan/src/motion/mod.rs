//! Time along a path under the limits of a machine.
//!
//! - [`SCurve`]: a straight move from rest to rest, in closed form.
//! - [`TimeLaw`]: the fastest run along a [`Course`] under velocity, acceleration and jerk of each axis.
//! - [`feed_parts`](fn@feed_parts): a curve with feeds that the axes can hold; [`feeds_beyond`]: where they cannot.
//! - [`Servo`]: what position loops make of a motion.

mod axis_limit;
mod course;
mod easing;
mod end;
mod feed_parts;
mod grid;
mod interior;
mod law;
mod pentadiagonal;
mod program;
mod reach;
mod s_curve;
mod servo;
mod shape;
mod shares;
mod solution;
mod speed;
mod spline;
mod start;
mod station;
#[cfg(test)]
mod test_courses;
mod windows;

pub use axis_limit::AxisLimit;
pub use course::Course;
pub use end::End;
pub use feed_parts::{FeedPart, feed_parts, lowered};
pub use law::TimeLaw;
pub use program::{
    AxisBound, AxisMoment, Changes, Facets, FeedBeyond, FinerSamples, LimitMet, MotionSample, ProgramTime,
    SampledMotion, SmoothedJoint, Smoothing, axis_limits, facets, feeds_beyond, program_samples,
    program_samples_finer, program_time, sample_count,
};
pub use reach::WithoutJerk;
pub use s_curve::{Moment, SCurve};
pub use servo::{Followed, Following, Servo};
pub use shares::Shares;
pub use speed::Speed;
pub use station::{PathByLength, Station};
