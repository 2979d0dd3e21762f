//! Cutting data that operations were given, as a part of `plan.json`.

use std::f64::consts::TAU;

use serde::Serialize;

use super::taken::{DataOrigin, TakenData, TakenNumber};
use crate::job::check::Job;

/// The data of an operation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(in crate::job) struct CuttingJson {
    /// Number of the operation over all setups, from 1.
    operation: usize,
    tool: u32,
    /// Speed of the spindle (rev/min).
    spindle: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<NumberJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    feed: Option<NumberJson>,
    /// The speed that was wanted (rev/min), where tool or machine do not allow it.
    #[serde(skip_serializing_if = "Option::is_none")]
    wanted: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct NumberJson {
    key: &'static str,
    value: f64,
    unit: &'static str,
    /// "tool: preset C45 of shop.toml", "built-in: C45, carbide, full width".
    origin: String,
    /// Factors on the value: "full width x0.8".
    #[serde(skip_serializing_if = "Vec::is_empty")]
    changed_by: Vec<String>,
}

/// The data of all operations that were given some.
pub(in crate::job) fn cutting_json(job: &Job) -> Vec<CuttingJson> {
    let one = |taken: &TakenData| {
        let (setup, index) = taken.operation;
        let before: usize = job.setups.iter().take(setup).map(|s| s.operations.len()).sum();
        let number = before + index;
        let spindle = job.operation(number as u32)?.milling().spindle;
        Some(CuttingJson {
            operation: number + 1,
            tool: taken.tool,
            spindle: spindle * 60.0 / TAU,
            speed: taken.speed.as_ref().map(json),
            feed: taken.feed.as_ref().map(json),
            wanted: taken.limited.map(|limited| limited.wanted),
        })
    };
    job.cutting.iter().filter_map(one).collect()
}

fn json(number: &TakenNumber) -> NumberJson {
    let origin = match &number.origin {
        DataOrigin::Preset { material, file } => {
            let of = file.as_ref().map(|file| format!(" of {file}")).unwrap_or_default();
            format!("tool: preset {material}{of}")
        }
        DataOrigin::Table { file, line } => format!("table: {file}:{line}"),
        DataOrigin::Start { row, .. } => format!("built-in: {row}"),
    };
    let changed_by = number.changes.iter().map(|c| format!("{} x{:.4}", c.what, c.factor)).collect();
    NumberJson { key: number.key, value: number.value, unit: number.unit, origin, changed_by }
}
