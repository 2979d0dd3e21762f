//! kinecut plans, posts and proves metal cutting.

pub mod base;
pub mod geom;
pub mod num;
pub mod machine;
pub mod program;
pub mod report;
pub mod stock;
pub mod tool;
pub mod trace;
