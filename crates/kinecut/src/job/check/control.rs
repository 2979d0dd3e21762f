//! What the table `dynamics` says of the machine as a whole, checked: the control, the spindle, the tool change.

use std::f64::consts::TAU;

use crate::base::Result;
use crate::base::bounded::{bounded, positive};
use crate::job::file::DynamicsTable;
use crate::machine::MotionControl;

/// Largest tolerance of a control, and largest junction deviation [mm]: roughing asks for a tenth of it.
const MOST_TOLERANCE: f64 = 1.0;
/// Largest tolerance of rotary axes [degrees].
const MOST_TURN: f64 = 5.0;
/// Largest bandwidth of position loops [Hz]: those of linear motors have a tenth of it.
const MOST_BANDWIDTH: f64 = 1000.0;
/// Longest tool change [s]: by hand, too.
const LONGEST_CHANGE: f64 = 600.0;
/// Longest ramp of a spindle [s].
const LONGEST_RAMP: f64 = 120.0;

/// Values of the machine as a whole in mm, rad and s. What one of them asks of another, which may be that of a preset, is
/// left to [`MotionControl::check`].
pub(crate) fn control(t: &DynamicsTable) -> Result<MotionControl> {
    let limit = |name: &str, value: Option<f64>, unit: &str, factor: f64| -> Result<Option<f64>> {
        value.map(|v| Ok(positive(&format!("dynamics.{name}"), v, 1e6, unit)? * factor)).transpose()
    };
    let up_to = |name: &str, value: Option<f64>, most: f64, unit: &str| -> Result<Option<f64>> {
        value.map(|v| bounded(&format!("dynamics.{name}"), v, 0.0, most, unit)).transpose()
    };
    Ok(MotionControl {
        max_feed: limit("max_feed", t.max_feed, "mm/min", 1.0 / 60.0)?,
        max_speed: limit("max_speed", t.max_speed, "rev/min", TAU / 60.0)?,
        spindle_power: limit("spindle_power", t.spindle_power, "kW", 1000.0)?,
        spindle_torque: limit("spindle_torque", t.spindle_torque, "N m", 1.0)?,
        interpolator: t.interpolator,
        tolerance: up_to("tolerance", t.tolerance, MOST_TOLERANCE, "mm")?,
        turn_tolerance: up_to("turn_tolerance", t.turn_tolerance, MOST_TURN, "deg")?.map(f64::to_radians),
        junction_deviation: up_to("junction_deviation", t.junction_deviation, MOST_TOLERANCE, "mm")?,
        servo_bandwidth: t
            .servo_bandwidth
            .map(|v| positive("dynamics.servo_bandwidth", v, MOST_BANDWIDTH, "Hz"))
            .transpose()?,
        tool_change: up_to("tool_change", t.tool_change, LONGEST_CHANGE, "s")?,
        spindle_ramp: up_to("spindle_ramp", t.spindle_ramp, LONGEST_RAMP, "s")?,
    })
}
