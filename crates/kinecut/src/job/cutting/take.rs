//! Numbers given to an operation that lacks them.

use super::preset::preset_of;
use super::shop_table::{Cut, ShopTable};
use super::start::{none_there, start_of};
use super::taken::{DataOrigin, TakenData, TakenNumber};
use crate::base::Result;
use crate::cutting::{Material, StartData};
use crate::drilling::FeedChoice;
use crate::job::file::{CuttingRow, PresetTable, ToolTable};
use crate::operations::{CuttingKeys, OperationTable};

/// The feed that an operation lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lack {
    Nothing,
    PerTooth,
    PerRev,
}

/// Gives an operation the speed and the feed that it lacks: each of the preset of its tool for a material, else of the shop's
/// table, else a value to start with.
/// `operation`: setup and operation, by index; `file`: that of the tool.
///
/// # Errors
/// `KC0102` where several presets differ, and where nothing has a number that is lacking.
pub(in crate::job) fn take_data(
    operation: &mut OperationTable,
    at: (usize, usize),
    (tool, file): (&ToolTable, Option<&str>),
    (material, table): (&str, &ShopTable),
) -> Result<Option<TakenData>> {
    let Some(keys) = operation.data() else { return Ok(None) };
    let needs_speed = keys.speed.is_none() && keys.cutting_speed.is_none();
    let feed = match (&keys.per_rev, &keys.feed) {
        (Some(own), _) if own.is_none() => Lack::PerRev,
        (_, Some(own)) if own.feed.is_none() && own.per_tooth.is_none() => Lack::PerTooth,
        _ => Lack::Nothing,
    };
    if !needs_speed && feed == Lack::Nothing {
        return Ok(None);
    }
    let lack = if needs_speed { "a speed" } else { "a feed" };
    let preset = preset_of(tool, material, lack)?;
    let start = Material::of(material).and_then(|known| start_of(known, keys.cut, tool));
    let origin = |preset: &PresetTable| DataOrigin::Preset {
        material: preset.material.clone(),
        file: file.map(str::to_owned),
    };
    let of_preset = |key, value: f64, unit| {
        let origin = preset.map(origin)?;
        Some(TakenNumber { key, value, unit, origin, plain: value, changes: Vec::new() })
    };
    let cut = Cut { material, tool, cut: keys.cut };
    let of_table = |key, unit, number: fn(&CuttingRow) -> Option<f64>| {
        let (value, file, line) = table.find(cut, number)?;
        let origin = DataOrigin::Table { file: file.to_owned(), line };
        Some(TakenNumber { key, value, unit, origin, plain: value, changes: Vec::new() })
    };
    let of_start = |key, value: f64, plain: f64, unit, with_changes: bool| {
        let (data, assumed) = start.as_ref()?;
        let origin = DataOrigin::Start { row: data.row.clone(), assumed: *assumed };
        let changes = if with_changes { data.changes.clone() } else { Vec::new() };
        Some(TakenNumber { key, value, unit, origin, plain, changes })
    };
    let data = start.as_ref().map(|(data, _)| data);
    let speed = if needs_speed {
        let own = preset.and_then(|p| match (p.cutting_speed, p.speed) {
            (Some(v), _) => of_preset("cutting_speed", v, "m/min"),
            (None, Some(n)) => of_preset("speed", n, "rev/min"),
            (None, None) => None,
        });
        let started = || {
            let v = data?.cutting_speed;
            of_start("cutting_speed", v, v, "m/min", false)
        };
        let tabled = || of_table("cutting_speed", "m/min", |row| row.cutting_speed);
        let found = own.or_else(tabled).or_else(started);
        Some(found.ok_or_else(|| none_there("a speed", tool, material, table.name()))?)
    } else {
        None
    };
    // A feed in a minute belongs to the speed of its preset.
    let speed_is_of_preset = speed.as_ref().is_some_and(|s| matches!(s.origin, DataOrigin::Preset { .. }));
    let started = |key| {
        let (feed, plain) = data.and_then(|d: &StartData| d.feed.zip(d.plain_feed))?;
        of_start(key, rounded(feed), plain, "mm", true)
    };
    let feed = match feed {
        Lack::Nothing => None,
        Lack::PerRev => {
            let own = preset.and_then(|p| p.feed_per_rev);
            let own = own.and_then(|f| of_preset("feed_per_rev", f, "mm"));
            let tabled = || of_table("feed_per_rev", "mm", |row| row.feed_per_rev);
            let feed = own.or_else(tabled).or_else(|| started("feed_per_rev"));
            Some(feed.ok_or_else(|| none_there("a feed", tool, material, table.name()))?)
        }
        Lack::PerTooth => {
            let own = preset.and_then(|p| match (p.feed_per_tooth, p.feed) {
                (Some(f), _) => of_preset("feed_per_tooth", f, "mm"),
                (None, Some(f)) if speed_is_of_preset => of_preset("feed", f, "mm/min"),
                _ => None,
            });
            let tabled = || of_table("feed_per_tooth", "mm", |row| row.feed_per_tooth);
            let feed = own.or_else(tabled).or_else(|| started("feed_per_tooth"));
            Some(feed.ok_or_else(|| none_there("a feed", tool, material, table.name()))?)
        }
    };
    fill(keys, speed.as_ref(), feed.as_ref());
    Ok(Some(TakenData { operation: at, tool: tool.number, speed, feed, limited: None }))
}

/// A feed with four decimals, rounded down.
fn rounded(feed: f64) -> f64 {
    const LAST: f64 = 1e4;
    let down = (feed * LAST + 1e-6).floor() / LAST;
    if down > 0.0 { down } else { feed }
}

/// Writes the numbers into their keys.
fn fill(keys: CuttingKeys<'_>, speed: Option<&TakenNumber>, feed: Option<&TakenNumber>) {
    match speed {
        Some(speed) if speed.key == "speed" => *keys.speed = Some(speed.value),
        Some(speed) => *keys.cutting_speed = Some(speed.value),
        None => {}
    }
    let Some(taken) = feed else { return };
    match (taken.key, keys.feed, keys.per_rev) {
        ("feed_per_rev", _, Some(key)) => {
            *key = Some(FeedChoice { entry: None, steady: taken.value, exit: None });
        }
        ("feed", Some(own), _) => *own.feed = Some(taken.value),
        (_, Some(own), _) => *own.per_tooth = Some(taken.value),
        _ => {}
    }
}
