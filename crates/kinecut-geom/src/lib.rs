//! The ground of kinecut: findings and places in text ([`base`]), numbers ([`num`]), geometry ([`geom`]), and cutting
//! tools ([`tool`]).
//!
//! A part of `kinecut`, which shows all of its layers under one name.

pub mod base;
pub mod geom;
pub mod num;
pub mod tool;

/// Version of kinecut.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
