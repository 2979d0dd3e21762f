//! Measured heights of burrs over the exit angle.

use std::f64::consts::PI;

use crate::base::bounded::MAX_LENGTH;
use crate::base::{Code, Finding, Result};

/// Height of a burr over the exit angle: straight between the given points, constant beyond them; entries have none. The heights
/// are those that a shop has measured for its material and tool: none are built in.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::facing::burrs::BurrTable;
/// let points = [[0.0, 0.30], [30.0, 0.25], [60.0, 0.12]].map(|[psi, h]: [f64; 2]| [psi.to_radians(), h]);
/// let table = BurrTable::new(points.to_vec())?;
/// assert!((table.at(45f64.to_radians()) - 0.185).abs() < 1e-12);
/// assert_eq!(table.at(2.0), 0.12);
/// assert_eq!(table.at(-0.1), 0.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BurrTable {
    points: Vec<[f64; 2]>,
}

impl BurrTable {
    /// Most points.
    pub const MOST: usize = 1000;

    /// The heights through points (exit angle [rad], height [mm]).
    ///
    /// # Errors
    /// `KC1001` without a point or with too many, for angles that do not ascend or lie beyond 0 to pi, and for heights below 0.
    pub fn new(points: Vec<[f64; 2]>) -> Result<BurrTable> {
        let fail = |what: &str, value: f64, unit: &str, bound: f64| {
            Err(Finding::error(Code::FACE_CASE, what)
                .value(value, unit)
                .bound(bound, unit)
                .help("give pairs [exit angle in degrees, height in mm], angles ascending from 0 to 180")
                .into())
        };
        if points.is_empty() || points.len() > BurrTable::MOST {
            let most = BurrTable::MOST as f64;
            return fail("a table of burrs has from 1 to 1000 points", points.len() as f64, "points", most);
        }
        let mut before = f64::NEG_INFINITY;
        for &[angle, height] in &points {
            if !(0.0..=PI).contains(&angle) {
                let bound = if angle < 0.0 { 0.0 } else { 180.0 };
                return fail("exit angles lie between 0 and 180 degrees", angle.to_degrees(), "deg", bound);
            }
            if angle <= before {
                let (angle, before) = (angle.to_degrees(), before.to_degrees());
                return fail("exit angles of a table of burrs must ascend", angle, "deg", before);
            }
            if !(0.0..=MAX_LENGTH).contains(&height) {
                let bound = if height > MAX_LENGTH { MAX_LENGTH } else { 0.0 };
                return fail("the height of a burr is out of range", height, "mm", bound);
            }
            before = angle;
        }
        Ok(BurrTable { points })
    }

    /// The points (exit angle [rad], height [mm]).
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The height at an exit angle [rad]: 0 where teeth enter [mm].
    pub fn at(&self, exit_angle: f64) -> f64 {
        if !(0.0..=PI).contains(&exit_angle) {
            return 0.0;
        }
        let after = self.points.partition_point(|p| p[0] <= exit_angle);
        let Some(before) = after.checked_sub(1).map(|i| self.points[i]) else { return self.points[0][1] };
        let Some(next) = self.points.get(after) else { return before[1] };
        before[1] + (exit_angle - before[0]) / (next[0] - before[0]) * (next[1] - before[1])
    }

    /// The table for angles that are given from the other side of the velocity: pi minus them.
    #[must_use]
    pub fn supplement(&self) -> BurrTable {
        BurrTable { points: self.points.iter().rev().map(|[psi, h]| [PI - psi, *h]).collect() }
    }

    /// The exit angles between 0 and pi at which the height passes a limit [mm]: exact, as it is straight between points.
    pub(super) fn passes(&self, limit: f64) -> impl Iterator<Item = f64> + '_ {
        self.points.windows(2).filter_map(move |w| {
            let ([psi0, h0], [psi1, h1]) = (w[0], w[1]);
            ((h0 - limit) * (h1 - limit) < 0.0).then(|| psi0 + (limit - h0) / (h1 - h0) * (psi1 - psi0))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_that_make_no_sense_are_refused() {
        for bad in [
            vec![],
            vec![[0.0, 0.1], [0.0, 0.2]],
            vec![[1.0, 0.1], [0.5, 0.2]],
            vec![[-0.1, 0.1]],
            vec![[3.2, 0.1]],
            vec![[1.0, -0.1]],
            vec![[f64::NAN, 0.1]],
            vec![[1.0, f64::NAN]],
        ] {
            assert_eq!(BurrTable::new(bad).unwrap_err().code(), Code::FACE_CASE);
        }
        // The bound that is broken is said.
        for (bad, bound) in
            [([1.0, -0.1], 0.0), ([1.0, 1e9], MAX_LENGTH), ([-0.1, 0.1], 0.0), ([3.2, 0.1], 180.0)]
        {
            let error = BurrTable::new(vec![bad]).unwrap_err();
            assert_eq!(error.0.bound.map(|b| b.value), Some(bound), "{bad:?}");
        }
    }

    #[test]
    fn limits_are_passed_where_the_height_is_the_limit() {
        let table = BurrTable::new(vec![[0.1, 0.3], [0.9, 0.1], [1.4, 0.25], [2.0, 0.25]]).unwrap();
        let found: Vec<f64> = table.passes(0.2).collect();
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|psi| (table.at(*psi) - 0.2).abs() < 1e-12));
        let other = table.supplement();
        assert!((0..30).all(|i| {
            let psi = 0.1 * f64::from(i);
            (other.at(PI - psi) - table.at(psi)).abs() < 1e-12
        }));
    }
}
