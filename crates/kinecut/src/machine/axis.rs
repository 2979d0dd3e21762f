//! Machine axes with their limits.

use super::CoordinateCode;
use crate::base::{Code, Finding, Result};

/// A linear axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearAxis {
    /// `X`, `Y` or `Z`.
    pub letter: char,
    /// Least and greatest position [mm], if known.
    pub travel: Option<[f64; 2]>,
}

/// What the axes can do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dynamics {
    /// Rapid speed of each axis [mm/s].
    pub rapid: Option<f64>,
    /// Acceleration of each axis [mm/s^2].
    pub acceleration: Option<f64>,
    /// Jerk of each axis [mm/s^3].
    pub jerk: Option<f64>,
}

/// A machine. In its code every positive motion moves the tool side positively relative to the work side, so a
/// table axis needs no change of sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Motions from workpiece to tool.
    pub code: CoordinateCode,
    /// Travel along X, Y, Z.
    pub axes: [LinearAxis; 3],
    /// Limits of motion.
    pub dynamics: Dynamics,
}

impl Machine {
    /// A checked machine with three linear axes.
    ///
    /// # Errors
    /// `KC0703` when X, Y or Z is missing from the code, a travel is reversed or not finite, or a dynamic limit
    /// is not positive.
    pub fn new(code: CoordinateCode, travel: [Option<[f64; 2]>; 3], dynamics: Dynamics) -> Result<Machine> {
        let mut axes = [LinearAxis { letter: 'X', travel: None }; 3];
        for (i, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            if !code.axes().any(|a| a == letter) {
                return Err(Finding::error(
                    Code::MACHINE_AXIS,
                    format!("machine {code} has no {letter} axis"),
                )
                .cure("a milling job needs 1, 2 and 3 in the code")
                .key("code")
                .into());
            }
            if let Some([min, max]) = travel[i]
                && !(min.is_finite() && max.is_finite() && min < max)
            {
                return Err(Finding::error(
                    Code::MACHINE_AXIS,
                    format!("the travel of {letter} is reversed or not finite"),
                )
                .value_mm(min)
                .bound_mm(max)
                .key(format!("travel.{letter}"))
                .into());
            }
            axes[i] = LinearAxis { letter, travel: travel[i] };
        }
        for (key, value) in
            [("rapid", dynamics.rapid), ("acceleration", dynamics.acceleration), ("jerk", dynamics.jerk)]
        {
            if let Some(v) = value
                && !(v.is_finite() && v > 0.0)
            {
                return Err(Finding::error(
                    Code::MACHINE_AXIS,
                    format!("the machine's {key} must be positive"),
                )
                .value(v, "")
                .bound(0.0, "")
                .key(format!("dynamics.{key}"))
                .into());
            }
        }
        Ok(Machine { code, axes, dynamics })
    }
}
