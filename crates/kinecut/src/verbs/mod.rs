//! What each verb of the command line does, one folder a verb: its question, its answer, and the answer as a person sees it.

pub mod drill;
pub mod envelope;
pub mod face;
pub mod grazing;
pub mod hole;
pub mod kinematics;
pub mod layouts;
pub mod machine;
pub mod program;
mod program_line;
mod safe_height;
pub mod surface;
mod unknown_stock;
