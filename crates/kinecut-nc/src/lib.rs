//! NC programs of kinecut: the [`program`] that planners and readers write, its way on a machine ([`trace`]), and the texts
//! of real controls ([`nc`]).
//!
//! A part of `kinecut`, which shows all of its layers under one name.

pub use kinecut_geom::{VERSION, base, geom, num, tool};
pub use kinecut_machine::machine;

pub mod nc;
pub mod program;
pub mod trace;
