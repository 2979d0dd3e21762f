//! Milling of plane faces: from the table over placement and passes to moves, proven by exit angles on the simulated stock.

mod check;
mod json;
mod moves;
mod plan;
mod planned;
mod prove;
mod section;
mod show;
mod table;
mod top;

pub use check::FaceOperation;
pub(crate) use json::{Event, FaceJson};
pub use plan::PlannedFace;
pub(crate) use plan::options;
pub use prove::{SimulatedExit, SimulatedFace};
pub(crate) use section::view;
pub(crate) use show::{MilledFace, face_page, face_words};
pub use table::*;
pub(crate) use top::top_outline;
