//! The material by which the tools of a hole have their cutting data.

use crate::base::{Code, Finding, Result};

/// Refuses holes in a job without a material: they have no speeds and feeds of their own.
///
/// # Errors
/// `KC0102`.
pub(super) fn known(material: Option<&str>) -> Result<()> {
    if material.is_some() {
        return Ok(());
    }
    let what = "the job has no material, by which holes take the cutting data of their tools";
    let help = "write material = \"C45\" at its top, or as the presets of the tools name it";
    Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("size").into())
}
