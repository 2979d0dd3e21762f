//! The cutting data that the tools of a hole need.

use super::choose::title;
use super::steps::Step;
use crate::base::{Code, Finding, Result};
use crate::job::file::{PresetTable, ToolTable};
use crate::operations::{OperationTable, plain_name};

/// Whether the tool of a step has cutting data for a material: a hole has no speeds and feeds of its own.
///
/// # Errors
/// `KC0102` without a material, and where the tool has none.
pub(super) fn there(step: &Step, tool: Option<&ToolTable>, material: Option<&str>) -> Result<()> {
    let Some(tool) = tool else { return Ok(()) };
    let Some(material) = material else {
        let what = "the job has no material, by which holes take the cutting data of their tools";
        let help = "write material = \"C45\" at its top, as the presets of the tools name it";
        return Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("size").into());
    };
    let (feed, has_feed): (&str, fn(&PresetTable) -> bool) = match step.table {
        OperationTable::Drill(_) => (" and feed_per_rev", |p| p.feed_per_rev.is_some()),
        OperationTable::ThreadMill(_) => {
            (" and feed_per_tooth", |p| p.feed_per_tooth.is_some() || p.feed.is_some())
        }
        _ => ("", |_| true),
    };
    let plain = plain_name(material);
    let fits = |p: &&PresetTable| {
        plain_name(&p.material) == plain && (p.cutting_speed.is_some() || p.speed.is_some()) && has_feed(p)
    };
    if tool.presets.iter().any(|p| fits(&p)) {
        return Ok(());
    }
    let what = format!("{} has no cutting_speed{feed} for {}", title(tool), material.escape_debug());
    let help = "give it a [[tool.preset]] for this material, or write the operations one by one";
    Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("size").into())
}
