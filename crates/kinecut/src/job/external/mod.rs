//! Programs that others wrote: read as their control reads them, and followed on the machine.
//!
//! Nothing is planned and nothing is posted: the text itself is what is simulated, so that every finding is at a block
//! of the file.

mod carried;
pub(crate) mod follow;
pub(crate) mod given;
mod grouped;
mod magazine;
mod motion_sums;
pub(crate) mod registers;
mod setup;
mod shown;

pub(in crate::job) use carried::kind_in;
pub use carried::{Carried, CarriedStock, CarriedTool, carried, is_tool_table};
pub(crate) use carried::{TableTools, all_in_words, micrometres, toml_of};
pub(crate) use follow::{Errors, Followed, at_block, follow, follow_passing};
pub use given::{
    GivenFile, GivenJob, GivenStock, ProgramWants, control_of, control_of_name, given_alone, given_with_job,
};
pub(crate) use magazine::Missing;
pub(crate) use motion_sums::MotionSums;
pub(crate) use setup::external_setup;
pub use shown::{ExternalProgram, Unfollowed};
