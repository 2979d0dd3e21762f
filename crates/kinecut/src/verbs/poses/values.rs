//! Joint positions as letters and numbers: mm, and degrees of rotary axes.

use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::base::{Code, Finding, Result};
use crate::machine::{JointValues, Machine};

/// Positions of axes by their letters, in the order of the code; mm, rotary axes degrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisValues(pub Vec<(char, f64)>);

impl AxisValues {
    /// The positions of a machine's joints.
    pub fn of(machine: &Machine, values: &[f64]) -> AxisValues {
        let one = |(joint, &value): (&crate::machine::Joint, &f64)| {
            (joint.letter, if joint.motion.is_rotation() { value.to_degrees() } else { value })
        };
        AxisValues(machine.joints.iter().zip(values).map(one).collect())
    }

    /// As positions of a machine's joints [mm or rad]; axes that are not named are at zero.
    ///
    /// # Errors
    /// `KC0703` for a letter that the machine does not have or that comes twice, `KC0103` for a number that is not
    /// finite.
    pub fn joints(&self, machine: &Machine) -> Result<JointValues> {
        let mut values = JointValues::zero(machine.joints.len());
        for (i, &(letter, value)) in self.0.iter().enumerate() {
            let Some((index, joint)) = machine.joint(letter) else {
                let letters: Vec<String> = machine.joints.iter().map(|j| j.letter.to_string()).collect();
                return Err(Finding::error(
                    Code::MACHINE_AXIS,
                    format!("the machine {} has no axis `{letter}`", machine.code),
                )
                .help(format!("its axes are {}", letters.join(", ")))
                .key(letter.to_string())
                .into());
            };
            if self.0[..i].iter().any(|(other, _)| *other == letter) {
                return Err(Finding::error(Code::MACHINE_AXIS, format!("axis {letter} is given twice"))
                    .key(letter.to_string())
                    .into());
            }
            if !value.is_finite() {
                return Err(Finding::error(
                    Code::JOB_VALUE,
                    format!("the position of {letter} is not finite"),
                )
                .value(value, "")
                .key(letter.to_string())
                .into());
            }
            values[index] = if joint.motion.is_rotation() { value.to_radians() } else { value };
        }
        Ok(values)
    }

    /// As words: `X10 A-30`.
    pub fn words(&self) -> String {
        let words: Vec<String> = self.0.iter().map(|(letter, v)| format!("{letter}{}", number(*v))).collect();
        words.join(" ")
    }
}

impl Serialize for AxisValues {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (letter, value) in &self.0 {
            map.serialize_entry(letter, value)?;
        }
        map.end()
    }
}

/// A number with six decimals at most, without zeros at its end and without a negative zero.
pub(crate) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// Three numbers as [`number`].
pub(crate) fn triple(v: [f64; 3]) -> String {
    v.map(number).join(" ")
}

/// Axes that a set of joint positions takes out of their travel.
pub(crate) fn outside(machine: &Machine, values: &[f64]) -> Vec<Finding> {
    /// Rounding at the end of a travel [mm or rad].
    const EDGE: f64 = 1e-9;
    let mut found = Vec::new();
    for (joint, &value) in machine.joints.iter().zip(values) {
        let Some([min, max]) = joint.travel else { continue };
        let bound = match value {
            v if v < min - EDGE => min,
            v if v > max + EDGE => max,
            _ => continue,
        };
        let finding = Finding::warning(
            Code::TRAVEL_EXCEEDED,
            format!("axis {} stands outside its travel", joint.letter),
        )
        .key(joint.letter.to_string());
        found.push(if joint.motion.is_rotation() {
            finding.value(value.to_degrees(), "deg").bound(bound.to_degrees(), "deg")
        } else {
            finding.value_mm(value).bound_mm(bound)
        });
    }
    found
}
