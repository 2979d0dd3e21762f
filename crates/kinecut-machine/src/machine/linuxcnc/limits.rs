//! Units, travel, speeds and accelerations of the axes: `[JOINT_n]`, or `[AXIS_L]` where it means the same.

use super::{Reading, number, wrong};
use crate::base::Result;
use crate::machine::{Dynamics, Joint, Machine};

/// Limits of this size or more mean "unlimited" [mm or degrees]: configurations write 1e6 and more for an endless axis.
const NO_LIMIT: f64 = 1e6;

/// Millimetres per unit of length, radians per unit of angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    pub(super) length: f64,
    pub(super) angle: f64,
}

/// The units of the configuration.
pub(super) fn units(reading: &mut Reading<'_>) -> Result<Units> {
    let length = match reading.ini.take("TRAJ", "LINEAR_UNITS", "unit of length") {
        None => {
            reading.missing("[TRAJ]LINEAR_UNITS", "mm");
            1.0
        }
        Some(e) => match e.value.to_ascii_lowercase().as_str() {
            "mm" | "metric" => 1.0,
            "inch" | "in" | "imperial" => 25.4,
            other => {
                let text = format!("LINEAR_UNITS `{other}` is neither mm nor inch");
                return Err(wrong(reading.sources, e.span, text));
            }
        },
    };
    let angle = match reading.ini.take("TRAJ", "ANGULAR_UNITS", "unit of angle") {
        None => 1f64.to_radians(),
        Some(e) => match e.value.to_ascii_lowercase().as_str() {
            "deg" | "degree" => 1f64.to_radians(),
            "rad" | "radian" => 1.0,
            "grad" | "gon" => 0.9f64.to_radians(),
            other => {
                let text = format!("ANGULAR_UNITS `{other}` is neither degree, radian nor gon");
                return Err(wrong(reading.sources, e.span, text));
            }
        },
    };
    Ok(Units { length, angle })
}

/// Gives the axes their limits; `letters` are the coordinates of joints 0, 1, 2...
pub(super) fn apply(reading: &mut Reading<'_>, machine: &mut Machine, letters: &str) -> Result<()> {
    let units = units(reading)?;
    let is_trivial = !machine.is_multi_axis();
    for joint in &mut machine.joints {
        let number = letters.chars().position(|c| c == joint.letter);
        let section = number.map(|n| format!("JOINT_{n}")).filter(|s| reading.ini.has(s));
        let rotary = joint.motion.is_rotation();
        let section = match section {
            Some(section) => section,
            // A rotary coordinate is its joint; X, Y, Z of a machine with rotary axes are those of the tip.
            None if is_trivial || rotary => format!("AXIS_{}", joint.letter),
            None => {
                let name = format!("[JOINT_{}] of axis {}", number.unwrap_or(0), joint.letter);
                reading.missing(name, "no limits; those of [AXIS_] are of the tip, not of the slide");
                continue;
            }
        };
        self::joint(reading, joint, &section, if rotary { units.angle } else { units.length })?;
    }
    Ok(())
}

fn joint(reading: &mut Reading<'_>, joint: &mut Joint, section: &str, unit: f64) -> Result<()> {
    let letter = joint.letter;
    let take = |reading: &mut Reading<'_>, key: &str, what: &str| -> Result<Option<f64>> {
        match reading.ini.take(section, key, &format!("{what} of axis {letter}")) {
            Some(e) => number(reading.sources, &e.value, e.span, key).map(Some),
            None => {
                reading.missing(format!("[{section}]{key}"), format!("axis {letter} has no {what}"));
                Ok(None)
            }
        }
    };
    let min = take(reading, "MIN_LIMIT", "least position")?;
    let max = take(reading, "MAX_LIMIT", "greatest position")?;
    let rapid = take(reading, "MAX_VELOCITY", "rapid speed")?;
    let acceleration = take(reading, "MAX_ACCELERATION", "acceleration")?;
    joint.travel = match (min, max) {
        (Some(min), Some(max)) if min.abs() < NO_LIMIT && max.abs() < NO_LIMIT => {
            Some([min * unit, max * unit])
        }
        (None, None) => None,
        _ => {
            reading
                .remarks
                .push(format!("axis {letter} has no travel: a limit is missing or is {NO_LIMIT} and more"));
            None
        }
    };
    let positive = |v: Option<f64>| v.filter(|v| *v > 0.0).map(|v| v * unit);
    joint.dynamics = Dynamics { rapid: positive(rapid), acceleration: positive(acceleration), jerk: None };
    Ok(())
}
