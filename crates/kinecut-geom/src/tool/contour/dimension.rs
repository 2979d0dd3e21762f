//! Checks of dimensions, by their names.

use std::f64::consts::FRAC_PI_2;

use crate::base::{Code, Error, Finding, Result};

/// How far a dimension may pass its bound, by its size: the rounding of what it is worked out from.
const ROUNDING: f64 = 1e-12;

pub(super) fn refuse(key: &str, what: &str, value: f64, bound: f64) -> Error {
    Finding::error(Code::TOOL_VALUE, what).value_mm(value).bound_mm(bound).key(key).into()
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

/// Above zero and below a bound [rad].
fn angle_below(key: &str, value: f64, bound: f64) -> Result<()> {
    if value > 0.0 && value < bound {
        return Ok(());
    }
    let what = format!("the {} must lie between 0 and {:.0} degrees", words(key), bound.to_degrees());
    let passed = if value >= bound { bound } else { 0.0 };
    Err(Finding::error(Code::TOOL_VALUE, what)
        .value(value.to_degrees(), "deg")
        .bound(passed.to_degrees(), "deg")
        .key(key)
        .into())
}

/// Above zero and below a right angle [rad].
pub(super) fn acute(key: &str, value: f64) -> Result<()> {
    angle_below(key, value, FRAC_PI_2)
}
