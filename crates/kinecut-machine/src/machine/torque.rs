//! The torque of a spindle by its speed.

use std::sync::Arc;

use crate::base::{Code, Finding, Result};

/// Torque of a spindle that lasts (S1), by its speed. Between the points of the curve the power is linear in the speed, as it is
/// where the torque is constant and where the power is.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::TorqueCurve;
/// // 40 N m up to 1500 rev/min, from there on 6283 W.
/// let speed = |turns: f64| turns * std::f64::consts::TAU / 60.0;
/// let curve = TorqueCurve::new(&[[speed(1500.0), 40.0], [speed(6000.0), 10.0]])?;
/// assert!((curve.torque(speed(500.0)) - 40.0).abs() < 1e-9);
/// assert!((curve.torque(speed(3000.0)) - 20.0).abs() < 1e-9);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TorqueCurve(Arc<[[f64; 2]]>);

impl TorqueCurve {
    /// Most points of a curve.
    pub const MOST: usize = 100;

    /// Of points, each a speed [rad/s] and the torque there (N m).
    ///
    /// # Errors
    /// `KC0703` with the key of the point, counted from the list: fewer than two points or more than [`MOST`](Self::MOST), a number that
    /// is not above zero, a speed that is not above the one before.
    pub fn new(points: &[[f64; 2]]) -> Result<TorqueCurve> {
        const TURNS: f64 = 60.0 / std::f64::consts::TAU;
        let fail = |what: &str, (value, bound, unit): (f64, f64, &str), key: String| {
            let finding =
                Finding::error(Code::MACHINE_AXIS, what).value(value, unit).bound(bound, unit).key(key);
            Err(finding.help("write speed and torque, the slowest first: [[1500, 40], [6000, 10]]").into())
        };
        if !(2..=TorqueCurve::MOST).contains(&points.len()) {
            let bound = if points.len() < 2 { 2 } else { TorqueCurve::MOST };
            let what = "a curve of torque has two to a hundred points";
            return fail(what, (points.len() as f64, bound as f64, "points"), String::new());
        }
        let mut before = 0.0;
        for (i, [speed, torque]) in points.iter().enumerate() {
            if !(speed.is_finite() && *speed > before) {
                let what = "the speeds of a curve of torque are above zero and ascend";
                return fail(what, (*speed * TURNS, before * TURNS, "rev/min"), format!("[{i}]"));
            }
            if !(torque.is_finite() && *torque > 0.0) {
                return fail("a torque is above zero", (*torque, 0.0, "N m"), format!("[{i}]"));
            }
            before = *speed;
        }
        Ok(TorqueCurve(points.into()))
    }

    /// Its points: speeds [rad/s] and torques (N m).
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// The torque at a speed [rad/s] (N m): below the first point that of the first, beyond the last one that of its power.
    pub fn torque(&self, speed: f64) -> f64 {
        let next = self.0.partition_point(|point| point[0] < speed);
        match (next.checked_sub(1).and_then(|i| self.0.get(i)), self.0.get(next)) {
            (Some(&[slow, t0]), Some(&[fast, t1])) => {
                let share = (speed - slow) / (fast - slow);
                (slow * t0 + share * (fast * t1 - slow * t0)) / speed
            }
            (Some(&[last, torque]), None) => last * torque / speed,
            (_, first) => first.map_or(0.0, |point| point[1]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_through_its_points_and_keeps_their_power() {
        let points = [[100.0, 40.0], [400.0, 10.0], [800.0, 3.0]];
        let curve = TorqueCurve::new(&points).unwrap();
        for [speed, torque] in points {
            assert!((curve.torque(speed) - torque).abs() < 1e-12);
        }
        // 4000 W from the first to the second, less from there on: 3200 W half way to 2400 W.
        assert!(
            (curve.torque(160.0) - 25.0).abs() < 1e-12
                && (curve.torque(600.0) - 3200.0 / 600.0).abs() < 1e-12
        );
        assert!(
            (curve.torque(1600.0) - 1.5).abs() < 1e-12
                && curve.torque(1.0) == 40.0
                && curve.torque(0.0) == 40.0
        );
        let key = |points: &[[f64; 2]]| TorqueCurve::new(points).unwrap_err().0.key.clone().unwrap();
        assert_eq!(key(&points[..1]), "");
        // As a person has written it: 955 rev/min after 955.
        let error = TorqueCurve::new(&[[100.0, 40.0], [100.0, 10.0]]).unwrap_err();
        let value = error.0.value.as_ref().unwrap();
        assert!((value.value - 954.93).abs() < 0.01 && value.unit == "rev/min", "{error}");
        assert_eq!(key(&[[100.0, 40.0], [100.0, 10.0]]), "[1]");
        assert_eq!(key(&[[100.0, f64::NAN], [200.0, 10.0]]), "[0]");
        assert_eq!(key(&[[0.0, 4.0], [200.0, 10.0]]), "[0]");
    }
}
