//! Numbers and texts of a file within bounds; the error has key, value, bound and help.

use super::{Code, Finding, Result};

/// Largest length in a job [mm]: ten metres, beyond which it is a slip of the pen, and far within the range of the
/// stock's fixed point numbers.
pub const MAX_LENGTH: f64 = 10_000.0;

/// A finite number within bounds [mm].
pub fn length(key: &str, value: f64, min: f64, max: f64) -> Result<f64> {
    bounded(key, value, min, max, "mm")
}

/// A finite number above zero.
pub fn positive(key: &str, value: f64, max: f64, unit: &str) -> Result<f64> {
    if value > 0.0 {
        bounded(key, value, 0.0, max, unit)
    } else {
        bounded(key, value, f64::MIN_POSITIVE, max, unit)
    }
}

/// A number from `min` to `max`.
pub fn bounded(key: &str, value: f64, min: f64, max: f64, unit: &str) -> Result<f64> {
    if value >= min && value <= max {
        return Ok(value);
    }
    let name = key.rsplit('.').next().unwrap_or(key);
    let (what, bound) = match value {
        v if v.is_nan() => (format!("{name} is not a number"), None),
        v if v > max => (format!("{name} is too large"), Some(max)),
        _ if min == f64::MIN_POSITIVE => (format!("{name} must be positive"), Some(0.0)),
        _ if min == 0.0 => (format!("{name} must not be negative"), Some(0.0)),
        _ => (format!("{name} is too small"), Some(min)),
    };
    let unit_after = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let finding = Finding::error(Code::JOB_VALUE, what).key(key).help(match min {
        f64::MIN_POSITIVE => format!("write a number above 0, at most {max}{unit_after}"),
        _ => format!("write a number from {min} to {max}{unit_after}"),
    });
    Err(match bound {
        Some(bound) => finding.value(value, unit).bound(bound, unit).into(),
        None => finding.into(),
    })
}

/// A number of a motion, of either sign: finite, and not out of all measure.
pub fn measured(key: &str, value: f64, most: f64, unit: &str) -> Result<f64> {
    if value.abs() <= most {
        return Ok(value);
    }
    Err(Finding::error(Code::JOB_VALUE, "a number is not finite or out of all measure")
        .value(value, unit)
        .bound(most, unit)
        .key(key)
        .into())
}

/// A text that may go into a program's comment, a report and a terminal: no control characters, not too long.
pub fn text(key: &str, value: &str) -> Result<String> {
    const MAX: usize = 120;
    if value.chars().any(char::is_control) || value.chars().count() > MAX {
        return Err(Finding::error(Code::JOB_VALUE, "the text has control characters or is too long")
            .value(value.chars().count() as f64, "characters")
            .bound(MAX as f64, "characters")
            .key(key)
            .into());
    }
    Ok(value.to_owned())
}
