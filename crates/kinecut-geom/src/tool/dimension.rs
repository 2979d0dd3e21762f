//! Checks of dimensions, by their names.

use std::f64::consts::FRAC_PI_2;

use crate::base::{Code, Error, Finding, Result};

/// Excess of a dimension over its bound that passes, relative to its size: rounding of its computation.
const ROUNDING: f64 = 1e-12;

/// A dimension is refused [mm].
pub(super) fn refuse(key: &str, what: &str, value: f64, bound: f64) -> Error {
    refuse_in(key, what, value, bound, "mm")
}

/// A number is refused, in its unit.
pub(super) fn refuse_in(key: &str, what: &str, value: f64, bound: f64, unit: &str) -> Error {
    Finding::error(Code::TOOL_VALUE, what).value(value, unit).bound(bound, unit).key(key).into()
}

fn words(key: &str) -> String {
    key.replace('_', " ")
}

/// Above zero.
pub(super) fn positive(key: &str, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(refuse(key, &format!("the {} must be positive", words(key)), value, 0.0))
}

/// Zero or above.
pub(super) fn not_negative(key: &str, value: f64) -> Result<()> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(refuse(key, &format!("the {} must not be negative", words(key)), value, 0.0))
}

/// At most a bound, but for rounding.
pub(super) fn at_most(key: &str, value: f64, bound: f64, than: &str) -> Result<()> {
    if value <= bound + ROUNDING * bound.abs() {
        return Ok(());
    }
    Err(refuse(key, &format!("the {} must be at most {than}", words(key)), value, bound))
}

/// At least a bound, but for rounding.
pub(super) fn at_least(key: &str, value: f64, bound: f64, than: &str) -> Result<()> {
    if value.is_finite() && value >= bound - ROUNDING * bound.abs() {
        return Ok(());
    }
    Err(refuse(key, &format!("the {} must be at least {than}", words(key)), value, bound))
}

/// Above zero and below a right angle [rad].
pub(super) fn acute(key: &str, value: f64) -> Result<()> {
    if value > 0.0 && value < FRAC_PI_2 {
        return Ok(());
    }
    let what = format!("the {} must lie between 0 and 90 degrees", words(key));
    let passed = if value >= FRAC_PI_2 { 90.0 } else { 0.0 };
    Err(refuse_in(key, &what, value.to_degrees(), passed, "deg"))
}
