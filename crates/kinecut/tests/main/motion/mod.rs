//! The fastest law of a path under velocity, acceleration and jerk of each axis.

mod courses;
mod errors;
mod facets;
mod feeds;
mod linuxcnc;
mod metamorphic;
mod program;
mod random;
mod samples;
mod spirals;
mod straight;
