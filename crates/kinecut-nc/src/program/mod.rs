//! The waist: a program, between planners and readers on one side and writers, motion and stock on the other.
//!
//! A program is a list of items (moves, tool changes, dwells, cycles, texts) with the modal state each runs
//! under, the frame its points are in, and where it came from. Curves are exact.

mod cycle;
mod data;
mod deep_hole;
mod frame;
mod frame_index;
mod item;
mod origin;
mod own_length;
mod reframe;
mod runs;
mod setup;
mod state;
mod tapping;

pub use crate::tool::ToolNumber;
pub use cycle::{Cycle, CycleStep};
pub use data::{ControlData, OWN_REGISTERS};
pub use deep_hole::{Between, DeepHole, Shortening};
pub use frame::{Frame, FrameId, RotarySolution, WorkOffset};
pub use item::{AxisPositions, Item, Items, Move, Path, Program, StopKind, Target, ToolAxis};
pub use origin::{Origin, OriginId, Role};
pub use own_length::OwnLength;
pub(crate) use reframe::moved;
pub use reframe::turn_about_z;
pub use setup::{Fixture, Setup, SetupId};
pub use state::{Blend, Comp, Coolant, Speed, Spindle, State, StateId, Tcp};
pub use tapping::{SAME_PITCH, Tapping};
