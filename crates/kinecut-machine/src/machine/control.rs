//! What a machine as a whole adds to the limits of its axes.

use crate::base::{Code, Finding, Result};

/// Values of the control and of the spindle, which are of no axis; `None` where not given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionControl {
    /// Largest feed along the path [mm/s].
    pub max_feed: Option<f64>,
    /// Largest speed of the spindle [rad/s].
    pub max_speed: Option<f64>,
}

impl MotionControl {
    /// These values; missing ones are those of `before`.
    pub fn over(self, before: MotionControl) -> MotionControl {
        MotionControl {
            max_feed: self.max_feed.or(before.max_feed),
            max_speed: self.max_speed.or(before.max_speed),
        }
    }

    /// Checks its numbers.
    ///
    /// # Errors
    /// `KC0703`, with the key in a machine file, for a feed or a speed that is not positive.
    pub fn check(&self) -> Result<()> {
        for (name, value) in [("max_feed", self.max_feed), ("max_speed", self.max_speed)] {
            positive("dynamics", name, value)?;
        }
        Ok(())
    }
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
