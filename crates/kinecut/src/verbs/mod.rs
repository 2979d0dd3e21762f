//! What each verb of the command line does, one folder a verb: its question, its answer, and the answer as a person sees it.

pub mod envelope;
pub mod grazing;
pub mod kinematics;
pub mod layouts;
pub mod machine;
pub mod program;
mod program_line;
pub mod surface;
