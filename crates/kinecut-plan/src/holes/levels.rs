//! Depth levels of equal height, each with the path at its wall: here the diameter of a bore becomes radii.

use super::spec::{BoreSpec, Rough};
use crate::base::{Code, Error, Finding, Result};

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
    /// Radius of the circle on which the cutter's centre runs at the wall [mm].
    pub radius: f64,
}

/// The levels from `top` down by `depth`, of equal height at most `step` [mm]; `radius` is that of the path at the wall
/// of a level by the height of its floor.
///
/// ```
/// # use kinecut_plan as kinecut;
/// let l = kinecut::holes::levels::levels(0.0, 30.0, 12.0, |_| Ok(5.0)).unwrap();
/// assert_eq!((l.len(), l[0].floor, l[2].floor), (3, -10.0, -30.0));
/// ```
///
/// # Errors
/// `KC0404` when a number is not positive or asks for more than ten thousand levels; those of `radius`.
pub fn levels(top: f64, depth: f64, step: f64, radius: impl Fn(f64) -> Result<f64>) -> Result<Vec<Level>> {
    let count = (depth / step - COUNT_SLACK).ceil().clamp(1.0, f64::INFINITY);
    if !(depth > 0.0 && depth.is_finite() && step > 0.0 && top.is_finite() && count <= MOST_LEVELS) {
        return Err(Finding::error(Code::PLAN_VALUE, "the depth of a bore needs a positive axial step")
            .value_mm(step)
            .bound_mm(depth / MOST_LEVELS)
            .help("write a depth and a step above 0, the step not far below a millimetre")
            .key("stepdown")
            .into());
    }
    let height = |i: f64| top - depth * (i / count);
    // In range by the check above.
    (0..count as u32)
        .map(|index| {
            let floor = height(f64::from(index) + 1.0);
            Ok(Level { index, above: height(f64::from(index)), floor, radius: radius(floor)? })
        })
        .collect()
}

/// The error of a bore without levels.
pub(super) fn no_depth() -> Error {
    Finding::error(Code::PLAN_VALUE, "a bore needs a depth").into()
}

impl BoreSpec {
    /// The levels of the whole depth, of height at most `stepdown` [mm] (`None`: as deep as the flutes are long), with
    /// `allowance` [mm] left on the wall.
    pub(super) fn levels(&self, stepdown: Option<f64>, allowance: f64) -> Result<Vec<Level>> {
        let step = stepdown.unwrap_or(self.cutter.flute_length);
        let radius = |floor| path_radius(2.0 * self.wall_radius(floor), self.cutter.diameter, allowance);
        // The floor is where a conical bore is narrowest.
        radius(self.floor())?;
        levels(self.top, self.full_depth(), step, radius)
    }

    /// Radius of the wanted wall at a height, stock to leave taken off [mm]; below the depth as at it.
    pub fn wall_radius(&self, height: f64) -> f64 {
        let bottom = self.bottom_diameter.unwrap_or(self.diameter);
        let share = ((self.top - height) / self.depth).clamp(0.0, 1.0);
        0.5 * (self.diameter + (bottom - self.diameter) * share) - self.stock_to_leave[0]
    }

    /// Radius of the roughing path at the wall of a level with its floor at a height [mm].
    ///
    /// # Errors
    /// `KC0401` when the cutter does not fit.
    pub fn rough_radius(&self, rough: &Rough, floor: f64) -> Result<f64> {
        path_radius(2.0 * self.wall_radius(floor), self.cutter.diameter, rough.allowance)
    }
}

/// Radius of the circle on which the cutter centre runs at the wall [mm], equation (14).
///
/// # Errors
/// `KC0401` when it is not positive: cutter and allowance fill the bore.
pub fn path_radius(bore_diameter: f64, cutter_diameter: f64, allowance: f64) -> Result<f64> {
    let radius = 0.5 * (bore_diameter - cutter_diameter) - allowance;
    if radius > 0.0 && radius.is_finite() {
        return Ok(radius);
    }
    Err(Finding::error(Code::CUTTER_TOO_LARGE, "the cutter does not fit into the bore")
        .value_mm(cutter_diameter)
        .bound_mm(bore_diameter - 2.0 * allowance)
        .help("use a cutter smaller than the bore diameter minus twice the allowance")
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_equal_and_end_on_the_floor() {
        for (depth, step, count) in
            [(30.0, 30.0, 1), (30.0, 10.0, 3), (30.0, 9.99, 4), (0.3, 0.1, 3), (5.0, f64::INFINITY, 1)]
        {
            let l = levels(7.0, depth, step, Ok).unwrap();
            assert_eq!(l.len(), count, "{depth} {step}");
            assert_eq!(l[count - 1].floor, 7.0 - depth);
            assert!(l.windows(2).all(|w| w[0].floor == w[1].above));
            assert!(l.iter().all(|l| l.above - l.floor <= step * (1.0 + 1e-8)));
        }
        for (depth, step) in
            [(0.0, 1.0), (-1.0, 1.0), (1.0, 0.0), (1.0, f64::NAN), (f64::NAN, 1.0), (1e9, 1e-9)]
        {
            assert_eq!(levels(0.0, depth, step, Ok).unwrap_err().code(), Code::PLAN_VALUE);
        }
    }
}
