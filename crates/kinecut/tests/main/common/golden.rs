//! Golden files, `tests/golden`: numbers of an independent reference.

use glam::DVec3;
use serde_json::Value;

/// The text of a golden file.
pub(crate) fn text(name: &str) -> String {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    std::fs::read_to_string(folder.join(name).with_extension("json")).unwrap()
}

/// A golden file.
pub(crate) fn file(name: &str) -> Value {
    serde_json::from_str(&text(name)).unwrap()
}

/// The number of a key.
#[track_caller]
pub(crate) fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} of {value}"))
}

/// A list of numbers.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// A list of three numbers.
pub(crate) fn vector(value: &Value) -> DVec3 {
    DVec3::from_array(numbers(value).try_into().unwrap())
}
