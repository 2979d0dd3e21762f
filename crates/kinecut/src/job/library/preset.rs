//! Cutting data of a tool for a material, taken by an operation that has no speed.

use crate::base::{Code, Finding, Result};
use crate::drilling::FeedChoice;
use crate::job::file::{PresetTable, ToolTable};
use crate::operations::{CuttingKeys, OperationTable, plain_name};

/// Gives an operation without a speed that of the preset of its tool for a material; what it was given, in words, and the preset.
/// Several presets that differ leave it open which is meant: they are refused, with their names.
pub(super) fn take_data<'t>(
    operation: &mut OperationTable,
    tool: &'t ToolTable,
    material: &str,
) -> Result<Option<(Vec<String>, &'t PresetTable)>> {
    let Some(keys) = operation.data() else { return Ok(None) };
    if keys.speed.is_some() || keys.cutting_speed.is_some() {
        return Ok(None);
    }
    let plain = plain_name(material);
    let fit: Vec<&PresetTable> =
        tool.presets.iter().filter(|preset| plain_name(&preset.material) == plain).collect();
    let Some(preset) = fit.first().copied() else { return Ok(None) };
    if fit.iter().any(|other| data(other) != data(preset)) {
        let name = |preset: &&PresetTable| match &preset.name {
            Some(name) => format!("`{}`", name.escape_debug()),
            None => "one without a name".to_owned(),
        };
        let names: Vec<String> = fit.iter().map(name).collect();
        let message = format!(
            "the operation needs a speed: T{} has several presets for {}, and none is taken: {}",
            tool.number,
            preset.material,
            names.join(", ")
        );
        let help = "give cutting_speed (m/min) or speed (rev/min), or keep one of these presets";
        return Err(Finding::error(Code::JOB_SHAPE, message).help(help).into());
    }
    let taken = taken_data(keys, preset);
    Ok((!taken.is_empty()).then_some((taken, preset)))
}

/// The numbers of a preset.
fn data(preset: &PresetTable) -> [Option<f64>; 5] {
    [preset.cutting_speed, preset.speed, preset.feed_per_tooth, preset.feed_per_rev, preset.feed]
}

/// Gives keys of an operation without a speed those of a preset, the feed where it has none; what was given, in words.
fn taken_data(keys: CuttingKeys<'_>, preset: &PresetTable) -> Vec<String> {
    let mut taken = Vec::new();
    if let Some(speed) = preset.cutting_speed {
        *keys.cutting_speed = Some(speed);
        taken.push(format!("cutting_speed {speed} m/min"));
    } else if let Some(speed) = preset.speed {
        *keys.speed = Some(speed);
        taken.push(format!("speed {speed} rev/min"));
    } else {
        return taken;
    }
    if let (Some(per_rev), Some(feed)) = (keys.per_rev.filter(|own| own.is_none()), preset.feed_per_rev) {
        *per_rev = Some(FeedChoice { entry: None, steady: feed, exit: None });
        taken.push(format!("feed_per_rev {feed} mm"));
    }
    let Some(feed) = keys.feed.filter(|keys| keys.feed.is_none() && keys.per_tooth.is_none()) else {
        return taken;
    };
    if let Some(per_tooth) = preset.feed_per_tooth {
        *feed.per_tooth = Some(per_tooth);
        taken.push(format!("feed_per_tooth {per_tooth} mm"));
    } else if let Some(value) = preset.feed {
        *feed.feed = Some(value);
        taken.push(format!("feed {value} mm/min"));
    }
    taken
}
