//! The preset of a tool for a material.

use crate::base::{Code, Finding, Result};
use crate::job::file::{PresetTable, ToolTable};
use crate::operations::plain_name;

/// The preset of a tool for a material. Several that differ leave it open which is meant: they are refused, with their names; `lack`
/// says what the operation needs.
pub(super) fn preset_of<'t>(
    tool: &'t ToolTable,
    material: &str,
    lack: &str,
) -> Result<Option<&'t PresetTable>> {
    let plain = plain_name(material);
    let fit: Vec<&PresetTable> =
        tool.presets.iter().filter(|preset| plain_name(&preset.material) == plain).collect();
    let Some(preset) = fit.first().copied() else { return Ok(None) };
    if fit.iter().all(|other| data(other) == data(preset)) {
        return Ok(Some(preset));
    }
    let name = |preset: &&PresetTable| match &preset.name {
        Some(name) => format!("`{}`", name.escape_debug()),
        None => "one without a name".to_owned(),
    };
    let names: Vec<String> = fit.iter().map(name).collect();
    let message = format!(
        "the operation needs {lack}: T{} has several presets for {}, and none is taken: {}",
        tool.number,
        preset.material,
        names.join(", ")
    );
    let give = match lack {
        "a feed" => "give it in the operation",
        _ => "give cutting_speed (m/min) or speed (rev/min)",
    };
    let help = format!("{give}, or keep one of these presets");
    Err(Finding::error(Code::JOB_SHAPE, message).help(help).into())
}

/// The numbers of a preset.
fn data(preset: &PresetTable) -> [Option<f64>; 5] {
    [preset.cutting_speed, preset.speed, preset.feed_per_tooth, preset.feed_per_rev, preset.feed]
}
