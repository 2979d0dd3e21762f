//! What the table `dynamics` says of the machine as a whole, checked: the control and the spindle.

use std::f64::consts::TAU;

use crate::base::Result;
use crate::base::bounded::positive;
use crate::job::file::DynamicsTable;
use crate::machine::MotionControl;

/// Values of the control and of the spindle in mm, rad and s.
pub(super) fn control(t: &DynamicsTable) -> Result<MotionControl> {
    let limit = |name: &str, value: Option<f64>, unit: &str, factor: f64| -> Result<Option<f64>> {
        value.map(|v| Ok(positive(&format!("dynamics.{name}"), v, 1e6, unit)? * factor)).transpose()
    };
    Ok(MotionControl {
        max_feed: limit("max_feed", t.max_feed, "mm/min", 1.0 / 60.0)?,
        max_speed: limit("max_speed", t.max_speed, "rev/min", TAU / 60.0)?,
    })
}
