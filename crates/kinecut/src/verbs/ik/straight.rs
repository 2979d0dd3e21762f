//! Steps of a path when the axes go straight between the solutions: how far the tool leaves its straight line, and the points
//! to insert so that it stays within a tolerance.

use std::fmt::Write as _;

use serde::Serialize;

use crate::base::{Code, Finding, Progress, Result};
use crate::machine::kinematics::{LinearOptions, Retract};
use crate::machine::{JointValues, Kinematics, MOST_JOINTS, Machine};
use crate::verbs::poses::{AxisValues, number};

/// Places of a step at which its deviation is taken: that of a smooth step is a parabola, of which they find all but a
/// thousandth.
const SAMPLES: usize = 32;

/// Straightness wanted of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightWants {
    /// Greatest distance of the tip from its straight line [mm].
    pub tolerance: f64,
    /// Greatest angle of the tool to its direction on the great circle [deg].
    pub axis_tolerance: f64,
}

/// A step of a path on a control that moves the axes straight.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StraightStep {
    /// Index of the pose after the step, from one.
    pub index: usize,
    /// Distance of the tip from the straight line without points between [mm].
    pub deviation: f64,
    /// Angle of the tool to its direction on the great circle without points between [deg].
    pub axis_deviation_deg: f64,
    /// Points to insert before that pose.
    pub inserted: Vec<AxisValues>,
    /// Distance of the tip from the line with them [mm].
    pub left: f64,
    /// Angle of the tool to its direction with them [deg].
    pub axis_left_deg: f64,
    /// Why no points help: rotary axes that turn at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finding: Option<Finding>,
}

impl StraightWants {
    /// This tolerance of the tip [mm], and a tenth of a degree of the direction.
    pub fn new(tolerance: f64) -> StraightWants {
        StraightWants { tolerance, axis_tolerance: 0.1 }
    }

    fn check(&self) -> Result<()> {
        let (name, value) = match self {
            s if !(s.tolerance > 0.0 && s.tolerance.is_finite()) => ("tolerance", s.tolerance),
            s if !(s.axis_tolerance > 0.0 && s.axis_tolerance.is_finite()) => {
                ("axis_tolerance", s.axis_tolerance)
            }
            _ => return Ok(()),
        };
        Err(Finding::error(Code::TOO_MANY_PARTS, "the tolerance of a straight move is positive")
            .value(value, if name == "tolerance" { "mm" } else { "deg" })
            .bound(0.0, "")
            .key(name)
            .into())
    }
}

/// The steps between joint positions; those before which the tool is retracted are left out.
pub(crate) fn straight_steps(
    machine: &Machine,
    chain: &Kinematics,
    values: &[JointValues],
    (retracts, locked): (&[Retract], &[bool]),
    wants: &StraightWants,
    progress: &dyn Progress,
) -> Result<Vec<StraightStep>> {
    wants.check()?;
    let mut options = LinearOptions::new(wants.tolerance);
    options.axis_tolerance = wants.axis_tolerance.to_radians();
    for (slot, &held) in options.locked.iter_mut().zip(locked).take(MOST_JOINTS) {
        *slot = held;
    }
    let mut steps = Vec::with_capacity(values.len().saturating_sub(1));
    for (i, pair) in values.windows(2).enumerate() {
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "the points between were cancelled").into());
        }
        let index = i + 1;
        if retracts.binary_search_by_key(&index, |r| r.index).is_ok() {
            continue;
        }
        let plain = chain.linear_deviation(&pair[0], &pair[1], SAMPLES);
        let mut step = StraightStep {
            index,
            deviation: plain.from_line,
            axis_deviation_deg: plain.axis_in_step.to_degrees(),
            inserted: Vec::new(),
            left: plain.from_line,
            axis_left_deg: plain.axis_in_step.to_degrees(),
            finding: None,
        };
        if plain.from_line > wants.tolerance || plain.axis_in_step > options.axis_tolerance {
            match chain.linear_move(&pair[0], &pair[1], &options) {
                Ok(parts) => {
                    let between = &parts.values[..parts.values.len().saturating_sub(1)];
                    step.inserted = between.iter().map(|q| AxisValues::of(machine, q)).collect();
                    step.left = parts.deviation.from_line;
                    step.axis_left_deg = parts.deviation.axis_in_step.to_degrees();
                }
                Err(error) => {
                    let mut finding = *error.0;
                    finding.message = format!("step to pose {index}: {}", finding.message);
                    finding.key.get_or_insert_with(|| format!("pose[{index}]"));
                    step.finding = Some(finding);
                }
            }
        }
        steps.push(step);
    }
    Ok(steps)
}

impl StraightStep {
    /// As a person reads it: a line that says what goes before its points.
    pub(crate) fn text(&self) -> String {
        if self.inserted.is_empty() {
            return String::new();
        }
        let mut out = format!(
            "; {} points: straight axes leave the line by {} mm, the direction by {} deg\n",
            self.inserted.len(),
            number(self.deviation),
            number(self.axis_deviation_deg)
        );
        for values in &self.inserted {
            let _ = writeln!(out, "{}", values.words());
        }
        out
    }
}
