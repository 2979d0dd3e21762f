//! The gate for the numbers of a job file: none that no shop writes, whatever its key.
//!
//! Each key has its own check where it is used. Here only what is beyond any of them is refused, so that no number that
//! nobody looks at reaches a program: a feed of 1e300 or 1e-300 mm/min, the tool 4294967295, a million teeth.

use serde::Serialize;
use serde_json::Value;

use crate::base::{Code, Finding, Result};

/// Bounds on a kind of number, its sign aside; zero is left to the check of its key.
struct Range {
    /// Last part of the key, or its end.
    key: &'static str,
    least: f64,
    most: f64,
    unit: &'static str,
    help: &'static str,
}

const RANGES: &[Range] = &[
    Range { key: "feed", least: 1e-3, most: 1e6, unit: "mm/min", help: "write the feed in mm/min" },
    Range { key: "teeth", least: 1.0, most: 999.0, unit: "", help: "write the number of its teeth" },
    Range { key: "turns", least: 1.0, most: 10_000.0, unit: "", help: "write 1 to 5: more only take time" },
    Range { key: "number", least: 0.0, most: 99_999.0, unit: "", help: "number the tools from 1 on" },
    Range { key: "tool", least: 0.0, most: 99_999.0, unit: "", help: "number the tools from 1 on" },
];

/// Largest number of all.
const MOST: f64 = 1e9;

/// Refuses a number of a table that is beyond all bounds, with its key.
///
/// # Errors
/// `KC0103` with the key.
pub(crate) fn within(table: &impl Serialize) -> Result<()> {
    match serde_json::to_value(table) {
        Ok(value) => walk(&value, ""),
        // Only maps with keys that are no strings cannot be JSON; tables have none.
        Err(_) => Ok(()),
    }
}

fn walk(value: &Value, key: &str) -> Result<()> {
    match value {
        Value::Object(map) => map.iter().try_for_each(|(name, v)| {
            walk(v, &if key.is_empty() { name.clone() } else { format!("{key}.{name}") })
        }),
        Value::Array(list) => list.iter().enumerate().try_for_each(|(i, v)| walk(v, &format!("{key}[{i}]"))),
        Value::Number(n) => n.as_f64().map_or(Ok(()), |v| number(v, key)),
        _ => Ok(()),
    }
}

fn number(value: f64, key: &str) -> Result<()> {
    let name = key.rsplit('.').next().unwrap_or(key);
    let name = name.split('[').next().unwrap_or(name);
    let of = |r: &&Range| name.strip_suffix(r.key).is_some_and(|rest| rest.is_empty() || rest.ends_with('_'));
    let (least, most, unit, help) = match RANGES.iter().find(of) {
        Some(r) => (r.least, r.most, r.unit, r.help),
        None => (0.0, MOST, "", "lengths are mm, feeds mm/min, angles degrees, speeds rev/min"),
    };
    let size = value.abs();
    if value == 0.0 || (least..=most).contains(&size) {
        return Ok(());
    }
    let (what, bound) = if size > most { ("large", most) } else { ("small", least) };
    Err(Finding::error(Code::JOB_VALUE, format!("{name} is too {what}"))
        .value(value, unit)
        .bound(bound, unit)
        .help(help)
        .key(key)
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_what_no_shop_writes_is_refused() {
        let fine = json!({
            "tool": [{ "number": 12, "teeth": 40, "direction": [1e-17, 0, 1] }],
            "setup": [{ "operation": [{ "rough": { "feed": 0.05, "plunge_feed": 30000 } }] }],
        });
        within(&fine).unwrap();
        for (table, key) in [
            (json!({ "setup": [{ "operation": [{ "feed": 1e300 }] }] }), "setup[0].operation[0].feed"),
            (json!({ "rough": { "plunge_feed": 1e-300 } }), "rough.plunge_feed"),
            (json!({ "tool": [{ "number": 4_294_967_295u32 }] }), "tool[0].number"),
            (json!({ "tool": { "teeth": i32::MAX } }), "tool.teeth"),
            (json!({ "finish": { "turns": 4_000_000 } }), "finish.turns"),
            (json!({ "box": { "min": [0, -1e300, 0] } }), "box.min[1]"),
        ] {
            let error = within(&table).unwrap_err();
            assert_eq!((error.code(), error.0.key.as_deref()), (Code::JOB_VALUE, Some(key)));
            assert!(error.0.bound.is_some() && !error.0.help.is_empty());
        }
    }
}
