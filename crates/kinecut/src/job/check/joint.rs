//! Axes of a machine table, checked: letter, direction, travel, limits of motion.

use std::f64::consts::TAU;

use super::axes::{MAX_REACH, axis_finding, direction, point};
use crate::base::Result;
use crate::base::bounded::positive;
use crate::job::file::{AxisTable, DynamicsTable};
use crate::machine::{Dynamics, Joint};

/// Largest angle of a rotary axis [degrees]: some ten thousand turns.
const MAX_TURN: f64 = 1e7;
/// Largest angle between the direction of an axis and that of its digit [degrees]: squareness errors of any machine are far
/// smaller; beyond it the code would be another one (another axis, or an inclined one).
const MAX_OFF: f64 = 10.0;
/// Addresses that an axis may have.
const LETTERS: &str = "XYZABCUVW";

/// Changes a joint by what a table says of it.
pub(super) fn axis(joint: &mut Joint, key: &str, t: &AxisTable) -> Result<()> {
    let at = |name: &str| format!("axis.{key}.{name}");
    let rotary = joint.motion.is_rotation();
    if let Some(letter) = &t.letter {
        let mut letters = letter.chars();
        match (letters.next(), letters.next()) {
            (Some(c), None) if LETTERS.contains(c) => joint.letter = c,
            _ => {
                return Err(axis_finding(format!("`{letter}` is no address of an axis"))
                    .help("write one of X Y Z A B C U V W")
                    .key(at("letter"))
                    .into());
            }
        }
    }
    if let Some(direction) = t.direction {
        joint.direction = self::direction(direction, &at("direction"))?;
        if let Some(standard) = joint.motion.direction() {
            let off = joint.direction.cross(standard).length().atan2(joint.direction.dot(standard).abs());
            if off.to_degrees() > MAX_OFF {
                return Err(axis_finding(format!(
                    "digit {} of the code says {} along {}, and the direction is off it",
                    joint.motion,
                    if rotary { "a rotation about an axis" } else { "a translation" },
                    ['X', 'Y', 'Z'][(joint.motion.digit() as usize - 1) % 3],
                ))
                .value(off.to_degrees(), "deg")
                .bound(MAX_OFF, "deg")
                .help("correct the direction or the code; an inclined rotary axis is 7, 8 or 9")
                .key(at("direction"))
                .into());
            }
        }
    }
    if let Some(point) = t.point {
        if !rotary {
            return Err(axis_finding(format!("axis {key} is a translation, which has no point"))
                .help("leave it out")
                .key(at("point"))
                .into());
        }
        joint.point = self::point(point, &at("point"))?;
    }
    if let Some(sense) = t.sense {
        if sense.abs() != 1.0 {
            return Err(axis_finding(format!("the sense of axis {key} is 1 or -1"))
                .value(sense, "")
                .key(at("sense"))
                .help("write -1 when the control counts against ISO 841")
                .into());
        }
        joint.sense = sense;
    }
    if let Some(limits) = t.travel {
        travel(joint, limits, &at("travel"))?;
    }
    let own = dynamics(&[t.rapid, t.acceleration, t.jerk], rotary, &format!("axis.{key}"))?;
    joint.dynamics = own.over(joint.dynamics);
    Ok(())
}

/// Inclined axes without a letter of their own get the first of B, A, C that is free.
pub(super) fn usual_letters(joints: &mut [Joint]) {
    for i in 0..joints.len() {
        if joints[i].motion.letter().is_none() {
            let taken = |c: char| joints.iter().enumerate().any(|(j, other)| j != i && other.letter == c);
            if taken(joints[i].letter)
                && let Some(free) = "BACUVW".chars().find(|&c| !taken(c))
            {
                joints[i].letter = free;
            }
        }
    }
}

/// Sets the travel of a joint.
pub(super) fn travel(joint: &mut Joint, [min, max]: [f64; 2], key: &str) -> Result<()> {
    let rotary = joint.motion.is_rotation();
    let (unit, most) = if rotary { ("deg", MAX_TURN) } else { ("mm", MAX_REACH) };
    for value in [min, max] {
        if !(value.abs() <= most) {
            return Err(axis_finding(format!("a limit of axis {} is not finite or too large", joint.letter))
                .value(value, unit)
                .bound(most, unit)
                .key(key)
                .into());
        }
    }
    if !(min < max) {
        return Err(axis_finding(format!(
            "the travel of axis {} is reversed: its least position is not below its \
                                         greatest",
            joint.letter
        ))
        .value(min, unit)
        .bound(max, unit)
        .help("write the least position first")
        .key(key)
        .into());
    }
    joint.travel = Some(if rotary { [min.to_radians(), max.to_radians()] } else { [min, max] });
    Ok(())
}

/// Limits of the linear axes that a table of the machine as a whole states.
pub(crate) fn linear_axes(t: &DynamicsTable) -> Result<Dynamics> {
    dynamics(&[t.rapid, t.acceleration, t.jerk], false, "dynamics")
}

/// Rapid, acceleration and jerk in mm or rad, and s.
fn dynamics(given: &[Option<f64>; 3], rotary: bool, key: &str) -> Result<Dynamics> {
    let units: [(&str, &str, f64, f64); 3] = if rotary {
        [
            ("rapid", "rev/min", 1e5, TAU / 60.0),
            ("acceleration", "deg/s2", 1e7, 1f64.to_radians()),
            ("jerk", "deg/s3", 1e9, 1f64.to_radians()),
        ]
    } else {
        [("rapid", "mm/min", 1e6, 1.0 / 60.0), ("acceleration", "m/s2", 1e3, 1e3), ("jerk", "m/s3", 1e6, 1e3)]
    };
    let mut values = [None; 3];
    for ((value, (name, unit, most, factor)), out) in given.iter().zip(units).zip(&mut values) {
        if let Some(v) = *value {
            *out = Some(positive(&format!("{key}.{name}"), v, most, unit)? * factor);
        }
    }
    let [rapid, acceleration, jerk] = values;
    Ok(Dynamics { rapid, acceleration, jerk })
}
