//! kinecut plans, posts and proves metal cutting.

/// Version of this library.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

pub mod base;
pub mod geom;
pub mod holes;
pub mod num;
pub mod job;
pub mod machine;
pub mod nc;
pub mod program;
pub mod stock;
pub mod tool;
pub mod trace;
