//! Planners of kinecut: bores and pockets by involutes ([`holes`]), [`drilling`] through any surface, [`facing`] with the
//! least burr, milled threads ([`threading`]), cutting data ([`cutting`]), and the time along a chain of curves ([`motion`]).
//!
//! A part of `kinecut`, which shows all of its layers under one name.

pub use kinecut_geom::{base, geom, num, tool};
pub use kinecut_machine::machine;
pub use kinecut_nc::{nc, program, trace};

pub mod clearing;
pub mod contouring;
pub mod cutting;
pub mod drilling;
pub mod facing;
pub mod holes;
pub mod motion;
pub mod threading;
