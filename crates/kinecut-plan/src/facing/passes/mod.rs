//! Several passes and passes of any form over a face: rows, frames along the outline, rings; their exit angles by first
//! contact, exactly; their price in time.
//!
//! All of it takes the spindle as M3; for M4 mirror the case and the path that comes out.

mod burr;
mod contact;
mod cover;
mod frames;
mod meet;
mod offset;
mod path;
pub(in crate::facing) mod plan;
mod row_cost;
mod row_plan;
mod rows;
mod stretch;

pub use burr::path_burr;
pub use contact::exit_angle;
pub use cover::uncovered;
pub use frames::{Fill, FrameOptions, frames};
pub use offset::{Corner, offset_loops};
pub use path::PassPath;
pub use plan::{PassKind, PassOptions, PassPlan, pareto, pass_time};
pub use row_plan::best_rows;
pub use rows::{MilledRow, MilledRows, RowWays};
pub use stretch::{EdgeStretch, Met, PathBurr};
