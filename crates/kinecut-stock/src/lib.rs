//! Removal of material in kinecut: grazing curves and envelopes of a moving tool ([`sweep`]), and the [`stock`] that it cuts.
//!
//! A part of `kinecut`, which shows all of its layers under one name.

pub use kinecut_geom::{base, geom, num, tool};
pub use kinecut_machine::machine;
pub use kinecut_nc::{nc, program, trace};

pub mod contact;
pub mod stock;
pub mod sweep;
