//! Several passes and passes of any form over a face: rows, frames along the outline, rings; their exit angles by first
//! contact, exactly; their price in time.
//!
//! All of it takes the spindle as M3; for M4 mirror the case and the path that comes out.

mod burr;
mod contact;
mod meet;
mod path;
mod stretch;

pub use burr::path_burr;
pub use path::PassPath;
pub use stretch::{EdgeStretch, Met, PathBurr};
