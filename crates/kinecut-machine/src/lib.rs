//! Machine tools of kinecut ([`machine`]): coordinate codes, kinematics, layouts, and the surfaces that a machine can make.
//!
//! A part of `kinecut`, which shows all of its layers under one name.

pub use kinecut_geom::{base, geom, num, tool};

pub mod machine;
