//! Cutting data: chip thickness, cutting force, power, torque and deflection, and values to start with.
//!
//! The force of a cut is that of Kienzle: `kc1.1 h^-mc` for each square millimetre of chip, at the mean thickness of the chip. The
//! constants are those of turning with sharp tools, so that a force, a power or a torque from them is right within
//! [`FORCE_SPREAD`] at best; a worn edge adds 30 to 50 %.
//!
//! Start values are what a catalogue gives for stable clamping: a value to begin with, not a recommendation.

mod ball;
mod bending;
mod boring;
mod chip;
mod force;
mod load;
mod material;
mod materials;
mod milling;
mod start;

pub use ball::effective_diameter;
pub use bending::{RoundPart, stickout_share, tip_deflection};
pub use boring::{DrillingCut, TappingCut};
pub use chip::MilledChip;
pub use force::{CuttingForce, FORCE_SPREAD, TAPPING_SPREAD};
pub use load::CuttingLoad;
pub use material::{Material, MaterialGroup};
pub use milling::MillingCut;
pub use start::{EdgeMaterial, StartChange, StartCut, StartData};
