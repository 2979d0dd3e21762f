//! The best placement of one straight pass, with a certificate.
pub(crate) mod domain;
mod least;
mod lines;
mod options;
mod polish;
mod result;
mod search;
mod straight;
mod sweep;
pub use least::least_burr;
pub use options::Options;
pub use result::{Irreducible, LocalMinimum, Optimum, Sensitivity};
