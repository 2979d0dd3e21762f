//! Limits of one axis.

use crate::base::{Code, Finding, Result};

/// Largest speed, acceleration and jerk of an axis: mm and s, of rotary axes rad and s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisLimit {
    /// Largest speed [mm/s, rad/s].
    pub velocity: f64,
    /// Largest acceleration [mm/s^2, rad/s^2].
    pub acceleration: f64,
    /// Largest jerk [mm/s^3, rad/s^3]; infinite where the control does not limit it.
    pub jerk: f64,
}

impl AxisLimit {
    /// Checks that each limit is positive, and finite where it must be; `axis` names it in the error.
    ///
    /// # Errors
    /// `KC0404` with axis and key of the first that is not.
    pub fn check(&self, axis: char) -> Result<()> {
        let limits = [
            ("velocity", self.velocity, false),
            ("acceleration", self.acceleration, false),
            ("jerk", self.jerk, true),
        ];
        for (key, value, may_be_infinite) in limits {
            if !(value > 0.0 && (value.is_finite() || may_be_infinite && value == f64::INFINITY)) {
                return Err(Finding::error(
                    Code::PLAN_VALUE,
                    format!("the {key} of axis {axis} must be positive and finite"),
                )
                .value(value, "mm or rad, and s")
                .bound(0.0, "mm or rad, and s")
                .key(key)
                .into());
            }
        }
        Ok(())
    }
}
