//! Machines as written in a job or in a file of their own: code, axes at home, spindle, work frame.
//!
//! Directions and points are those of the machine with all axes at zero, which is what a probe measures; they are
//! checked in [`crate::job::check`].

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{BodyTable, UnitsName};
use crate::machine::{CodeEffect, Interpolator, Rapids};

/// A machine, or the name of a file with one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum MachineEntry {
    /// Name of a TOML file that holds a machine table.
    File(String),
    /// The machine itself.
    Table(Box<MachineTable>),
}

/// A machine: its axes from workpiece to tool; lengths in mm, angles in degrees.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineTable {
    /// Unit of its lengths: "mm", or "in" for inches, with feeds in in/min and cutting speeds in ft/min, acceleration in in/s2;
    /// default: that of the job where the table is a part of it, else mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsName>,
    /// Name.
    #[serde(default)]
    pub name: Option<String>,
    /// A machine that kinecut knows, with changes by the other keys: "trt_xyzac"; `kinecut machine` lists them.
    #[serde(default)]
    pub preset: Option<String>,
    /// Coordinate code, workpiece to tool: 1 2 3 = X Y Z, 4 5 6 = A B C, 7 8 9 = inclined rotary axes, 0 = bed; "641203"
    /// or, as ISO 10791 writes it, "w C' A' X' Y' b Z (C1) t". Needed without a preset.
    #[serde(default)]
    pub code: Option<String>,
    /// Travel of the axes by their letters: mm, rotary axes degrees. `travel = { X = [-400, 400], A = [-100, 50] }`.
    #[serde(default)]
    pub travel: BTreeMap<String, [f64; 2]>,
    /// Speed, acceleration and jerk of the linear axes that have no values of their own; what the control does along a
    /// path; times of tool changes and of the spindle.
    #[serde(default)]
    pub dynamics: DynamicsTable,
    /// Rapid moves of several axes: "straight" or "axis-by-axis". Default: not known, so that both ways are tried,
    /// except for controls whose language defines the straight line (LinuxCNC, Grbl, HEIDENHAIN).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rapids: Option<Rapids>,
    /// Codes that the control of this machine has of its own, with their effect: "tip-control" (the linear axes follow the
    /// rotary ones), "no-tip-control", "no-motion". `codes = { M428 = "tip-control", M429 = "no-tip-control" }`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub codes: BTreeMap<String, CodeEffect>,
    /// The axes, by letter or, for inclined rotary axes, by the digit of the code: `[axis.A]`, `[axis.7]`. An axis that is
    /// not listed has its standard direction and passes through the machine's zero.
    #[serde(default)]
    pub axis: BTreeMap<String, AxisTable>,
    /// The spindle with all axes at zero; default: at the machine's zero, pointing along Z.
    #[serde(default)]
    pub spindle: Option<SpindleTable>,
    /// The frame of the table in which setups are located, with all axes at zero; default: that of the machine.
    #[serde(default)]
    pub work: Option<FrameTable>,
    /// Bodies of its links: `[[body]]`.
    #[serde(default, rename = "body", skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyTable>,
}

/// An axis with all axes of the machine at zero.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisTable {
    /// Its address on the control, where it is not the usual one: "B" for a nutating axis, "W" for a quill.
    #[serde(default)]
    pub letter: Option<String>,
    /// Direction in which it moves, or about which it turns; needed for inclined axes (digits 7 8 9).
    #[serde(default)]
    pub direction: Option<[f64; 3]>,
    /// A point of the axis of a rotation.
    #[serde(default)]
    pub point: Option<[f64; 3]>,
    /// -1 when the control counts against ISO 841, in which positive moves the tool side positively relative to the work
    /// side, for tables too; default 1.
    #[serde(default)]
    pub sense: Option<f64>,
    /// Least and greatest position: mm, or degrees.
    #[serde(default)]
    pub travel: Option<[f64; 2]>,
    /// Rapid speed: mm/min, of rotary axes rev/min.
    #[serde(default)]
    pub rapid: Option<f64>,
    /// Acceleration: m/s2, of rotary axes degrees/s2.
    #[serde(default)]
    pub acceleration: Option<f64>,
    /// Jerk: m/s3, of rotary axes degrees/s3.
    #[serde(default)]
    pub jerk: Option<f64>,
}

/// The spindle with all axes at zero.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpindleTable {
    /// The gauge point, from which tool lengths count; default [0, 0, 0].
    #[serde(default)]
    pub point: Option<[f64; 3]>,
    /// Direction from the tool into the spindle; default [0, 0, 1].
    #[serde(default)]
    pub direction: Option<[f64; 3]>,
    /// Direction of the spindle's own X, for tools that do not turn; default: the machine's X, turned with `direction` the
    /// shortest way from Z.
    #[serde(default)]
    pub x: Option<[f64; 3]>,
}

/// A frame: a point and two directions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameTable {
    /// Its zero; default [0, 0, 0].
    #[serde(default)]
    pub point: Option<[f64; 3]>,
    /// Direction of its X; default [1, 0, 0].
    #[serde(default)]
    pub x: Option<[f64; 3]>,
    /// Direction of its Z; default [0, 0, 1].
    #[serde(default)]
    pub z: Option<[f64; 3]>,
}

/// Speed, acceleration and jerk of the axes, and what control and spindle make of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DynamicsTable {
    /// Rapid speed of each axis, mm/min.
    #[serde(default)]
    pub rapid: Option<f64>,
    /// Acceleration, m/s2.
    #[serde(default)]
    pub acceleration: Option<f64>,
    /// Jerk, m/s3.
    #[serde(default)]
    pub jerk: Option<f64>,
    /// Largest feed along the path, mm/min; default: the rapid speed.
    #[serde(default)]
    pub max_feed: Option<f64>,
    /// Largest speed of the spindle, rev/min.
    #[serde(default)]
    pub max_speed: Option<f64>,
    /// Power of the spindle's motor that lasts (S1), kW: what the cuts need is compared with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spindle_power: Option<f64>,
    /// Torque of the spindle that lasts (S1), N m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spindle_torque: Option<f64>,
    /// Torque of the spindle that lasts (S1) by its speed, rev/min and N m: pairs, the slowest first; between them the
    /// power is linear in the speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spindle_curve: Option<Vec<[f64; 2]>>,
    /// How the control runs along a path: "jerk-limited", "trapezoid", "exact-stop", "junction-deviation" (Grbl) or "linuxcnc"
    /// (its planner as it comes, without S-curves).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolator: Option<Interpolator>,
    /// Distance by which the control may leave the programmed path to smooth corners and steps of curvature, mm: what `G64 P`,
    /// `CYCLE832`, `G05.1` or cycle 32 set; 0 to 1, and 0 is an exact stop in every corner. Of the interpolator "linuxcnc" that of
    /// `G64` without `P`, where 0 and nothing are as much as half of each move allows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// The same for rotary axes, degrees; 0 to 5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn_tolerance: Option<f64>,
    /// Junction deviation of the interpolator "junction-deviation", mm; 0 to 1. Grbl's `$11`, which is 0.01 as delivered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub junction_deviation: Option<f64>,
    /// Bandwidth of the position loops of the axes: the frequency of a motion that they pass with 0.707 of its size, Hz; up
    /// to 1000, 30 in `kinecut hole --compare` where it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub servo_bandwidth: Option<f64>,
    /// Time of a tool change, chip to chip without the moves, s; 0 to 600.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tool_change: Option<f64>,
    /// Time in which the spindle gets from rest to `max_speed`, s; 0 to 120. Needs `max_speed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spindle_ramp: Option<f64>,
}
