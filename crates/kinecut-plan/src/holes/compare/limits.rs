//! Limits of the machine on which strategies are compared.

use serde::Serialize;

use crate::base::{Code, Finding, Result};

/// Limits that the feed and the axes set to a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Programmed path speed [mm/s].
    pub feed: f64,
    /// Largest speed of an axis [mm/s].
    pub axis_velocity: f64,
    /// Largest acceleration of an axis [mm/s^2].
    pub acceleration: f64,
    /// Largest jerk of an axis [mm/s^3].
    pub jerk: f64,
}

impl Limits {
    /// Limits of a middling machining centre at a feed [mm/s]: 30 m/min, 5 m/s^2, 100 m/s^3.
    pub fn usual(feed: f64) -> Limits {
        Limits { feed, axis_velocity: 500.0, acceleration: 5000.0, jerk: 1e5 }
    }

    /// Checks that each limit is positive and finite.
    ///
    /// # Errors
    /// `KC0404` with the key of the first that is not.
    pub fn check(&self) -> Result<()> {
        for (key, value, unit) in [
            ("feed", self.feed, "mm/s"),
            ("axis_velocity", self.axis_velocity, "mm/s"),
            ("acceleration", self.acceleration, "mm/s2"),
            ("jerk", self.jerk, "mm/s3"),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Finding::error(Code::PLAN_VALUE, format!("`{key}` must be positive"))
                    .value(value, unit)
                    .bound(0.0, unit)
                    .key(key)
                    .into());
            }
        }
        Ok(())
    }

    /// Path speed that the shape allows where the derivatives by arc length are `curvature` [1/mm] and `third`
    /// [1/mm^2] in size, in any direction of the axes [mm/s]; what is not a number does not bind.
    pub fn cap(&self, curvature: f64, third: f64) -> f64 {
        let mut v = if self.axis_velocity < self.feed { self.axis_velocity } else { self.feed };
        for cap in [(self.acceleration / curvature).sqrt(), (self.jerk / third).cbrt()] {
            if cap < v {
                v = cap;
            }
        }
        v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_held_to_acceleration_and_to_jerk() {
        // A of 5000 on R 10: 223.6 mm/s; J of 1e5: (1e5 * 100)^(1/3) = 215.4 mm/s binds first.
        let limits = Limits::usual(400.0);
        assert!((limits.cap(0.1, 0.01) - 1e7f64.cbrt()).abs() < 1e-9);
        assert!((limits.cap(0.1, 1e-9) - 50_000f64.sqrt()).abs() < 1e-9);
        assert_eq!(limits.cap(0.0, f64::NAN), 400.0);
        assert_eq!(Limits { axis_velocity: 30.0, ..limits }.cap(0.0, 0.0), 30.0);
    }

    #[test]
    fn limits_that_are_none_are_refused_with_their_key() {
        let refused = |limits: Limits| limits.check().unwrap_err();
        let error = refused(Limits { jerk: 0.0, ..Limits::usual(50.0) });
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some("jerk")));
        let error = refused(Limits { feed: f64::NAN, ..Limits::usual(50.0) });
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some("feed")));
    }
}
