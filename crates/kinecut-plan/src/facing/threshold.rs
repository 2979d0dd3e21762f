//! The exit angle that separates primary from secondary burr, by the depth of cut.

use std::f64::consts::PI;

use crate::base::{Code, Finding, Result};

/// Threshold of the exit angle over the depth of cut: straight between the given points, constant beyond them.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::facing::Thresholds;
/// let paper = Thresholds::default();
/// assert!((paper.at(0.75).to_degrees() - 75.0).abs() < 1e-12);
/// assert!((paper.at(0.1).to_degrees() - 90.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Thresholds {
    points: Vec<[f64; 2]>,
}

impl Default for Thresholds {
    /// 90 degrees at 0.5 mm and 60 degrees at 1 mm (Kryzhanivskyi and Kryzhanivska 2011, figure 1, after Chern 1993).
    fn default() -> Thresholds {
        Thresholds { points: vec![[0.5, PI / 2.0], [1.0, PI / 3.0]] }
    }
}

impl Thresholds {
    /// The thresholds through points (depth of cut [mm], exit angle [rad]).
    ///
    /// # Errors
    /// `KC1001` without a point, for depths that do not ascend or are not positive, or angles beyond 0 to pi.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Thresholds> {
        let fail = |what: &str, value: f64, unit: &str, bound: f64| {
            Err(Finding::error(Code::FACE_CASE, what).value(value, unit).bound(bound, unit).into())
        };
        if points.is_empty() {
            return fail("a table of thresholds needs a point", 0.0, "points", 1.0);
        }
        let mut before = 0.0;
        for &[depth, angle] in &points {
            if !(depth > before && depth.is_finite()) {
                return fail("depths of thresholds must be positive and ascend", depth, "mm", before);
            }
            if !(angle > 0.0 && angle <= PI) {
                return fail("thresholds lie between 0 and 180 degrees", angle.to_degrees(), "deg", 180.0);
            }
            before = depth;
        }
        Ok(Thresholds { points })
    }

    /// The threshold at a depth of cut [rad].
    pub fn at(&self, depth: f64) -> f64 {
        let after = self.points.partition_point(|p| p[0] <= depth);
        let Some(before) = after.checked_sub(1).map(|i| self.points[i]) else { return self.points[0][1] };
        let Some(next) = self.points.get(after) else { return before[1] };
        before[1] + (depth - before[0]) / (next[0] - before[0]) * (next[1] - before[1])
    }
}
