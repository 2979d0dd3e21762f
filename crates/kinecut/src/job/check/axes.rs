//! Axes of a machine by their names, directions and places.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::machine::{Joint, Machine};

/// Largest distance of a point of a machine from its zero, and longest travel [mm]: beyond any machine, so a slip.
pub(crate) const MAX_REACH: f64 = 1e5;

/// The axis that a key names: its digit, its letter, or the letter of its motion.
pub(crate) fn axis_of(machine: &Machine, key: &str) -> Option<usize> {
    let joints = &machine.joints;
    let is_letter = |c: char| key.chars().eq([c]);
    joints
        .iter()
        .position(|j| j.motion.to_string() == key)
        .or_else(|| joints.iter().position(|j| j.motion.letter().is_some_and(is_letter)))
        .or_else(|| joints.iter().position(|j| is_letter(j.letter)))
}

/// The names of the axes, as messages list them.
pub(crate) fn axis_names(machine: &Machine) -> String {
    let name = |j: &Joint| j.motion.letter().map_or_else(|| j.motion.to_string(), String::from);
    machine.joints.iter().map(name).collect::<Vec<_>>().join(", ")
}

pub(crate) fn direction(v: [f64; 3], key: &str) -> Result<DVec3> {
    let given = DVec3::from_array(v);
    // A unit vector stays as it is, so that what was written is what is read.
    if (given.length_squared() - 1.0).abs() < 4.0 * f64::EPSILON {
        return Ok(given);
    }
    given.try_normalize().ok_or_else(|| {
        axis_finding("this is no direction: its length is zero or not finite".to_owned())
            .value(given.length(), "")
            .bound(0.0, "")
            .help("write a vector along the axis, such as [1, 0, 0]")
            .key(key)
            .into()
    })
}

pub(crate) fn point(p: [f64; 3], key: &str) -> Result<DVec3> {
    for (i, v) in p.into_iter().enumerate() {
        crate::base::bounded::length(&format!("{key}[{i}]"), v, -MAX_REACH, MAX_REACH)?;
    }
    Ok(DVec3::from_array(p))
}

pub(super) fn axis_finding(message: String) -> Finding {
    Finding::error(Code::MACHINE_AXIS, message)
}
