//! kinecut plans, posts and proves metal cutting.

pub mod base;
pub mod geom;
pub mod holes;
pub mod num;
pub mod machine;
pub mod program;
pub mod stock;
pub mod tool;
pub mod trace;
