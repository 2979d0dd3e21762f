//! Time along a path under the limits of a machine.
//!
//! [`pointwise`](fn@pointwise): the fastest run along a chain of curves whose limits hold in every point for itself.

mod pointwise;
mod station;

pub use pointwise::{Limits, RunLaw, RunPoint, pointwise};
pub use station::{PathByLength, Station};
