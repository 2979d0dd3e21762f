//! Machines: coordinate codes, axes, kinematics.
//!
//! A machine is an ordered word over elementary motions, from the workpiece to the tool (Danilchenko et al.,
//! "Primary generation of coordinate codes of metal-cutting machine tools"). The same chain is the forward and inverse
//! kinematics of a machine and the shape-generation function of a surface.

mod body;
mod code;
mod control;
mod elementary;
pub mod formula;
pub mod generation;
mod interpolator;
mod iso;
mod joint;
pub mod kinematics;
pub mod layouts;
pub mod linuxcnc;
mod model;
mod own_code;
mod presets;
mod rapids;
pub mod surface;
mod torque;
mod word;

pub use body::{Body, Link};
pub use code::CoordinateCode;
pub use control::MotionControl;
pub use elementary::Elementary;
pub use interpolator::Interpolator;
pub use joint::{Dynamics, Joint, JointValues, MOST_JOINTS};
pub use kinematics::{Kinematics, Twist};
pub use model::Machine;
pub use own_code::{CodeEffect, OwnCode};
pub use presets::{Preset, presets};
pub use rapids::Rapids;
pub use torque::TorqueCurve;
pub use word::Word;
