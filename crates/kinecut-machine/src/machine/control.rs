//! Values of a machine that are of no single axis.

use super::Interpolator;
use crate::base::{Code, Finding, Result};

/// Values of the control, of the spindle and of the tool change, which are of no axis; `None` where not given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionControl {
    /// Largest feed along the path [mm/s].
    pub max_feed: Option<f64>,
    /// Largest speed of the spindle [rad/s].
    pub max_speed: Option<f64>,
    /// Power of the spindle's motor that lasts (W).
    pub spindle_power: Option<f64>,
    /// Torque of the spindle that lasts (N m).
    pub spindle_torque: Option<f64>,
    /// The control's way of running along a path.
    pub interpolator: Option<Interpolator>,
    /// Distance by which the control may leave the programmed path to smooth corners and steps of curvature [mm]; zero: it
    /// stops in every corner.
    pub tolerance: Option<f64>,
    /// The same for rotary axes [rad].
    pub turn_tolerance: Option<f64>,
    /// Junction deviation of [`Interpolator::JunctionDeviation`], and only of that [mm].
    pub junction_deviation: Option<f64>,
    /// Frequency of a motion that the position loops of the axes pass with 0.707 of its size [Hz].
    pub servo_bandwidth: Option<f64>,
    /// Time of a tool change, chip to chip without the moves [s].
    pub tool_change: Option<f64>,
    /// Time in which the spindle gets from rest to `max_speed`, which must be given beside it [s].
    pub spindle_ramp: Option<f64>,
}

impl MotionControl {
    /// These values; missing ones are those of `before`.
    pub fn over(self, before: MotionControl) -> MotionControl {
        MotionControl {
            max_feed: self.max_feed.or(before.max_feed),
            max_speed: self.max_speed.or(before.max_speed),
            spindle_power: self.spindle_power.or(before.spindle_power),
            spindle_torque: self.spindle_torque.or(before.spindle_torque),
            interpolator: self.interpolator.or(before.interpolator),
            tolerance: self.tolerance.or(before.tolerance),
            turn_tolerance: self.turn_tolerance.or(before.turn_tolerance),
            junction_deviation: self.junction_deviation.or(before.junction_deviation),
            servo_bandwidth: self.servo_bandwidth.or(before.servo_bandwidth),
            tool_change: self.tool_change.or(before.tool_change),
            spindle_ramp: self.spindle_ramp.or(before.spindle_ramp),
        }
    }

    /// Checks its numbers, and that none of them lacks the value that gives it a meaning.
    ///
    /// # Errors
    /// `KC0703`, with the key in a machine file: a feed, a speed, a power, a torque or a bandwidth that is not positive, another number that is negative or
    /// not finite, `spindle_ramp` without `max_speed`, `junction_deviation` with another interpolator.
    pub fn check(&self) -> Result<()> {
        for (name, value) in [
            ("max_feed", self.max_feed),
            ("max_speed", self.max_speed),
            ("spindle_power", self.spindle_power),
            ("spindle_torque", self.spindle_torque),
            ("servo_bandwidth", self.servo_bandwidth),
        ] {
            positive("dynamics", name, value)?;
        }
        for (name, value) in [
            ("tolerance", self.tolerance),
            ("turn_tolerance", self.turn_tolerance),
            ("junction_deviation", self.junction_deviation),
            ("tool_change", self.tool_change),
            ("spindle_ramp", self.spindle_ramp),
        ] {
            if let Some(v) = value
                && !(v.is_finite() && v >= 0.0)
            {
                return Err(wrong(name, format!("the machine's {name} must not be negative"), v, "")
                    .bound(0.0, "")
                    .into());
            }
        }
        if let (Some(time), None) = (self.spindle_ramp, self.max_speed) {
            let what = "spindle_ramp is the time from rest to `max_speed`, which is not given";
            return Err(wrong("spindle_ramp", what.to_owned(), time, "s")
                .help("add max_speed, in rev/min, or leave spindle_ramp out")
                .into());
        }
        if let Some(deviation) = self.junction_deviation
            && self.interpolator != Some(Interpolator::JunctionDeviation)
        {
            let what = "junction_deviation is a value of the interpolator \"junction-deviation\" alone";
            return Err(wrong("junction_deviation", what.to_owned(), deviation, "mm")
                .help("add interpolator = \"junction-deviation\", or give tolerance instead")
                .into());
        }
        Ok(())
    }
}

fn wrong(name: &str, what: String, value: f64, unit: &str) -> Finding {
    Finding::error(Code::MACHINE_AXIS, what).value(value, unit).key(format!("dynamics.{name}"))
}

/// Refuses a value of a machine that is given and is not above zero.
pub(super) fn positive(key: &str, name: &str, value: Option<f64>) -> Result<()> {
    match value {
        Some(v) if !(v.is_finite() && v > 0.0) => {
            Err(Finding::error(Code::MACHINE_AXIS, format!("the machine's {name} must be positive"))
                .value(v, "")
                .bound(0.0, "")
                .key(format!("{key}.{name}"))
                .into())
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(control: MotionControl) -> String {
        let error = control.check().unwrap_err();
        assert_eq!(error.code(), Code::MACHINE_AXIS, "{error}");
        error.0.key.clone().unwrap()
    }

    #[test]
    fn zero_is_a_tolerance_and_a_time_and_no_feed() {
        let none = MotionControl::default();
        let zero = MotionControl {
            max_speed: Some(100.0),
            interpolator: Some(Interpolator::JunctionDeviation),
            tolerance: Some(0.0),
            turn_tolerance: Some(0.0),
            junction_deviation: Some(0.0),
            servo_bandwidth: Some(1.0),
            tool_change: Some(0.0),
            spindle_ramp: Some(0.0),
            ..none
        };
        none.check().unwrap();
        zero.check().unwrap();
        assert_eq!(refused(MotionControl { max_feed: Some(0.0), ..zero }), "dynamics.max_feed");
        assert_eq!(refused(MotionControl { servo_bandwidth: Some(0.0), ..zero }), "dynamics.servo_bandwidth");
        assert_eq!(refused(MotionControl { tolerance: Some(-1e-9), ..zero }), "dynamics.tolerance");
        assert_eq!(
            refused(MotionControl { turn_tolerance: Some(f64::NAN), ..zero }),
            "dynamics.turn_tolerance"
        );
        assert_eq!(
            refused(MotionControl { tool_change: Some(f64::INFINITY), ..zero }),
            "dynamics.tool_change"
        );
        assert_eq!(refused(MotionControl { max_speed: None, ..zero }), "dynamics.spindle_ramp");
        let other = [None, Some(Interpolator::JerkLimited), Some(Interpolator::ExactStop)];
        for interpolator in other {
            assert_eq!(refused(MotionControl { interpolator, ..zero }), "dynamics.junction_deviation");
        }
    }

    #[test]
    fn what_is_not_given_stays_as_it_was() {
        let before = MotionControl {
            tolerance: Some(0.1),
            interpolator: Some(Interpolator::Trapezoid),
            tool_change: Some(4.0),
            ..MotionControl::default()
        };
        let given = MotionControl { tolerance: Some(0.0), max_speed: Some(1.0), ..MotionControl::default() };
        let both = MotionControl { tolerance: Some(0.0), max_speed: Some(1.0), ..before };
        assert_eq!(given.over(before), both);
        assert_eq!(MotionControl::default().over(before), before);
    }
}
