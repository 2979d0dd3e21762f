//! Depth levels of equal height.

use super::spec::BoreSpec;
use crate::base::{Code, Finding, Result};

/// Slack of the count, relative: a depth of exactly three steps is three levels.
const COUNT_SLACK: f64 = 1e-9;
/// Most levels a plan may have: beyond it a step was given in the wrong unit.
const MOST_LEVELS: f64 = 10_000.0;

/// One level: the material between two heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Number, from 0.
    pub index: u32,
    /// Height of the material's upper face [mm].
    pub above: f64,
    /// Height of the floor that this level cuts [mm].
    pub floor: f64,
}

/// The levels from `top` down by `depth`, of equal height at most `step` [mm].
///
/// ```
/// # use kinecut_plan as kinecut;
/// let l = kinecut::holes::levels::levels(0.0, 30.0, 12.0).unwrap();
/// assert_eq!((l.len(), l[0].floor, l[2].floor), (3, -10.0, -30.0));
/// ```
///
/// # Errors
/// `KC0404` when a number is not positive or asks for more than ten thousand levels.
pub fn levels(top: f64, depth: f64, step: f64) -> Result<Vec<Level>> {
    let count = (depth / step - COUNT_SLACK).ceil().clamp(1.0, f64::INFINITY);
    if !(depth > 0.0 && depth.is_finite() && step > 0.0 && top.is_finite() && count <= MOST_LEVELS) {
        return Err(Finding::error(Code::PLAN_VALUE, "the depth of a bore needs a positive axial step")
            .value_mm(step)
            .bound_mm(depth / MOST_LEVELS)
            .help("write a depth and a step above 0, the step not far below a millimetre")
            .into());
    }
    let height = |i: f64| top - depth * (i / count);
    // In range by the check above.
    Ok((0..count as u32)
        .map(|index| Level { index, above: height(f64::from(index)), floor: height(f64::from(index) + 1.0) })
        .collect())
}

impl BoreSpec {
    /// The levels of the whole depth, of height at most `stepdown` [mm]; `None`: as deep as the flutes are long.
    pub(super) fn levels(&self, stepdown: Option<f64>) -> Result<Vec<Level>> {
        levels(self.top, self.full_depth(), stepdown.unwrap_or(self.cutter.flute_length))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_equal_and_end_on_the_floor() {
        for (depth, step, count) in
            [(30.0, 30.0, 1), (30.0, 10.0, 3), (30.0, 9.99, 4), (0.3, 0.1, 3), (5.0, f64::INFINITY, 1)]
        {
            let l = levels(7.0, depth, step).unwrap();
            assert_eq!(l.len(), count, "{depth} {step}");
            assert_eq!(l[count - 1].floor, 7.0 - depth);
            assert!(l.windows(2).all(|w| w[0].floor == w[1].above));
            assert!(l.iter().all(|l| l.above - l.floor <= step * (1.0 + 1e-8)));
        }
        for (depth, step) in
            [(0.0, 1.0), (-1.0, 1.0), (1.0, 0.0), (1.0, f64::NAN), (f64::NAN, 1.0), (1e9, 1e-9)]
        {
            assert_eq!(levels(0.0, depth, step).unwrap_err().code(), Code::PLAN_VALUE);
        }
    }
}
