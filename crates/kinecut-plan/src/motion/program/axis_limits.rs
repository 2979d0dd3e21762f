//! Limits of the axes of a machine, by letter.

use super::super::AxisLimit;
use crate::machine::Machine;

/// Limits of the axes X Y Z A B C; `None` for an axis that the machine does not have, or of which rapid speed or acceleration
/// is not given. Jerk that is not given is not limited.
pub fn axis_limits(machine: &Machine) -> [Option<AxisLimit>; 6] {
    ['X', 'Y', 'Z', 'A', 'B', 'C'].map(|letter| {
        let (_, joint) = machine.joint(letter)?;
        let own = joint.dynamics;
        // Values of the machine are those of linear axes.
        let common = if matches!(letter, 'X' | 'Y' | 'Z') { machine.dynamics } else { own };
        Some(AxisLimit {
            velocity: own.rapid.or(common.rapid)?,
            acceleration: own.acceleration.or(common.acceleration)?,
            jerk: own.jerk.or(common.jerk).unwrap_or(f64::INFINITY),
        })
    })
}
