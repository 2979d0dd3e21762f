//! Machines: coordinate codes and axes.
//!
//! A machine is an ordered word over elementary motions, from the workpiece to the tool (Danilchenko et al.,
//! "Primary generation of coordinate codes of metal-cutting machine tools").

mod axis;
mod code;

pub use axis::{Dynamics, LinearAxis, Machine};
pub use code::CoordinateCode;
